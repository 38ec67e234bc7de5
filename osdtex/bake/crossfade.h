/* crossfade.h -- patches blended where they meet, where that is asked for.
 *
 * On both sides of a seam a texel shows its own patch and what the other would
 * show there, had it gone on: half and half on the seam, nothing of the other
 * at the end of the blend. */
#ifndef OTX_BAKE_CROSSFADE_H
#define OTX_BAKE_CROSSFADE_H

#include "bake/block.h"

/* Blends a texel on the surface.
 *
 *   first  a sample on the texel's chart
 *   color  of the texel without it */
void otx_crossfade_inside(
    otx_block *block, int32_t x, int32_t y, int32_t first, float *color);

/* Blends a texel beyond the rim that is nearest to it, where that is a seam: it
 * shows what is across, and gets its share of what this side would show. */
void otx_crossfade_beyond(otx_block *block, int32_t x, int32_t y, float *color);

#endif

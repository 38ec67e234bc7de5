/* aov.h -- what is baked besides colours: values at a texel's centre. */
#ifndef OTX_BAKE_AOV_H
#define OTX_BAKE_AOV_H

#include "bake/block.h"

/* All values of a texel on the surface: with whether it is there, but for the
 * source, which says nothing of that.
 *
 *   first  a sample on the texel's chart */
void otx_aov_inside(
    otx_block *block, int32_t x, int32_t y, int32_t first, float *out);

/* The same of a texel beyond the rims, in place of its colour.
 *
 *   walk  what it continues */
void otx_aov_gutter(
    const otx_block *block, int32_t x, int32_t y, const otx_walk *walk,
    float *out);

#endif

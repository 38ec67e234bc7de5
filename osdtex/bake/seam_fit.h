/* seam_fit.h -- both sides of a cut in the texture show the same along it.
 *
 * A renderer that comes to a rim looks up half of what it shows in the margin.
 * Seen from the two sides of an edge, texels lie differently, and what is
 * between them comes out differently: a step along the edge. Therefore what
 * the edge shows is settled first, from both sides, and the texels around it
 * are moved so that lookups on it find that. See docs/notes/bake.md. */
#ifndef OTX_BAKE_SEAM_FIT_H
#define OTX_BAKE_SEAM_FIT_H

#include "bake/seam_edge.h"

/* The texel (x, y) of the raster, all channels: where a rim is within a texel
 * of its centre with its share of what a lookup there lacks or has too much,
 * else as it is.
 *
 *   edge  the rim met last, kept from call to call */
void otx_seam_fit_texel(
    const otx_seam_fit *fit, int32_t x, int32_t y, otx_seam_fit_edge *edge,
    float *out);

#endif

/* ramp.h -- a tile by cross-fades, as the paper prints it, for comparison.
 *
 * The four strips lie over one window of the exemplar; the opacity of a strip
 * is a product of four ramps [Akleman, fig. 10]: two fall to 0 at its ends, one
 * with depth, and one where its column comes closest to what is below. What
 * overlaps becomes a double exposure, and at its vertices every tile shows its
 * own window, so tiles do not meet there. */
#ifndef OTX_TILING_RAMP_H
#define OTX_TILING_RAMP_H

#include "tiling/ring_search.h"

/* Paints tile `name` with its gutters, from texel (x, y) of `image` on. Works
 * in run->scratch. */
otx_status otx_ramp_paint(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    int32_t x, int32_t y, otx_image *image);

#endif

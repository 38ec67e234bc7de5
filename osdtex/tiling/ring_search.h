/* ring_search.h -- where in the exemplar the inside of a tile comes from.
 *
 * A window fits a frame when it shows the same as the four strips where they
 * may be cut into it. That error is a sum over the sides, and a side only has
 * a type and an orientation, of which there are few: their error maps over all
 * places of the exemplar are correlations, made once by FFT. The error of any
 * window, turned any way, in any tile of the set, is then four look-ups. */
#ifndef OTX_TILING_RING_SEARCH_H
#define OTX_TILING_RING_SEARCH_H

#include "tiling/frame.h"

enum
{
    OTX_RING_SEARCH_SIDES = 15 /* of a query: all four */
};

typedef struct otx_ring_search
{
    const otx_texel_pool *pool;
    const otx_frame_kit *kit;
    otx_tile_layout layout;
    size_t stride;
    float **maps; /* [types * 4] of [height * stride]: sum of squared
                   * distances for a strip as side 0 to 3 */
    /* Windows may be at x0 <= x < x1, y0 <= y < y1. */
    int32_t x0, y0, x1, y1;
    int32_t turns_step; /* 1: all turns; 2: none by 90 degrees */
} otx_ring_search;

/* Pixel bounds of the exemplar that windows stay in, both ends included;
 * all zero: anywhere. */
typedef struct otx_ring_region
{
    int32_t x0, y0, x1, y1;
} otx_ring_region;

/* Makes the maps, in run->arena. ARGUMENT when no window fits in `region`. */
otx_status otx_ring_search_create(
    otx_run *run, const otx_texel_pool *pool, const otx_frame_kit *kit,
    const otx_tile_layout *layout, const otx_ring_region *region,
    otx_ring_search *out);

/* Mean squared distance of a window to the frame of a tile, over the
 * sides whose bits are set. */
double otx_ring_search_error(
    const otx_ring_search *search, const otx_tile_name *name, int32_t sides,
    otx_texel_window window);

/* The best windows for a tile, no two within 8 texels with the same turn.
 * Returns how many there are, at most `count`, best first; -1 when memory is
 * out.
 *
 *   sides   bits of the sides that count
 *   out     [count] */
int32_t otx_ring_search_find(
    otx_arena *scratch, const otx_ring_search *search,
    const otx_tile_name *name, int32_t sides, int32_t count,
    otx_texel_window *out);

#endif

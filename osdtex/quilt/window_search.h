/* window_search.h -- where in a picture is what a window shows?
 *
 * Exhaustive, at a size at which the picture's shorter side is about a hundred
 * texels, then exact to the texel around the best few. Lab, squared
 * differences. */
#ifndef OTX_QUILT_WINDOW_SEARCH_H
#define OTX_QUILT_WINDOW_SEARCH_H

#include "quilt/texel_pool.h"

typedef struct otx_window_search
{
    const otx_texel_pool *pool;
    int32_t side;    /* of a window, texels */
    int32_t factor;  /* texels to a texel of `small` */
    otx_image small; /* Lab, whole texels only */
} otx_window_search;

otx_status otx_window_search_create(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool, int32_t side,
    otx_window_search *out);

/* Places of windows that lie inside the picture (across its border where it
 * tiles) and are like `window`, the best first; of places close to one another
 * the best.
 *
 *   window   side x side; OTX_TEXEL_NONE, and what is near it, does not count
 *   limit    1 .. 16
 *   windows  [limit], upright
 *   count    1 or more */
otx_status otx_window_search_find(
    otx_run *run, const otx_window_search *search, const otx_texel_map *window,
    int32_t limit, otx_texel_window *windows, int32_t *count);

/* `map` in blocks of factor x factor texels, their mean Lab each.
 *
 *   known  [blocks], 0 where one has a hole; NULL not wanted */
otx_status otx_window_search_shrink(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool,
    const otx_texel_map *map, int32_t factor, otx_image *out, uint8_t *known);

#endif

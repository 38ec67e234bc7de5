/* corner.h -- what is seen around a vertex, whatever its valence.
 *
 * All sectors that meet at a vertex show the same picture S, turned. They fit
 * together for any valence when S agrees with itself on its two rays. A piece
 * P of the exemplar is laid over itself turned by 90 degrees and cut in two:
 * along one ray S shows P, along the other turned P. So across each ray one
 * sees what P itself shows there. */
#ifndef OTX_TILING_CORNER_H
#define OTX_TILING_CORNER_H

#include "quilt/quilt.h"

typedef struct otx_corner
{
    otx_texel_map map; /* [2 reach * 2 reach], the vertex in its middle */
    bool whole;        /* a window as it is, for vertices around which four
                        * tiles lie the same way up; else it looks the same
                        * when turned, for any vertex */
    int64_t cost;      /* of the cut, see quilt.h */
    double seam;       /* mean distance along the cut */
} otx_corner;

/* The corner made of the exemplar around the texel corner that is (reach,
 * reach) above `window`'s (x, y); its turns do not matter. In run->arena. */
otx_status otx_corner_build(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    int32_t reach, otx_corner *out);

/* The exemplar's window itself, 2 reach texels on a side. In run->arena. */
otx_status otx_corner_lay(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    int32_t reach, otx_corner *out);

/* The texel at (x, y) from the vertex, both in [-reach, reach). */
static inline int32_t
otx_corner_texel(const otx_corner *corner, int32_t x, int32_t y)
{
    const int32_t reach = corner->map.width / 2;

    return otx_texel_map_at(&corner->map, x + reach, y + reach);
}

#endif

/* strip.h -- what is seen along an edge, on both its sides.
 *
 * A piece of the exemplar along a segment, whose ends have been sewn to the
 * corners of its two vertices. (t, d): t along the edge, d to its left. The
 * tile whose side is of type 2k looks at it from d >= 0, the one of type
 * 2k + 1 from the other end and the other side: (side - 1 - t, -d - 1). */
#ifndef OTX_TILING_STRIP_H
#define OTX_TILING_STRIP_H

#include "tiling/corner.h"

typedef struct otx_strip
{
    otx_texel_map map; /* [2 reach * side], row reach is d = 0 */
    int64_t cost;      /* of the cuts at both ends */
    double seam;       /* mean distance along them */
} otx_strip;

/* Sizes that all strips and tiles of a set share, in texels. */
typedef struct otx_strip_sizes
{
    int32_t side;   /* length of an edge */
    int32_t gutter; /* width to which an edge decides what is seen */
    int32_t core;   /* half-width of the square that a corner decides */
    int32_t hold;   /* the same for one that is a whole window */
    int32_t sew;    /* half-width of corners: how far a cut may wander that
                     * sews a strip to them */
    int32_t reach;  /* half-width of strips, likewise for insides */
} otx_strip_sizes;

/* Sews `edge` [2 reach * side] between `start` (t = 0) and `end`.
 *
 *   turns  quarter turns from the tiles' rows to t, which only whole corners
 *          mind */
otx_status otx_strip_build(
    otx_run *run, const otx_texel_pool *pool, const otx_strip_sizes *sizes,
    const otx_texel_map *edge, const otx_corner *start, const otx_corner *end,
    int32_t turns, otx_strip *out);

/* What a side of type 2k (`other` false) or 2k + 1 (true) shows at t, depth;
 * t in [0, side), depth in [-reach, reach). */
static inline int32_t
otx_strip_texel(const otx_strip *strip, bool other, int32_t t, int32_t depth)
{
    const int32_t side = strip->map.width, reach = strip->map.height / 2;

    return other
               ? otx_texel_map_at(&strip->map, side - 1 - t, reach - 1 - depth)
               : otx_texel_map_at(&strip->map, t, reach + depth);
}

#endif

/* frame.h -- what the sides and corners of a tile decide.
 *
 * Side s of a tile has its own axes: t along it, counter-clockwise, and depth
 * into the tile. Corner i has those of side i. Everything within a gutter's
 * width of an edge depends on the type of the edge (and of its ends) only, on
 * both sides of it, and within `core` of a vertex on the vertex only. That is
 * why tiles meet exactly, whatever the insides are. */
#ifndef OTX_TILING_FRAME_H
#define OTX_TILING_FRAME_H

#include "image/tile_layout.h"
#include "tiling/strip.h"

/* The corners and strips of a set. */
typedef struct otx_frame_kit
{
    otx_strip_sizes sizes;
    int32_t boundary_count, corner_count;
    otx_corner *corners; /* [corner_count] */
    otx_strip *strips;   /* [boundary_count * corner_count^2 * 4], see
                          * otx_frame_strip_number */
} otx_frame_kit;

/* Of boundary `k` between the corners `start` (t = 0) and `end`, lying `turns`
 * quarter turns from the rows. */
static inline int32_t
otx_frame_strip_number(
    const otx_frame_kit *kit, int32_t k, int32_t start, int32_t end,
    int32_t turns)
{
    return ((k * kit->corner_count + start) * kit->corner_count + end) * 4 +
           turns;
}

/* The kind of most corners: the first whole one, if there is one. */
static inline int32_t
otx_frame_usual_corner(const otx_frame_kit *kit)
{
    return kit->corner_count > 1 ? 1 : 0;
}

/* Texels around a corner that nothing else may cover. */
static inline int32_t
otx_frame_hold(const otx_frame_kit *kit, int32_t corner)
{
    return kit->corners[corner].whole ? kit->sizes.hold : kit->sizes.core;
}

/* A place in a tile in the axes of a side. */
typedef struct otx_frame_place
{
    int32_t t, depth;
} otx_frame_place;

static inline otx_frame_place
otx_frame_axes(int32_t side_texels, int32_t side, int32_t x, int32_t y)
{
    const int32_t last = side_texels - 1;

    switch (side)
    {
    case 0:
        return (otx_frame_place){x, y};
    case 1:
        return (otx_frame_place){y, last - x};
    case 2:
        return (otx_frame_place){last - x, last - y};
    default:
        return (otx_frame_place){last - y, x};
    }
}

/* The strip of a side of the tile `name`. */
static inline const otx_strip *
otx_frame_strip(
    const otx_frame_kit *kit, const otx_tile_name *name, int32_t side)
{
    const int32_t type = name->sides[side];
    const int32_t a = name->corners[side], b = name->corners[(side + 1) & 3];
    const int32_t start = type & 1 ? b : a, end = type & 1 ? a : b;

    return &kit->strips[otx_frame_strip_number(
        kit, type >> 1, start, end, (side + 2 * (type & 1)) & 3)];
}

/* What side `side` shows at t in [0, side), depth in [-reach, reach). */
static inline int32_t
otx_frame_side_texel(
    const otx_frame_kit *kit, const otx_tile_name *name, int32_t side,
    otx_frame_place at)
{
    return otx_strip_texel(
        otx_frame_strip(kit, name, side), name->sides[side] & 1, at.t,
        at.depth);
}

/* The side that (x, y) is nearest to, the lowest of several. Coordinates are
 * those of the tile, from -gutter to side + gutter - 1. */
int32_t otx_frame_nearest(const otx_frame_kit *kit, int32_t x, int32_t y);

/* The texel of the frame of tile `name` at (x, y), in its gutter or less than
 * a gutter's width inside. */
int32_t otx_frame_texel(
    const otx_frame_kit *kit, const otx_tile_name *name, int32_t x, int32_t y);

#endif

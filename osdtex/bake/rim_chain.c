/* rim_chain.c -- leaf edges along an edge of the cage, and common knots. */
#include "bake/rim_chain.h"

/* How far a rim may be from texels' middles or borders: coordinates are rounded
 * to floats. */
static const double OFF = 0.01;

static int32_t
vert_at(const otx_level *leaf, const otx_mip_rim *edge, int32_t end)
{
    const int32_t size = otx_level_face_size(leaf, edge->face);

    return leaf
        ->face_verts[leaf->face_first[edge->face] + (edge->edge + end) % size];
}

/* Turns about the end of a leaf edge, way 1, or its beginning, way 0, through
 * the faces of its chart to the rim's next leaf edge. False where the edge of
 * the cage ends. */
static bool
go_on(const otx_layout *layout, int way, otx_mip_rim *edge)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t end = vert_at(leaf, edge, way);
    otx_mip_rim at = *edge;

    if (end < layout->surface->levels[0].vert_count)
        return false;
    for (;;)
    {
        const int32_t size = otx_level_face_size(leaf, at.face);
        const int32_t side = (at.edge + (way ? 1 : size - 1)) % size;
        const int32_t first = leaf->face_first[at.face];
        int32_t other, k = 0;

        if (layout->rim[first + side])
        {
            *edge = (otx_mip_rim){at.face, side};
            return true;
        }
        other = otx_layout_across(layout, at.face, side);
        if (other < 0 || other == edge->face)
            return false;
        while (leaf->face_edges[leaf->face_first[other] + k] !=
               leaf->face_edges[first + side])
            ++k;
        at = (otx_mip_rim){other, k};
    }
}

otx_rim_chain
otx_rim_chain_of(const otx_layout *layout, const otx_mip_rim *edge)
{
    const int32_t count = 1 << (layout->surface->level_count - 1);
    otx_mip_rim at = *edge;
    int32_t index = 0;

    while (index < count && go_on(layout, 0, &at))
        ++index;
    return index < count ? (otx_rim_chain){count, index}
                         : (otx_rim_chain){1, 0};
}

otx_mip_rim
otx_rim_chain_step(
    const otx_layout *layout, const otx_mip_rim *edge, int32_t steps)
{
    otx_mip_rim at = *edge;

    for (; steps > 0 && go_on(layout, 1, &at); --steps)
        ;
    for (; steps < 0 && go_on(layout, 0, &at); ++steps)
        ;
    return at;
}

static bool
is_whole(double x)
{
    return fabs(x - floor(x + 0.5)) < OFF;
}

otx_rim_way
otx_rim_way_of(const otx_vec2 ends[2])
{
    const double dx = fabs(ends[1].x - ends[0].x);
    const double dy = fabs(ends[1].y - ends[0].y);
    const double sum = ends[0].x + ends[0].y, less = ends[0].x - ends[0].y;

    if ((dx < OFF && is_whole(ends[0].x)) || (dy < OFF && is_whole(ends[0].y)))
        return OTX_RIM_STRAIGHT;
    if (fabs(dx - dy) > OFF)
        return OTX_RIM_ANY;
    /* x + y or x - y is the same all along it. */
    return is_whole(
               (ends[1].x - ends[0].x) * (ends[1].y - ends[0].y) < 0.0 ? sum
                                                                       : less)
               ? OTX_RIM_DIAGONAL
               : OTX_RIM_ANY;
}

int32_t
otx_rim_knots(double n, double m)
{
    int32_t a = (int32_t)(n + 0.5), b = (int32_t)(m + 0.5);
    const int32_t least = a < b ? a : b, most = a < b ? b : a;

    if (!(n < INT32_MAX / 2) || !(m < INT32_MAX / 2) || least < 1 ||
        !is_whole(n) || !is_whole(m))
        return 0;
    while (b != 0)
    {
        const int32_t rest = a % b;

        a = b;
        b = rest;
    }
    return least / a % 2 == 1 && most / a % 2 == 1 ? a : 0;
}

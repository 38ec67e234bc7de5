/* frame.c -- corners where two sides are near, else the nearest strip. */
#include "tiling/frame.h"

int32_t
otx_frame_nearest(const otx_frame_kit *kit, int32_t x, int32_t y)
{
    int32_t best = 0, least = INT32_MAX;

    for (int32_t s = 0; s < 4; ++s)
    {
        const int32_t depth = otx_frame_axes(kit->sizes.side, s, x, y).depth;

        if (depth < least)
        {
            least = depth;
            best = s;
        }
    }
    return best;
}

int32_t
otx_frame_texel(
    const otx_frame_kit *kit, const otx_tile_name *name, int32_t x, int32_t y)
{
    const int32_t core = kit->sizes.core;
    int32_t side;

    for (int32_t i = 0; i < 4; ++i)
    {
        const otx_frame_place p = otx_frame_axes(kit->sizes.side, i, x, y);

        if (p.t < core && p.depth < core)
            return otx_corner_texel(
                &kit->corners[name->corners[i]],
                x - (i == 1 || i == 2 ? kit->sizes.side : 0),
                y - (i >= 2 ? kit->sizes.side : 0));
    }
    side = otx_frame_nearest(kit, x, y);
    return otx_frame_side_texel(
        kit, name, side, otx_frame_axes(kit->sizes.side, side, x, y));
}

/* corner.c -- a sector that agrees with itself, turned into a whole. */
#include "tiling/corner.h"

enum
{
    /* Texels beside each ray that show P as it is. Two, so that a bilinear
     * sample on the ray sees nothing else. */
    RAY = 2
};

/* Lays P and P turned over the sector [0, reach)^2. */
static otx_status
lay_sector(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    int32_t reach, otx_quilt *quilt)
{
    const int32_t x = (window.x + reach) % pool->width;
    const int32_t y = (window.y + reach) % pool->height;
    const otx_texel_window sheets[2] = {{x, y, 0}, {x, window.y, 1}};

    OTX_TRY(otx_quilt_create(run, run->scratch, pool, reach, reach, quilt));
    for (int32_t i = 0; i < 2; ++i)
    {
        otx_texel_map map;

        OTX_TRY(otx_texel_map_create(run, run->scratch, reach, reach, &map));
        otx_texel_pool_lay(pool, sheets[i], &map);
        otx_quilt_add(quilt, 0, 0, map);
    }
    for (int32_t j = 0; j < reach; ++j)
        for (int32_t i = 0; i < reach; ++i)
            if (j < RAY || i < RAY)
                quilt->locks[j * reach + i] = j <= i ? 0 : 1;
    otx_quilt_fill(quilt, 0);
    otx_quilt_fill(quilt, 1);
    otx_quilt_price(quilt);
    return OSDTEX_OK;
}

/* D(x, y) = D(-y - 1, x): turns until the texel lies in the sector. */
static void
turn_around(const otx_quilt *sector, otx_texel_map *map)
{
    const int32_t reach = sector->width;
    int32_t *texel = map->texels;

    for (int32_t y = -reach; y < reach; ++y)
        for (int32_t x = -reach; x < reach; ++x)
        {
            int32_t i = x, j = y;

            while (i < 0 || j < 0)
            {
                const int32_t turned = -j - 1;

                j = i;
                i = turned;
            }
            *texel++ = otx_quilt_texel(sector, i, j);
        }
}

otx_status
otx_corner_build(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    int32_t reach, otx_corner *out)
{
    otx_arena_mark mark;
    otx_quilt sector;

    OTX_TRY(
        otx_texel_map_create(run, run->arena, 2 * reach, 2 * reach, &out->map));
    /* After the result, whose arena may be the same one. */
    mark = otx_arena_here(run->scratch);
    OTX_TRY(lay_sector(run, pool, window, reach, &sector));
    OTX_TRY(otx_quilt_expand(run, &sector, 0));
    turn_around(&sector, &out->map);
    out->whole = false;
    out->cost = sector.cost;
    out->seam = otx_quilt_measure(&sector).mean;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_corner_lay(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    int32_t reach, otx_corner *out)
{
    *out = (otx_corner){.whole = true};
    OTX_TRY(
        otx_texel_map_create(run, run->arena, 2 * reach, 2 * reach, &out->map));
    otx_texel_pool_lay(pool, window, &out->map);
    return OSDTEX_OK;
}

/* interior.c -- strips over windows, cut by expansion moves. */
#include "tiling/interior.h"

static const char STAGE[] = "tiles";

/* Whether a side may show at a place: as deep as its strip reaches, and not
 * much nearer to another side. */
static bool
is_own(const otx_strip_sizes *s, otx_frame_place p)
{
    const int32_t end = s->side - 1 - p.t;

    return p.depth < s->reach && p.depth < p.t + s->sew &&
           p.depth < end + s->sew;
}

/* A strip as a sheet of the tile. */
static otx_status
lay_side(
    otx_run *run, const otx_frame_kit *kit, const otx_tile_name *name,
    int32_t side, otx_quilt *quilt)
{
    const int32_t n = kit->sizes.side;
    otx_texel_map sheet;
    int32_t *texel;

    OTX_TRY(otx_texel_map_create(run, run->scratch, n, n, &sheet));
    texel = sheet.texels;
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
        {
            const otx_frame_place p = otx_frame_axes(n, side, x, y);

            *texel++ = is_own(&kit->sizes, p)
                           ? otx_frame_side_texel(kit, name, side, p)
                           : OTX_TEXEL_NONE;
        }
    otx_quilt_add(quilt, 0, 0, sheet);
    return OSDTEX_OK;
}

static otx_status
lay_window(
    otx_run *run, const otx_texel_pool *pool, otx_texel_window window,
    otx_quilt *quilt)
{
    otx_texel_map sheet;

    OTX_TRY(otx_texel_map_create(
        run, run->scratch, quilt->width, quilt->height, &sheet));
    otx_texel_pool_lay(pool, window, &sheet);
    otx_quilt_add(quilt, 0, 0, sheet);
    return OSDTEX_OK;
}

/* Whether a corner decides what is seen at (x, y). */
static bool
is_held(
    const otx_frame_kit *kit, const otx_tile_name *name, int32_t x, int32_t y)
{
    for (int32_t i = 0; i < 4; ++i)
    {
        const otx_frame_place p = otx_frame_axes(kit->sizes.side, i, x, y);
        const int32_t hold = otx_frame_hold(kit, name->corners[i]);

        if (kit->corners[name->corners[i]].whole && p.t < hold &&
            p.depth < hold)
            return true;
    }
    return false;
}

static void
lock_rim(const otx_frame_kit *kit, const otx_tile_name *name, otx_quilt *quilt)
{
    const int32_t n = kit->sizes.side, gutter = kit->sizes.gutter;
    uint8_t *lock = quilt->locks;

    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x, ++lock)
            if (x < gutter || y < gutter || x >= n - gutter ||
                y >= n - gutter || is_held(kit, name, x, y))
                *lock = (uint8_t)otx_frame_nearest(kit, x, y);
}

static void
take_texels(
    const otx_frame_kit *kit, const otx_tile_name *name, const otx_quilt *quilt,
    otx_texel_map *map)
{
    const int32_t n = kit->sizes.side, gutter = kit->sizes.gutter;
    int32_t *texel = map->texels;

    for (int32_t y = -gutter; y < n + gutter; ++y)
        for (int32_t x = -gutter; x < n + gutter; ++x)
        {
            const bool inside =
                x >= gutter && y >= gutter && x < n - gutter && y < n - gutter;

            *texel++ = inside ? otx_quilt_texel(quilt, x, y)
                              : otx_frame_texel(kit, name, x, y);
        }
}

otx_status
otx_interior_fill(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    const otx_patch_search *patches, const otx_interior_options *options,
    const otx_texel_window *windows, int32_t window_count, otx_texel_map *map,
    otx_quilt_seams *seams)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_frame_kit *kit = search->kit;
    otx_quilt *quilt = OTX_NEW(run->scratch, otx_quilt, 1);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_quilt_create(
        run, run->scratch, search->pool, kit->sizes.side, kit->sizes.side,
        quilt));
    for (int32_t side = 0; side < 4; ++side)
        OTX_TRY(lay_side(run, kit, name, side, quilt));
    for (int32_t i = 0; i < window_count; ++i)
        OTX_TRY(lay_window(run, search->pool, windows[i], quilt));
    lock_rim(kit, name, quilt);
    for (int32_t s = 0; s <= 4; ++s)
        otx_quilt_fill(quilt, s);
    otx_quilt_price(quilt);
    OTX_TRY(otx_quilt_settle(run, quilt, options->rounds));
    if (patches)
        OTX_TRY(otx_patchwork_mend(run, patches, &options->patchwork, quilt));
    take_texels(kit, name, quilt, map);
    if (seams)
        *seams = otx_quilt_measure(quilt);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_interior_build(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    const otx_patch_search *patches, const otx_interior_options *options,
    otx_texel_map *map, otx_quilt_seams *seams)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t room = options->windows + 4 * options->side_windows;
    otx_texel_window *windows = OTX_NEW(run->scratch, otx_texel_window, room);
    int32_t count;

    OTX_TRY(otx_run_ok(run));
    count = otx_ring_search_find(
        run->scratch, search, name, OTX_RING_SEARCH_SIDES, options->windows,
        windows);
    for (int32_t side = 0; side < 4 && count >= 0; ++side)
    {
        const int32_t more = otx_ring_search_find(
            run->scratch, search, name, 1 << side, options->side_windows,
            windows + count);

        count = more < 0 ? -1 : count + more;
    }
    if (count < 0)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_interior_fill(
        run, search, name, patches, options, windows, count, map, seams));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

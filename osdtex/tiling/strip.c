/* strip.c -- an edge sewn to its corners. */
#include "tiling/strip.h"

enum
{
    EDGE,
    START,
    END
};

static bool
is_within(int32_t half, int32_t x, int32_t y)
{
    return x >= -half && x < half && y >= -half && y < half;
}

/* What a corner shows at (x, y) along axes that are turned. */
static int32_t
turned_texel(const otx_corner *corner, int32_t turns, int32_t x, int32_t y)
{
    for (; turns > 0; --turns)
    {
        const int32_t old = x;

        x = -y - 1;
        y = old;
    }
    return otx_corner_texel(corner, x, y);
}

/* The corner around t = `at` as a sheet. */
static otx_status
lay_corner(
    otx_run *run, const otx_strip_sizes *sizes, const otx_corner *corner,
    int32_t turns, int32_t at, otx_quilt *quilt)
{
    otx_texel_map sheet;
    int32_t *texel;

    OTX_TRY(otx_texel_map_create(
        run, run->scratch, sizes->side, 2 * sizes->reach, &sheet));
    texel = sheet.texels;
    for (int32_t d = -sizes->reach; d < sizes->reach; ++d)
        for (int32_t t = 0; t < sizes->side; ++t)
        {
            const int32_t x = t - at;

            *texel++ = is_within(sizes->sew, x, d)
                           ? turned_texel(corner, turns, x, d)
                           : OTX_TEXEL_NONE;
        }
    otx_quilt_add(quilt, 0, 0, sheet);
    return OSDTEX_OK;
}

static void
lock_ends(
    const otx_strip_sizes *sizes, const otx_corner *start,
    const otx_corner *end, otx_quilt *quilt)
{
    const int32_t first = start->whole ? sizes->hold : sizes->core;
    const int32_t last = end->whole ? sizes->hold : sizes->core;
    uint8_t *lock = quilt->locks;

    for (int32_t d = 0; d < quilt->height; ++d)
        for (int32_t t = 0; t < quilt->width; ++t, ++lock)
        {
            const int32_t y = d - sizes->reach;

            if (is_within(first, t, y))
                *lock = START;
            else if (is_within(last, t - sizes->side, y))
                *lock = END;
        }
}

otx_status
otx_strip_build(
    otx_run *run, const otx_texel_pool *pool, const otx_strip_sizes *sizes,
    const otx_texel_map *edge, const otx_corner *start, const otx_corner *end,
    int32_t turns, otx_strip *out)
{
    otx_arena_mark mark;
    otx_quilt quilt;
    int32_t *texel;

    OTX_TRY(otx_texel_map_create(
        run, run->arena, sizes->side, 2 * sizes->reach, &out->map));
    /* After the result, whose arena may be the same one. */
    mark = otx_arena_here(run->scratch);
    OTX_TRY(otx_quilt_create(
        run, run->scratch, pool, sizes->side, 2 * sizes->reach, &quilt));
    otx_quilt_add(&quilt, 0, 0, *edge);
    OTX_TRY(lay_corner(run, sizes, start, turns, 0, &quilt));
    OTX_TRY(lay_corner(run, sizes, end, turns, sizes->side, &quilt));
    lock_ends(sizes, start, end, &quilt);
    otx_quilt_fill(&quilt, START);
    otx_quilt_fill(&quilt, END);
    otx_quilt_fill(&quilt, EDGE);
    otx_quilt_price(&quilt);
    OTX_TRY(otx_quilt_expand(run, &quilt, START));
    OTX_TRY(otx_quilt_expand(run, &quilt, END));
    texel = out->map.texels;
    for (int32_t d = 0; d < quilt.height; ++d)
        for (int32_t t = 0; t < quilt.width; ++t)
            *texel++ = otx_quilt_texel(&quilt, t, d);
    out->cost = quilt.cost;
    out->seam = otx_quilt_measure(&quilt).mean;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

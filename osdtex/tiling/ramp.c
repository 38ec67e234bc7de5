/* ramp.c -- strips over a window by opacity. */
#include "tiling/ramp.h"

enum
{
    CLOSE = 4 /* texels over which a strip ends where it is like the window */
};

typedef struct painter
{
    const otx_texel_pool *pool;
    const otx_frame_kit *kit;
    const otx_tile_name *name;
    otx_texel_window window;
    int32_t *ends[4]; /* [side] depth at which the columns of a side end */
} painter;

static int32_t
clamp(int32_t value, int32_t last)
{
    return value < 0 ? 0 : value > last ? last : value;
}

/* The texel of the window at (x, y); its rim goes on in the gutter. */
static int32_t
window_texel(const painter *p, int32_t x, int32_t y)
{
    const int32_t side = p->kit->sizes.side;

    return otx_texel_pool_window(
        p->pool, p->window, side, side, clamp(x, side - 1), clamp(y, side - 1));
}

/* 0 at 0 and below, 1 at `length` and beyond. */
static double
ramp(int32_t at, int32_t length)
{
    return at <= 0 ? 0.0 : at >= length ? 1.0 : (double)at / length;
}

static double
opacity(const painter *p, int32_t side, otx_frame_place at)
{
    const otx_strip_sizes *s = &p->kit->sizes;
    const int32_t last = s->side - 1;

    if (at.t <= 0 || at.t >= last || at.depth >= s->reach)
        return 0.0;
    return ramp(at.t, s->reach) * ramp(last - at.t, s->reach) *
           ramp(s->reach - at.depth, s->reach) *
           ramp(p->ends[side][at.t] + CLOSE - at.depth, CLOSE);
}

/* Where each column of a side is most like the window, beyond the gutter. */
static void
find_ends(const painter *p, int32_t side)
{
    const otx_strip_sizes *s = &p->kit->sizes;

    for (int32_t t = 0; t < s->side; ++t)
    {
        double least = INFINITY;

        for (int32_t depth = s->gutter; depth < s->reach; ++depth)
        {
            const int32_t last = s->side - 1;
            const int32_t xs[4] = {t, last - depth, last - t, depth};
            const int32_t ys[4] = {depth, t, last - depth, last - t};
            const double square = otx_texel_pool_square(
                p->pool,
                otx_frame_side_texel(
                    p->kit, p->name, side, (otx_frame_place){t, depth}),
                window_texel(p, xs[side], ys[side]));

            if (square < least)
            {
                least = square;
                p->ends[side][t] = depth;
            }
        }
    }
}

/* Side 0 lies over side 1, and so on; the window at the bottom. */
static void
paint_texel(const painter *p, int32_t x, int32_t y, float *out)
{
    const size_t channels = (size_t)p->pool->channels;
    const float *colours = p->pool->linear;
    const float *ground = colours + channels * (size_t)window_texel(p, x, y);

    for (size_t c = 0; c < channels; ++c)
        out[c] = ground[c];
    for (int32_t side = 3; side >= 0; --side)
    {
        const otx_frame_place at =
            otx_frame_axes(p->kit->sizes.side, side, x, y);
        const double a = opacity(p, side, at);
        const float *over;

        if (!(a > 0.0))
            continue;
        over = colours + channels * (size_t)otx_frame_side_texel(
                                        p->kit, p->name, side, at);
        for (size_t c = 0; c < channels; ++c)
            out[c] = (float)(a * over[c] + (1.0 - a) * out[c]);
    }
}

otx_status
otx_ramp_paint(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    int32_t x, int32_t y, otx_image *image)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t side = search->kit->sizes.side;
    const int32_t gutter = search->kit->sizes.gutter;
    int32_t *ends = OTX_NEW(run->scratch, int32_t, 4 * side);
    painter p = {.pool = search->pool, .kit = search->kit, .name = name};

    if (!ends || otx_ring_search_find(
                     run->scratch, search, name, OTX_RING_SEARCH_SIDES, 1,
                     &p.window) < 0)
        return otx_fail_memory(run, "tiles");
    for (int32_t s = 0; s < 4; ++s)
    {
        p.ends[s] = ends + s * side;
        find_ends(&p, s);
    }
    for (int32_t j = -gutter; j < side + gutter; ++j)
        for (int32_t i = -gutter; i < side + gutter; ++i)
            paint_texel(
                &p, i, j, otx_image_at(image, x + gutter + i, y + gutter + j));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

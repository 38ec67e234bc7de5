/* window_search.c -- exhaustive search for windows in a small picture. */
#include "quilt/window_search.h"

#include <stdlib.h>

enum
{
    SMALL_SIDE = 112, /* of the small picture, about */
    STRIDE = 2 /* between texels that are compared when places are refined */
};

/* Adds the mean colour of a block of a map to `out`; false when it has holes.
 */
static bool
block_mean(
    const otx_texel_pool *pool, const otx_texel_map *map, int32_t x, int32_t y,
    int32_t size, float out[3])
{
    double sum[3] = {0.0, 0.0, 0.0};

    for (int32_t j = y; j < y + size; ++j)
        for (int32_t i = x; i < x + size; ++i)
        {
            const int32_t texel = otx_texel_map_at(map, i, j);

            if (texel == OTX_TEXEL_NONE)
                return false;
            for (int k = 0; k < 3; ++k)
                sum[k] += (double)pool->colors[3 * (size_t)texel + (size_t)k];
        }
    for (int k = 0; k < 3; ++k)
        out[k] = (float)(sum[k] / ((double)size * size));
    return true;
}

otx_status
otx_window_search_shrink(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool,
    const otx_texel_map *map, int32_t factor, otx_image *out, uint8_t *known)
{
    OTX_TRY(otx_image_create(
        run, arena, map->width / factor, map->height / factor, 3, out));
    for (int32_t y = 0; y < out->height; ++y)
        for (int32_t x = 0; x < out->width; ++x)
        {
            float *to = otx_image_at(out, x, y);
            const bool whole =
                block_mean(pool, map, factor * x, factor * y, factor, to);

            if (!whole)
                to[0] = to[1] = to[2] = 0.0f;
            if (known)
                known[(size_t)y * (size_t)out->width + (size_t)x] = whole;
        }
    return OSDTEX_OK;
}

otx_status
otx_window_search_create(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool, int32_t side,
    otx_window_search *out)
{
    const int32_t least =
        pool->width < pool->height ? pool->width : pool->height;
    otx_texel_map all;

    *out = (otx_window_search){.pool = pool, .side = side};
    out->factor = least / SMALL_SIDE > 1 ? least / SMALL_SIDE : 1;
    OTX_TRY(otx_texel_map_create(
        run, run->scratch, pool->width, pool->height, &all));
    otx_texel_pool_lay(pool, (otx_texel_window){0, 0, 0}, &all);
    return otx_window_search_shrink(
        run, arena, pool, &all, out->factor, &out->small, NULL);
}

/* One search: what is looked for, and the cost of every place. */
typedef struct hunt
{
    const otx_window_search *search;
    otx_image what;
    const uint8_t *known; /* of `what` */
    int32_t columns, rows;
    double *cost; /* [rows * columns] */
} hunt;

static double
place_cost(const hunt *h, int32_t x, int32_t y)
{
    const otx_image *in = &h->search->small;
    const uint8_t *known = h->known;
    double sum = 0.0;

    for (int32_t j = 0; j < h->what.height; ++j)
    {
        const float *what = otx_image_at(&h->what, 0, j);
        const int32_t row = otx_image_wrap(y + j, in->height);

        for (int32_t i = 0; i < h->what.width; ++i, what += 3)
            if (*known++)
                sum += otx_image_distance_sq(
                    what,
                    otx_image_at(in, otx_image_wrap(x + i, in->width), row));
    }
    return sum;
}

static otx_status
hunt_row(void *context, int64_t y, otx_worker *worker)
{
    const hunt *h = context;

    (void)worker;
    for (int32_t x = 0; x < h->columns; ++x)
        h->cost[y * h->columns + x] = place_cost(h, x, (int32_t)y);
    return OSDTEX_OK;
}

/* The cheapest place, which is then struck out with what is near it; -1 when
 * none is left. */
static int64_t
take_best(hunt *h, int32_t apart)
{
    const int64_t count = (int64_t)h->columns * h->rows;
    int64_t best = -1;

    for (int64_t i = 0; i < count; ++i)
        if (isfinite(h->cost[i]) && (best < 0 || h->cost[i] < h->cost[best]))
            best = i;
    for (int64_t i = 0; best >= 0 && i < count; ++i)
        if (llabs(i % h->columns - best % h->columns) < apart &&
            llabs(i / h->columns - best / h->columns) < apart)
            h->cost[i] = INFINITY;
    return best;
}

static double
exact_cost(
    const otx_window_search *s, const otx_texel_map *window,
    otx_texel_window place)
{
    const float *colors = s->pool->colors;
    double sum = 0.0;

    for (int32_t y = 0; y < s->side; y += STRIDE)
        for (int32_t x = 0; x < s->side; x += STRIDE)
        {
            const int32_t texel = otx_texel_map_at(window, x, y);

            if (texel != OTX_TEXEL_NONE)
                sum += otx_image_distance_sq(
                    colors + 3 * (size_t)texel,
                    colors + 3 * (size_t)otx_texel_pool_window(
                                     s->pool, place, s->side, s->side, x, y));
        }
    return sum;
}

static int32_t
clamped(int32_t x, int32_t places)
{
    return x < 0 ? 0 : x >= places ? places - 1 : x;
}

/* The best place to the texel around one of the small picture. */
static otx_texel_window
refine(
    const otx_window_search *s, const otx_texel_map *window, int32_t x,
    int32_t y)
{
    const int32_t places_x = otx_texel_pool_places_x(s->pool, s->side);
    const int32_t places_y = otx_texel_pool_places_y(s->pool, s->side);
    otx_texel_window best = {0, 0, 0};
    double least = INFINITY;

    for (int32_t dy = -s->factor; dy <= s->factor; ++dy)
        for (int32_t dx = -s->factor; dx <= s->factor; ++dx)
        {
            const otx_texel_window at = {
                clamped(s->factor * x + dx, places_x),
                clamped(s->factor * y + dy, places_y), 0};
            const double cost = exact_cost(s, window, at);

            if (cost < least)
            {
                least = cost;
                best = at;
            }
        }
    return best;
}

otx_status
otx_window_search_find(
    otx_run *run, const otx_window_search *s, const otx_texel_map *window,
    int32_t limit, otx_texel_window *windows, int32_t *count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t f = s->factor, n = s->side / f;
    uint8_t *known = OTX_NEW(run->scratch, uint8_t, (size_t)n * (size_t)n);
    hunt h = {.search = s, .known = known};

    h.columns = (otx_texel_pool_places_x(s->pool, s->side) - 1) / f + 1;
    h.rows = (otx_texel_pool_places_y(s->pool, s->side) - 1) / f + 1;
    h.cost = OTX_NEW(run->scratch, double, (int64_t)h.columns *h.rows);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_window_search_shrink(
        run, run->scratch, s->pool, window, f, &h.what, known));
    OTX_TRY(otx_pool_for(run->pool, h.rows, hunt_row, &h));
    for (*count = 0; *count < limit; ++*count)
    {
        const int64_t at = take_best(&h, n / 6 + 1);

        if (at < 0)
            break;
        windows[*count] = refine(
            s, window, (int32_t)(at % h.columns), (int32_t)(at / h.columns));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

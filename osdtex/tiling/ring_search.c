/* ring_search.c -- error maps of the strips, and sums of four of them. */
#include "tiling/ring_search.h"
#include "math/fft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    PLANES = 4, /* L, a, b, and the squared length */
    BLOCK = 8   /* texels a side, of which one candidate is kept */
};

static const char STAGE[] = "tiles";

/* The part of a side's strip that is compared: depth from the gutter's width
 * to the reach. As a raster in the tile, and where that lies in it. */
typedef struct band
{
    int32_t x, y, width, height;
} band;

static band
band_of(const otx_strip_sizes *s, int32_t side)
{
    const int32_t depth = s->reach - s->gutter, far = s->side - s->reach;

    switch (side)
    {
    case 0:
        return (band){0, s->gutter, s->side, depth};
    case 1:
        return (band){far, 0, depth, s->side};
    case 2:
        return (band){0, far, s->side, depth};
    default:
        return (band){s->gutter, 0, depth, s->side};
    }
}

/* What all maps are made with. */
typedef struct maker
{
    otx_run *run;
    otx_ring_search *search;
    otx_fft *fft;
    float *spectra[PLANES];
    float *planes[PLANES];
    float *scratch;
    float mean[3]; /* taken off so that sums stay small */
    double own;    /* squared length of the band at hand */
} maker;

static void
find_mean(maker *m)
{
    const otx_texel_pool *pool = m->search->pool;
    const size_t count = (size_t)pool->width * (size_t)pool->height;
    double sum[3] = {0.0, 0.0, 0.0};

    for (size_t i = 0; i < count; ++i)
        for (int32_t c = 0; c < 3; ++c)
            sum[c] += pool->colors[3 * i + (size_t)c];
    for (int32_t c = 0; c < 3; ++c)
        m->mean[c] = (float)(sum[c] / (double)count);
}

/* Puts the texel `number` into the planes at `at`. */
static void
put_texel(maker *m, int32_t number, size_t at, bool is_picture)
{
    const float *color = m->search->pool->colors + 3 * (size_t)number;
    float square = 0.0f;

    for (int32_t c = 0; c < 3; ++c)
    {
        const float value = color[c] - m->mean[c];

        m->planes[c][at] = is_picture ? value : -2.0f * value;
        square += value * value;
    }
    m->planes[3][at] = is_picture ? square : 1.0f;
    m->own += square;
}

static otx_status
prepare(maker *m)
{
    const otx_texel_pool *pool = m->search->pool;
    size_t plane_floats;

    OTX_TRY(otx_fft_create(
        m->run, m->run->arena, pool->width, pool->height, &m->fft));
    m->search->stride = otx_fft_stride(m->fft);
    plane_floats = m->search->stride * (size_t)pool->height;
    m->scratch =
        OTX_NEW(m->run->scratch, float, otx_fft_scratch_floats(m->fft));
    OTX_TRY(otx_run_ok(m->run));
    for (int32_t p = 0; p < PLANES; ++p)
    {
        m->planes[p] = OTX_ZNEW(m->run->scratch, float, plane_floats);
        m->spectra[p] =
            OTX_NEW(m->run->scratch, float, otx_fft_spectrum_floats(m->fft));
        OTX_TRY(otx_run_ok(m->run));
    }
    find_mean(m);
    for (int32_t y = 0; y < pool->height; ++y)
        for (int32_t x = 0; x < pool->width; ++x)
            put_texel(
                m, y * pool->width + x,
                (size_t)y * m->search->stride + (size_t)x, true);
    for (int32_t p = 0; p < PLANES; ++p)
        otx_fft_forward(m->fft, 1.0f, m->planes[p], m->scratch, m->spectra[p]);
    return OSDTEX_OK;
}

/* Lays the band of a strip of `type` as side `side` into the planes. */
static void
lay_band(maker *m, int32_t type, int32_t side)
{
    const otx_frame_kit *kit = m->search->kit;
    const band b = band_of(&kit->sizes, side);
    const size_t rows = (size_t)b.height * m->search->stride;
    const int32_t usual = otx_frame_usual_corner(kit);
    const otx_tile_name name = {
        {type, type, type, type}, {usual, usual, usual, usual}};

    for (int32_t p = 0; p < PLANES; ++p)
        memset(m->planes[p], 0, rows * sizeof(float));
    m->own = 0.0;
    for (int32_t y = 0; y < b.height; ++y)
        for (int32_t x = 0; x < b.width; ++x)
            put_texel(
                m,
                otx_frame_side_texel(
                    kit, &name, side,
                    otx_frame_axes(kit->sizes.side, side, b.x + x, b.y + y)),
                (size_t)y * m->search->stride + (size_t)x, false);
}

static otx_status
make_map(maker *m, int32_t type, int32_t side)
{
    const otx_texel_pool *pool = m->search->pool;
    const band b = band_of(&m->search->kit->sizes, side);
    const size_t floats = m->search->stride * (size_t)pool->height;
    const double area = (double)b.width * b.height;
    const float share =
        (float)(1.0 / ((double)pool->width * pool->height * area));
    float *map = OTX_NEW(m->run->arena, float, floats);
    float own;

    OTX_TRY(otx_run_ok(m->run));
    lay_band(m, type, side);
    own = (float)(m->own / area);
    otx_fft_correlate(
        m->fft, PLANES, b.height, m->planes, (const float *const *)m->spectra,
        m->scratch, map);
    for (size_t i = 0; i < floats; ++i)
        map[i] = map[i] * share + own;
    m->search->maps[4 * type + side] = map;
    return OSDTEX_OK;
}

/* Places of windows, as far as exemplar and user allow. */
static otx_status
set_bounds(otx_run *run, otx_ring_search *search, const otx_ring_region *region)
{
    const int32_t side = search->kit->sizes.side;
    const bool whole = region->x1 == 0 && region->y1 == 0;

    search->x1 = otx_texel_pool_places_x(search->pool, side);
    search->y1 = otx_texel_pool_places_y(search->pool, side);
    if (!whole)
    {
        search->x0 = region->x0 > 0 ? region->x0 : 0;
        search->y0 = region->y0 > 0 ? region->y0 : 0;
        if (search->x1 > region->x1 - side + 2)
            search->x1 = region->x1 - side + 2;
        if (search->y1 > region->y1 - side + 2)
            search->y1 = region->y1 - side + 2;
    }
    if (search->x0 < search->x1 && search->y0 < search->y1)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "the background region must hold a window of %d x %d texels inside "
        "the picture of %d x %d; make it larger or the tiles smaller",
        (int)side, (int)side, (int)search->pool->width,
        (int)search->pool->height);
}

otx_status
otx_ring_search_create(
    otx_run *run, const otx_texel_pool *pool, const otx_frame_kit *kit,
    const otx_tile_layout *layout, const otx_ring_region *region,
    otx_ring_search *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t types = otx_tile_layout_types(layout);
    maker m = {.run = run, .search = out};

    *out = (otx_ring_search){
        .pool = pool,
        .kit = kit,
        .layout = *layout,
        .maps = OTX_ZNEW(run->arena, float *, 4 * types),
        .turns_step = layout->oriented ? 2 : 1,
    };
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(set_bounds(run, out, region));
    OTX_TRY(prepare(&m));
    for (int32_t type = 0; type < types; ++type)
        for (int32_t side = 0; side < 4; ++side)
            OTX_TRY(make_map(&m, type, side));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* The maps of a tile's sides for windows turned by `turns`, moved so that all
 * are indexed by the window's place. Turning the tile back makes the window
 * upright and side s into side s - turns. */
typedef struct stack
{
    const float *maps[4];
    int32_t x[4], y[4];
    int32_t count;
} stack;

static stack
stack_up(
    const otx_ring_search *search, const otx_tile_name *name, int32_t sides,
    int32_t turns)
{
    stack s = {.count = 0};

    for (int32_t side = 0; side < 4; ++side)
    {
        const int32_t as = (side - turns) & 3;
        const band b = band_of(&search->kit->sizes, as);

        if (!(sides >> side & 1))
            continue;
        s.maps[s.count] = search->maps[4 * name->sides[side] + as];
        s.x[s.count] = b.x;
        s.y[s.count++] = b.y;
    }
    return s;
}

static inline float
look_up(const otx_ring_search *search, const stack *s, int32_t x, int32_t y)
{
    float sum = 0.0f;

    for (int32_t i = 0; i < s->count; ++i)
    {
        int32_t u = x + s->x[i], v = y + s->y[i];

        u = u >= search->pool->width ? u - search->pool->width : u;
        v = v >= search->pool->height ? v - search->pool->height : v;
        sum += s->maps[i][(size_t)v * search->stride + (size_t)u];
    }
    return sum;
}

double
otx_ring_search_error(
    const otx_ring_search *search, const otx_tile_name *name, int32_t sides,
    otx_texel_window window)
{
    const stack s = stack_up(search, name, sides, window.turns);

    return s.count > 0
               ? (double)look_up(search, &s, window.x, window.y) / s.count
               : 0.0;
}

/* The best place of each block of BLOCK x BLOCK. */
typedef struct candidate
{
    float error;
    otx_texel_window window;
} candidate;

static int32_t
gather(
    const otx_ring_search *search, const otx_tile_name *name, int32_t sides,
    candidate *out)
{
    int32_t count = 0;

    for (int32_t turns = 0; turns < 4; turns += search->turns_step)
    {
        const stack s = stack_up(search, name, sides, turns);

        for (int32_t y0 = search->y0; y0 < search->y1; y0 += BLOCK)
            for (int32_t x0 = search->x0; x0 < search->x1; x0 += BLOCK)
            {
                candidate best = {INFINITY, {x0, y0, turns}};

                for (int32_t y = y0; y < y0 + BLOCK && y < search->y1; ++y)
                    for (int32_t x = x0; x < x0 + BLOCK && x < search->x1; ++x)
                    {
                        const float error = look_up(search, &s, x, y);

                        if (error < best.error)
                            best = (candidate){error, {x, y, turns}};
                    }
                out[count++] = best;
            }
    }
    return count;
}

static bool
is_near(otx_texel_window a, otx_texel_window b)
{
    return a.turns == b.turns && abs(a.x - b.x) < BLOCK &&
           abs(a.y - b.y) < BLOCK;
}

int32_t
otx_ring_search_find(
    otx_arena *scratch, const otx_ring_search *search,
    const otx_tile_name *name, int32_t sides, int32_t count,
    otx_texel_window *out)
{
    const int64_t across = (search->x1 - search->x0) / BLOCK + 1;
    const int64_t up = (search->y1 - search->y0) / BLOCK + 1;
    candidate *list = OTX_NEW(scratch, candidate, 4 * across * up);
    int32_t list_count, found = 0;

    if (!list)
        return -1;
    list_count = gather(search, name, sides, list);
    while (found < count)
    {
        int32_t best = -1;

        for (int32_t i = 0; i < list_count; ++i)
            if (list[i].error < INFINITY &&
                (best < 0 || list[i].error < list[best].error))
                best = i;
        if (best < 0)
            break;
        out[found] = list[best].window;
        for (int32_t i = 0; i < list_count; ++i)
            if (is_near(list[i].window, out[found]))
                list[i].error = INFINITY;
        ++found;
    }
    return found;
}

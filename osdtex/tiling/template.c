/* template.c -- candidates for corners and edges, and the choice. */
#include "tiling/template.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

enum
{
    CORNER_CANDIDATES = 96,
    EDGE_CANDIDATES = 64,
    CORNER_STAGE = 0x7469c002,
    EDGE_STAGE = 0x7469c003
};

static const char STAGE[] = "tiles";

int32_t
otx_template_extra(
    const otx_strip_sizes *sizes, const otx_tileset_options *options)
{
    return options->edge_count * 2 * sizes->reach * sizes->side;
}

/* Mean and spread of the Lab of a window's texels. */
typedef struct look
{
    double mean[3];
    double spread;
} look;

static look
look_at(
    const otx_texel_pool *pool, otx_texel_window window, int32_t width,
    int32_t height)
{
    const double count = (double)width * height;
    double square = 0.0;
    look l = {{0.0, 0.0, 0.0}, 0.0};

    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            const float *lab =
                pool->lab + 3 * (size_t)otx_texel_pool_window(
                                    pool, window, width, height, x, y);

            for (int32_t c = 0; c < 3; ++c)
            {
                l.mean[c] += lab[c] / count;
                square += (double)lab[c] * lab[c] / count;
            }
        }
    for (int32_t c = 0; c < 3; ++c)
        square -= l.mean[c] * l.mean[c];
    l.spread = sqrt(fmax(square, 0.0));
    return l;
}

/* How far a window is from the whole picture: 0 typical. Distances are in
 * units of the picture's own spread. */
static double
oddness(look part, look whole)
{
    double distance = 0.0;

    if (!(whole.spread > 0.0))
        return 0.0;
    for (int32_t c = 0; c < 3; ++c)
        distance +=
            (part.mean[c] - whole.mean[c]) * (part.mean[c] - whole.mean[c]);
    return sqrt(distance) / whole.spread +
           fabs(part.spread / whole.spread - 1.0);
}

/* A search for one corner or one edge: candidates are built by all threads,
 * each in its worker's memory, and only their scores are kept. */
typedef struct contest
{
    const otx_run *run;
    const otx_texel_pool *pool;
    const otx_frame_kit *kit;
    look whole;
    uint64_t element; /* of the random numbers */
    int32_t turns, turns_step;
    otx_texel_window *windows; /* [count] */
    double *scores;            /* [count] */
} contest;

static otx_run
worker_run(const contest *c, otx_worker *worker)
{
    otx_run run = *c->run;

    run.arena = run.scratch = worker->scratch;
    run.pool = NULL;
    return run;
}

static otx_texel_window
draw_window(
    const contest *c, uint32_t stage, int64_t index, int32_t width,
    int32_t height)
{
    const uint64_t element = (c->element << 20) + 4 * (uint64_t)index;
    const uint64_t seed = c->run->seed;
    const int32_t x = otx_texel_pool_places_x(c->pool, width);
    const int32_t y = otx_texel_pool_places_y(c->pool, height);

    return (otx_texel_window){
        (int32_t)(x * otx_random_unit(seed, stage, element)),
        (int32_t)(y * otx_random_unit(seed, stage, element + 1)), 0};
}

/* The cost of a cut counts as much as it is long; what is odd about a window
 * is seen all over it. */
static double
score_of(int64_t cost, double odd)
{
    return ((double)cost + 1.0) * (1.0 + odd);
}

static otx_status
try_corner(void *context, int64_t index, otx_worker *worker)
{
    contest *c = context;
    otx_run run = worker_run(c, worker);
    const int32_t reach = c->kit->sizes.reach, size = 2 * reach;
    const otx_texel_window window =
        draw_window(c, CORNER_STAGE, index, size, size);
    otx_corner corner;

    OTX_TRY(otx_corner_build(&run, c->pool, window, reach, &corner));
    c->windows[index] = window;
    c->scores[index] = score_of(
        corner.cost, oddness(look_at(c->pool, window, size, size), c->whole));
    return OSDTEX_OK;
}

static otx_status
try_edge(void *context, int64_t index, otx_worker *worker)
{
    contest *c = context;
    otx_run run = worker_run(c, worker);
    const otx_strip_sizes *s = &c->kit->sizes;
    const int32_t turns =
        (c->turns +
         c->turns_step *
             (int32_t)(otx_random_bits(run.seed, EDGE_STAGE, (c->element << 20) + 4 * (uint64_t)index + 2) & 3)) &
        3;
    const bool odd = turns & 1;
    otx_texel_window window = draw_window(
        c, EDGE_STAGE, index, odd ? 2 * s->reach : s->side,
        odd ? s->side : 2 * s->reach);
    otx_texel_map edge;
    otx_strip strip;

    window.turns = turns;
    OTX_TRY(
        otx_texel_map_create(&run, run.arena, s->side, 2 * s->reach, &edge));
    otx_texel_pool_lay(c->pool, window, &edge);
    OTX_TRY(otx_strip_build(
        &run, c->pool, s, &edge, &c->kit->corners[0], &c->kit->corners[0],
        &strip));
    c->windows[index] = window;
    c->scores[index] = score_of(
        strip.cost,
        oddness(look_at(c->pool, window, s->side, 2 * s->reach), c->whole));
    return OSDTEX_OK;
}

/* Holds the contest and returns the winner. */
static otx_status
hold(
    otx_run *run, contest *c, int32_t count, otx_pool_body body,
    otx_texel_window *winner)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t best = 0;

    c->run = run;
    c->windows = OTX_NEW(run->scratch, otx_texel_window, count);
    c->scores = OTX_NEW(run->scratch, double, count);
    if (!c->windows || !c->scores)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_pool_for(run->pool, count, body, c));
    for (int32_t i = 1; i < count; ++i)
        if (c->scores[i] < c->scores[best])
            best = i;
    *winner = c->windows[best];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
build_corners(
    otx_run *run, const otx_texel_pool *pool,
    const otx_tileset_options *options, contest *c, int32_t attempt,
    otx_frame_kit *kit)
{
    const int32_t reach = kit->sizes.reach;

    for (int32_t i = 0; i < kit->corner_count; ++i)
    {
        otx_texel_window window;

        if (i == 0 && options->has_corner)
            window = (otx_texel_window){
                (int32_t)floor(options->corner.x + 0.5) - reach,
                (int32_t)floor(options->corner.y + 0.5) - reach, 0};
        else
        {
            c->element = (uint64_t)(attempt * kit->corner_count + i);
            OTX_TRY(hold(run, c, CORNER_CANDIDATES, try_corner, &window));
        }
        OTX_TRY(otx_corner_build(run, pool, window, reach, &kit->corners[i]));
    }
    return OSDTEX_OK;
}

/* The picture along boundary `k`, before its ends are sewn. */
static otx_status
choose_edge(
    otx_run *run, otx_texel_pool *pool, const otx_tileset_options *options,
    const otx_tile_layout *layout, contest *c, int32_t attempt, int32_t k,
    const otx_frame_kit *kit, otx_texel_map *edge)
{
    const bool upright = layout->oriented && k >= kit->boundary_count / 2;
    otx_texel_window window;

    if (k < options->edge_count)
    {
        const otx_tileset_edge *e = &options->edges[k];

        otx_texel_pool_resample(
            pool, e->middle, e->angle,
            e->length > 0.0 ? e->length / kit->sizes.side : 1.0, edge);
        return OSDTEX_OK;
    }
    /* Turned three times, what is upright in the exemplar is upright along a
     * tile's right side. */
    c->turns = upright ? 3 : 0;
    c->turns_step = layout->oriented ? 0 : 1;
    c->element = (uint64_t)(attempt * kit->boundary_count + k);
    OTX_TRY(hold(run, c, EDGE_CANDIDATES, try_edge, &window));
    otx_texel_pool_lay(pool, window, edge);
    return OSDTEX_OK;
}

static otx_status
build_strips(
    otx_run *run, otx_texel_pool *pool, const otx_tileset_options *options,
    const otx_tile_layout *layout, contest *c, int32_t attempt,
    otx_frame_kit *kit)
{
    const otx_strip_sizes *s = &kit->sizes;
    const int32_t v = kit->corner_count;

    for (int32_t k = 0; k < kit->boundary_count; ++k)
    {
        otx_texel_map edge;

        OTX_TRY(otx_texel_map_create(
            run, run->arena, s->side, 2 * s->reach, &edge));
        OTX_TRY(
            choose_edge(run, pool, options, layout, c, attempt, k, kit, &edge));
        for (int32_t i = 0; i < v * v; ++i)
            OTX_TRY(otx_strip_build(
                run, pool, s, &edge, &kit->corners[i / v], &kit->corners[i % v],
                &kit->strips[k * v * v + i]));
    }
    return OSDTEX_OK;
}

otx_status
otx_template_kit(
    otx_run *run, otx_texel_pool *pool, const otx_tileset_options *options,
    const otx_tile_layout *layout, int32_t attempt, otx_frame_kit *kit)
{
    const otx_texel_window all = {0, 0, 0};
    const int32_t v = kit->corner_count;
    contest c = {.pool = pool, .kit = kit};

    kit->corners = OTX_ZNEW(run->arena, otx_corner, v);
    kit->strips = OTX_ZNEW(run->arena, otx_strip, kit->boundary_count * v * v);
    if (!kit->corners || !kit->strips)
        return otx_fail_memory(run, STAGE);
    c.whole = look_at(pool, all, pool->width, pool->height);
    OTX_TRY(build_corners(run, pool, options, &c, attempt, kit));
    return build_strips(run, pool, options, layout, &c, attempt, kit);
}

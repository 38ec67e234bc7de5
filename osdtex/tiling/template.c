/* template.c -- candidates for corners and edges, and the choice. */
#include "tiling/template.h"

#include "base/random.h"
#include "base/sort.h"

#include <math.h>
#include <string.h>

enum
{
    CORNER_CANDIDATES = 256,
    EDGE_CANDIDATES = 64,
    SHARE = 2,
    FINALISTS = 24,
    MARGIN = 4, /* texels around a corner's core that are looked at too */
    CORNER_STAGE = 0x7469c002,
    EDGE_STAGE = 0x7469c003
};

int32_t
otx_template_extra(
    const otx_strip_sizes *sizes, const otx_tileset_options *options)
{
    return options->edge_count * 2 * sizes->reach * sizes->side;
}

/* Mean and spread of the colours of a map's texels. */
typedef struct look
{
    double mean[3];
    double spread;
} look;

/* Of the texels but for a rim of `rim` along x and y. */
static look
look_at(
    const otx_texel_pool *pool, const otx_texel_map *map, int32_t rim_x,
    int32_t rim_y)
{
    const double count =
        (double)(map->width - 2 * rim_x) * (map->height - 2 * rim_y);
    double square = 0.0;
    look l = {{0.0, 0.0, 0.0}, 0.0};

    for (int32_t y = rim_y; y < map->height - rim_y; ++y)
        for (int32_t x = rim_x; x < map->width - rim_x; ++x)
        {
            const float *color =
                pool->colors + 3 * (size_t)otx_texel_map_at(map, x, y);

            for (int32_t c = 0; c < 3; ++c)
            {
                l.mean[c] += color[c] / count;
                square += (double)color[c] * color[c] / count;
            }
        }
    for (int32_t c = 0; c < 3; ++c)
        square -= l.mean[c] * l.mean[c];
    l.spread = sqrt(fmax(square, 0.0));
    return l;
}

/* Of the whole exemplar. */
static otx_status
look_around(otx_run *run, const otx_texel_pool *pool, look *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_texel_map all;

    OTX_TRY(otx_texel_map_create(
        run, run->scratch, pool->width, pool->height, &all));
    otx_texel_pool_lay(pool, (otx_texel_window){0, 0, 0}, &all);
    *out = look_at(pool, &all, 0, 0);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
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
    const otx_patch_search *looks; /* of corners, or NULL */
    look whole;
    uint64_t element; /* of the random numbers */
    int32_t turns, turns_step;
    otx_texel_window *windows; /* [count] */
    int64_t *costs;            /* [count] of the cuts */
    double *oddness;           /* [count] */
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

static otx_status
try_corner(void *context, int64_t index, otx_worker *worker)
{
    contest *c = context;
    otx_run run = worker_run(c, worker);
    const int32_t sew = c->kit->sizes.sew;
    const int32_t rim = sew - c->kit->sizes.core - MARGIN;
    const otx_texel_window window =
        draw_window(c, CORNER_STAGE, index, 2 * sew, 2 * sew);
    otx_corner corner;

    OTX_TRY(otx_corner_build(&run, c->pool, window, sew, &corner));
    c->windows[index] = window;
    c->costs[index] = corner.cost;
    c->oddness[index] = oddness(
        look_at(c->pool, &corner.map, rim > 0 ? rim : 0, rim > 0 ? rim : 0),
        c->whole);
    return OSDTEX_OK;
}

/* A whole corner has no cut; the least odd window is taken. */
static otx_status
try_whole(void *context, int64_t index, otx_worker *worker)
{
    contest *c = context;
    otx_run run = worker_run(c, worker);
    const int32_t size = 2 * c->kit->sizes.sew;
    const otx_texel_window window =
        draw_window(c, CORNER_STAGE, index, size, size);
    otx_texel_map map;

    OTX_TRY(otx_texel_map_create(&run, run.arena, size, size, &map));
    otx_texel_pool_lay(c->pool, window, &map);
    c->windows[index] = window;
    c->oddness[index] = oddness(look_at(c->pool, &map, 0, 0), c->whole);
    c->costs[index] = (int64_t)(1e6 * c->oddness[index]);
    return OSDTEX_OK;
}

static otx_status
try_edge(void *context, int64_t index, otx_worker *worker)
{
    contest *c = context;
    otx_run run = worker_run(c, worker);
    const otx_strip_sizes *s = &c->kit->sizes;
    const otx_corner *usual = &c->kit->corners[otx_frame_usual_corner(c->kit)];
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
    OTX_TRY(otx_strip_build(&run, c->pool, s, &edge, usual, usual, 0, &strip));
    c->windows[index] = window;
    c->costs[index] = strip.cost;
    c->oddness[index] =
        oddness(look_at(c->pool, &strip.map, 0, s->reach - s->core), c->whole);
    return OSDTEX_OK;
}

/* The oddness of the last that counts. */
static otx_status
find_limit(otx_run *run, const contest *c, int32_t count, double *out)
{
    double *sorted = OTX_NEW(run->scratch, double, count);

    OTX_TRY(otx_run_ok(run));
    memcpy(sorted, c->oddness, (size_t)count * sizeof *sorted);
    otx_sort_doubles(sorted, (size_t)count);
    *out = sorted[count / SHARE];
    return OSDTEX_OK;
}

/* How far the middle of a corner is from anything in the exemplar. */
static otx_status
look_up(
    otx_run *run, const contest *c, otx_texel_window window, double *distance)
{
    const int32_t size = c->looks->size, sew = c->kit->sizes.sew;
    otx_run own = *run;
    otx_corner corner;
    otx_texel_map middle;

    own.arena = run->scratch;
    OTX_TRY(otx_corner_build(&own, c->pool, window, sew, &corner));
    OTX_TRY(otx_texel_map_create(run, run->scratch, size, size, &middle));
    for (int32_t y = 0; y < size; ++y)
        for (int32_t x = 0; x < size; ++x)
            middle.texels[y * size + x] =
                otx_corner_texel(&corner, x - size / 2, y - size / 2);
    *distance = otx_patch_search_distance(c->looks, &middle);
    return OSDTEX_OK;
}

/* A cut is cheapest where there is nothing to see. So only the most typical
 * candidates count, one in SHARE, and among them the cheapest wins. Corners may
 * be cheap and still look like nothing in the exemplar, such as four dark spots
 * in a square: of the cheapest FINALISTS, the one wins that is most like a
 * piece of it. */
static otx_status
judge(otx_run *run, contest *c, int32_t count, otx_texel_window *winner)
{
    const int32_t finalists = c->looks ? FINALISTS : 1;
    double limit = 0.0, nearest = INFINITY;

    OTX_TRY(find_limit(run, c, count, &limit));
    for (int32_t k = 0; k < finalists; ++k)
    {
        double distance = 0.0;
        int32_t best = -1;

        for (int32_t i = 0; i < count; ++i)
            if (c->oddness[i] <= limit &&
                (best < 0 || c->costs[i] < c->costs[best]))
                best = i;
        if (best < 0)
            break;
        c->oddness[best] = INFINITY;
        if (c->looks)
            OTX_TRY(look_up(run, c, c->windows[best], &distance));
        if (k == 0 || distance < nearest)
        {
            nearest = distance;
            *winner = c->windows[best];
        }
    }
    return OSDTEX_OK;
}

/* Holds the contest and returns the winner. */
static otx_status
hold(
    otx_run *run, contest *c, int32_t count, otx_pool_body body,
    otx_texel_window *winner)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    c->run = run;
    c->windows = OTX_NEW(run->scratch, otx_texel_window, count);
    c->costs = OTX_NEW(run->scratch, int64_t, count);
    c->oddness = OTX_NEW(run->scratch, double, count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_pool_for(run->pool, count, body, c));
    OTX_TRY(judge(run, c, count, winner));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
build_corners(
    otx_run *run, const otx_texel_pool *pool, const otx_patch_search *looks,
    const otx_tileset_options *options, contest *c, otx_frame_kit *kit)
{
    const int32_t sew = kit->sizes.sew;

    c->looks = looks && looks->size <= 2 * sew ? looks : NULL;
    for (int32_t i = 0; i < kit->corner_count; ++i)
    {
        otx_texel_window window;

        if (i <= 1 && options->has_corner)
            window = (otx_texel_window){
                (int32_t)floor(options->corner.x + 0.5) - sew,
                (int32_t)floor(options->corner.y + 0.5) - sew, 0};
        else
        {
            c->element = (uint64_t)i;
            OTX_TRY(hold(
                run, c, CORNER_CANDIDATES, i > 0 ? try_whole : try_corner,
                &window));
        }
        OTX_TRY((i > 0 ? otx_corner_lay : otx_corner_build)(
            run, pool, window, sew, &kit->corners[i]));
        /* Only corners that are turned may look like nothing. */
        c->looks = NULL;
    }
    return OSDTEX_OK;
}

/* The picture along boundary `k`, before its ends are sewn. */
static otx_status
choose_edge(
    otx_run *run, otx_texel_pool *pool, const otx_tileset_options *options,
    const otx_tile_layout *layout, contest *c, int32_t k,
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
    c->element = (uint64_t)k;
    OTX_TRY(hold(run, c, EDGE_CANDIDATES, try_edge, &window));
    otx_texel_pool_lay(pool, window, edge);
    return OSDTEX_OK;
}

/* A strip in all its turns. Where both ends look the same when turned it is
 * one and the same, however the tiles beside it lie. */
static otx_status
build_turned(
    otx_run *run, const otx_texel_pool *pool, const otx_frame_kit *kit,
    const otx_texel_map *edge, int32_t start, int32_t end, otx_strip out[4])
{
    const otx_corner *a = &kit->corners[start], *b = &kit->corners[end];

    for (int32_t turns = 0; turns < 4; ++turns)
        if (turns > 0 && !a->whole && !b->whole)
            out[turns] = out[0];
        else
            OTX_TRY(otx_strip_build(
                run, pool, &kit->sizes, edge, a, b, turns, &out[turns]));
    return OSDTEX_OK;
}

static otx_status
build_strips(
    otx_run *run, otx_texel_pool *pool, const otx_tileset_options *options,
    const otx_tile_layout *layout, contest *c, otx_frame_kit *kit)
{
    const otx_strip_sizes *s = &kit->sizes;
    const int32_t v = kit->corner_count;

    for (int32_t k = 0; k < kit->boundary_count; ++k)
    {
        otx_texel_map edge;

        OTX_TRY(otx_texel_map_create(
            run, run->arena, s->side, 2 * s->reach, &edge));
        OTX_TRY(choose_edge(run, pool, options, layout, c, k, kit, &edge));
        for (int32_t i = 0; i < v * v; ++i)
            OTX_TRY(build_turned(
                run, pool, kit, &edge, i / v, i % v,
                &kit->strips[otx_frame_strip_number(kit, k, i / v, i % v, 0)]));
    }
    return OSDTEX_OK;
}

otx_status
otx_template_kit(
    otx_run *run, otx_texel_pool *pool, const otx_patch_search *looks,
    const otx_tileset_options *options, const otx_tile_layout *layout,
    otx_frame_kit *kit)
{
    const int32_t v = kit->corner_count;
    contest c = {.pool = pool, .kit = kit};

    kit->corners = OTX_ZNEW(run->arena, otx_corner, v);
    kit->strips =
        OTX_ZNEW(run->arena, otx_strip, 4 * kit->boundary_count * v * v);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(look_around(run, pool, &c.whole));
    OTX_TRY(build_corners(run, pool, looks, options, &c, kit));
    return build_strips(run, pool, options, layout, &c, kit);
}

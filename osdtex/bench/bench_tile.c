/* bench_tile.c -- tiles: laying them against copying memory, and making them
 * against a search by direct sums. */
#include "bench/bench_row.h"
#include "bench/patterns.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "base/random.h"
#include "method/tile/assign.h"
#include "surface/surface.h"
#include "tiling/template.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -- laying tiles --------------------------------------------------------- */

enum
{
    SPHERE_SIDE = 32, /* 12 n^2 quads ... */
    SPHERE_LEVEL = 3, /* ... times 4^level: 786 432 */
    /* Bytes to a quad: four vertices and four edges read, a name written, two
     * edge types and a vertex mask cleared, read and written. */
    BYTES = 16 + 16 + 4 + 2 * 3 + 8 * 3
};

typedef struct lay_job
{
    otx_run run;
    otx_tile_layout layout;
    otx_assign_input input;
    int32_t *names;
    char *from, *to;
    size_t bytes;
} lay_job;

static otx_status
lay(void *context)
{
    lay_job *job = context;

    return otx_assign_names(&job->run, &job->input, job->names);
}

static otx_status
lay_plain(void *context)
{
    lay_job job = *(lay_job *)context;

    job.input.plain = true;
    return otx_assign_names(&job.run, &job.input, job.names);
}

/* As many bytes read and written as by laying tiles. */
static otx_status
copy(void *context)
{
    lay_job *job = context;

    memcpy(job->to, job->from, job->bytes);
    return OSDTEX_OK;
}

static otx_status
lay_open(lay_job *job, int32_t boundaries)
{
    otx_surface *surface;
    otx_cage *cage;

    OTX_TRY(bench_workspace_open(&job->run, 1));
    surface = OTX_ZNEW(job->run.arena, otx_surface, 1);
    cage = OTX_ZNEW(job->run.arena, otx_cage, 1);
    if (!surface || !cage)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(bench_shapes_sphere(&job->run, SPHERE_SIDE, false, cage));
    OTX_TRY(otx_surface_refine(&job->run, cage, SPHERE_LEVEL, 0, surface));
    job->layout = (otx_tile_layout){
        .boundaries = boundaries, .corners = 1, .cell = 128, .gutter = 4};
    job->input = (otx_assign_input){
        .level = otx_surface_leaf(surface), .layout = &job->layout};
    job->bytes = (size_t)job->input.level->face_count * BYTES / 2;
    job->names = OTX_NEW(job->run.arena, int32_t, job->input.level->face_count);
    job->from = otx_arena_zalloc(job->run.arena, job->bytes, 1);
    job->to = otx_arena_zalloc(job->run.arena, job->bytes, 1);
    return job->names && job->from && job->to ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

static bool
time_laying(int32_t boundaries, int32_t repeat, bench_report *report)
{
    lay_job job = {0};
    bool right = lay_open(&job, boundaries) == OSDTEX_OK;
    bench_lane lanes[3] = {
        {.body = lay, .context = &job},
        {.body = lay_plain, .context = &job},
        {.body = copy, .context = &job}};

    right = right && bench_stopwatch_race(lanes, 3, repeat) == OSDTEX_OK;
    if (right)
    {
        const double quads = job.input.level->face_count;
        const double values[] = {
            quads,
            1e-6 * quads / lanes[0].best.cpu,
            1e-6 * quads / lanes[1].best.cpu,
            1e-9 * quads * BYTES / lanes[0].best.cpu,
            1e-9 * 2.0 * (double)job.bytes / lanes[2].best.cpu,
            lanes[2].best.cpu / lanes[0].best.cpu};
        char label[16];

        snprintf(label, sizeof label, "n = %d", (int)boundaries);
        bench_report_row(report, label, values);
    }
    bench_workspace_close(&job.run);
    return right;
}

/* -- making tiles --------------------------------------------------------- */

enum
{
    PICTURE = 256,
    TILES = 16,
    WINDOWS_MAX = 64,
    ODD = 4,  /* a tile that no turn maps to itself: no ties */
    BLOCK = 8 /* as ring_search.c */
};

typedef struct make_job
{
    otx_run run;
    otx_exemplar exemplar;
    otx_tile_layout layout;
    otx_tileset_options options;
    otx_texel_pool pool;
    otx_frame_kit kit;
    otx_ring_search search;
    int32_t tiles; /* to make */
    double cut[2]; /* mean Lab distance along the cuts, ours and direct */
} make_job;

static otx_status
make_open(make_job *job)
{
    otx_image pixels;

    OTX_TRY(bench_workspace_open(&job->run, 1));
    job->run.seed = 1;
    OTX_TRY(bench_patterns_pebbles(&job->run, PICTURE, &pixels));
    OTX_TRY(bench_patterns_exemplar(&job->run, &pixels, &job->exemplar));
    job->options = (otx_tileset_options){
        .boundaries = 1, .corners = 1, .cell = 64, .gutter = 4};
    OTX_TRY(otx_tileset_plan(
        &job->run, &job->exemplar, &job->options, &job->layout));
    job->kit.sizes = otx_tileset_sizes(&job->layout);
    job->kit.boundary_count = job->kit.corner_count = 1;
    OTX_TRY(otx_texel_pool_create(
        &job->run, job->run.arena, &job->exemplar, &job->exemplar.lab, 0,
        &job->pool));
    return otx_template_kit(
        &job->run, &job->pool, NULL, &job->options, &job->layout, &job->kit);
}

/* Mean squared distance of a window to the bands of the sides in `sides`, by
 * direct sums that stop above `limit`. */
static double
direct_error(
    const make_job *job, const otx_tile_name *name, int32_t sides,
    otx_texel_window window, double limit)
{
    const otx_strip_sizes *s = &job->kit.sizes;
    const double area = (double)s->side * (s->reach - s->gutter);
    double sum = 0.0, count = 0.0;

    for (int32_t side = 0; side < 4; ++side)
        count += sides >> side & 1;
    for (int32_t side = 0; side < 4; ++side)
        for (int32_t depth = s->gutter; depth < s->reach; ++depth)
        {
            for (int32_t t = 0; t < s->side && (sides >> side & 1); ++t)
            {
                const int32_t last = s->side - 1;
                const int32_t xs[4] = {t, last - depth, last - t, depth};
                const int32_t ys[4] = {depth, t, last - depth, last - t};
                const double d = otx_texel_pool_distance(
                    &job->pool,
                    otx_frame_side_texel(
                        &job->kit, name, side, (otx_frame_place){t, depth}),
                    otx_texel_pool_window(
                        &job->pool, window, s->side, s->side, xs[side],
                        ys[side]));

                sum += d * d;
            }
            if (sum > limit * area * count)
                return INFINITY;
        }
    return sum / (area * count);
}

/* otx_ring_search_find by direct sums. */
typedef struct direct_place
{
    double error;
    otx_texel_window window;
} direct_place;

static int32_t
direct_list(
    const make_job *job, const otx_tile_name *name, int32_t sides,
    direct_place *list)
{
    const otx_ring_search *r = &job->search;
    int32_t count = 0;

    for (int32_t turns = 0; turns < 4; ++turns)
        for (int32_t y0 = r->y0; y0 < r->y1; y0 += BLOCK)
            for (int32_t x0 = r->x0; x0 < r->x1; x0 += BLOCK)
            {
                direct_place best = {INFINITY, {x0, y0, turns}};

                for (int32_t i = 0; i < BLOCK * BLOCK; ++i)
                {
                    const otx_texel_window w = {
                        x0 + i % BLOCK, y0 + i / BLOCK, turns};
                    double error;

                    if (w.x >= r->x1 || w.y >= r->y1)
                        continue;
                    error = direct_error(job, name, sides, w, best.error);
                    if (error < best.error)
                        best = (direct_place){error, w};
                }
                list[count++] = best;
            }
    return count;
}

static int32_t
direct_find(
    make_job *job, const otx_tile_name *name, int32_t sides, int32_t count,
    otx_texel_window *out)
{
    const otx_ring_search *r = &job->search;
    const int64_t room = 4 * (int64_t)((r->x1 - r->x0) / BLOCK + 1) *
                         ((r->y1 - r->y0) / BLOCK + 1);
    direct_place *list = OTX_NEW(job->run.scratch, direct_place, room);
    int32_t found = 0, listed;

    if (!list)
        return 0;
    listed = direct_list(job, name, sides, list);
    for (; found < count; ++found)
    {
        int32_t best = 0;

        for (int32_t i = 1; i < listed; ++i)
            if (list[i].error < list[best].error)
                best = i;
        out[found] = list[best].window;
        for (int32_t i = 0; i < listed; ++i)
            if (list[i].window.turns == out[found].turns &&
                abs(list[i].window.x - out[found].x) < BLOCK &&
                abs(list[i].window.y - out[found].y) < BLOCK)
                list[i].error = INFINITY;
    }
    return found;
}

static otx_status
make_by(make_job *job, bool direct)
{
    const otx_interior_options *how = &otx_tileset_interior;
    const otx_ring_region all = {0, 0, 0, 0};
    const otx_arena_mark mark = otx_arena_here(job->run.arena);
    double sum = 0.0, length = 0.0;
    otx_texel_map map;

    OTX_TRY(otx_texel_map_create(
        &job->run, job->run.arena, job->layout.cell, job->layout.cell, &map));
    OTX_TRY(otx_ring_search_create(
        &job->run, &job->pool, &job->kit, &job->layout, &all, &job->search));
    for (int32_t i = 0; i < job->tiles; ++i)
    {
        const otx_tile_name name = otx_tile_layout_name(
            &job->layout, (i * TILES / job->tiles + ODD) % TILES);
        otx_texel_window windows[WINDOWS_MAX];
        otx_quilt_seams seams;
        int32_t count;

        if (direct)
        {
            count = direct_find(
                job, &name, OTX_RING_SEARCH_SIDES, how->windows, windows);
            for (int32_t side = 0; side < 4; ++side)
                count += direct_find(
                    job, &name, 1 << side, how->side_windows, windows + count);
            OTX_TRY(otx_interior_fill(
                &job->run, &job->search, &name, NULL, how, windows, count, &map,
                &seams));
        }
        else
            OTX_TRY(otx_interior_build(
                &job->run, &job->search, &name, NULL, how, &map, &seams));
        sum += seams.mean * (double)seams.length;
        length += (double)seams.length;
    }
    job->cut[direct] = sum / length;
    otx_arena_release(job->run.arena, mark);
    return OSDTEX_OK;
}

static otx_status
make_ours(void *context)
{
    return make_by(context, false);
}

static otx_status
make_direct(void *context)
{
    return make_by(context, true);
}

static bool
time_making(const bench_options *options, bench_report *report)
{
    make_job job = {.tiles = options->large ? TILES : 1};
    bool right = make_open(&job) == OSDTEX_OK;
    bench_lane lanes[2] = {
        {.body = make_ours, .context = &job},
        {.body = make_direct, .context = &job}};

    right = right && bench_stopwatch_race(
                         lanes, 2, bench_row_repeat(options, 1)) == OSDTEX_OK;
    if (right)
    {
        const double values[] = {
            job.tiles,
            1e3 * lanes[0].best.cpu,
            1e3 * lanes[1].best.cpu,
            lanes[1].best.cpu / lanes[0].best.cpu,
            job.cut[0],
            job.cut[1],
            job.pool.random_pair};

        bench_report_row(report, "64", values);
    }
    bench_workspace_close(&job.run);
    return right;
}

static bool
time_tile(const bench_options *options, bench_report *report)
{
    static const char *const lay_columns[] = {
        "boundaries",   "quads",      "spread, M quads/s",   "plain, M quads/s",
        "spread, GB/s", "copy, GB/s", "copy / spread, time", NULL};
    static const char *const make_columns[] = {
        "tile size",         "tiles",         "ms",
        "direct search, ms", "direct / ours", "cut, Lab",
        "direct, cut",       "random pair",   NULL};
    bool right = true;

    bench_report_begin(
        report, "tile: laying tiles, one core, against copying as many bytes",
        lay_columns);
    for (int32_t n = 1; n <= 3 && right; ++n)
        right = time_laying(n, bench_row_repeat(options, 5), report);
    bench_report_begin(
        report,
        "tile: insides of tiles from a picture of 256 x 256, one core, against "
        "finding the windows by direct sums",
        make_columns);
    return right && time_making(options, report);
}

/* -- verification --------------------------------------------------------- */

/* Largest difference of the maps' errors from direct sums. */
static double
largest_error(make_job *job)
{
    double largest = 0.0;

    for (uint64_t i = 0; i < 200; ++i)
    {
        const otx_tile_name name = otx_tile_layout_name(
            &job->layout, (int32_t)(otx_random_bits(1, 1, i) % TILES));
        const otx_texel_window window = {
            (int32_t)(otx_random_bits(1, 2, i) % (uint64_t)job->search.x1),
            (int32_t)(otx_random_bits(1, 3, i) % (uint64_t)job->search.y1),
            (int32_t)(i & 3)};
        const int32_t sides =
            i % 5 == 0 ? OTX_RING_SEARCH_SIDES : 1 << (i % 5 - 1);

        largest = fmax(
            largest,
            fabs(
                otx_ring_search_error(&job->search, &name, sides, window) -
                direct_error(job, &name, sides, window, INFINITY)));
    }
    return largest;
}

static bool
verify_tile(const bench_options *options)
{
    const otx_ring_region all = {0, 0, 0, 0};
    make_job job = {.tiles = 1};
    bool right = make_open(&job) == OSDTEX_OK;
    double largest, scale;

    (void)options;
    right = right && otx_ring_search_create(
                         &job.run, &job.pool, &job.kit, &job.layout, &all,
                         &job.search) == OSDTEX_OK;
    if (right)
    {
        scale = job.pool.random_pair * job.pool.random_pair;
        largest = largest_error(&job) / scale;
        right = bench_row_check(
            largest < 1e-4,
            "tile: error maps and direct sums differ by %.2g of a random pair",
            largest);
        right = right && make_by(&job, false) == OSDTEX_OK &&
                make_by(&job, true) == OSDTEX_OK;
        right = right &&
                bench_row_check(
                    fabs(job.cut[0] - job.cut[1]) < 0.02 * job.pool.random_pair,
                    "tile: cuts of %.3f Lab, by direct search %.3f", job.cut[0],
                    job.cut[1]);
    }
    bench_workspace_close(&job.run);
    return right;
}

const bench_row bench_row_tile = {
    .name = "tile",
    .summary = "Laying tiles against copying memory; making them against a "
               "search by direct sums.",
    .time = time_tile,
    .verify = verify_tile,
};

/* bench_stages.c -- flattening, cut and relaxation against what they are made
 * of.
 *
 * An octopus is covered with clusters of half an exemplar, each laid somewhere
 * in it. The floors are bare loops over the same data:
 *
 *   flatten  the rotations and matrix products of its own solves; gathering
 *            faces, unfolding, building matrices and the rest of conjugate
 *            gradients are free
 *   cut      the colours that every patch shows along every edge that it may
 *            take, looked up once; comparing them, the flow and all sweeps but
 *            the first are free
 *   relax    in each round both sides' colours along every seam once, and the
 *            rigidity's share of one product each step of conjugate gradients;
 *            slopes, the seams' blocks and halved steps are free */
#include "bench/bench_row.h"
#include "bench/patterns.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "base/random.h"
#include "flatten/chart.h"
#include "flatten/rigid.h"
#include "mapping/seam.h"
#include "relax/cut.h"
#include "relax/elastic.h"
#include "relax/sheet.h"

#include <stdlib.h>
#include <string.h>

enum
{
    LEAF_TEXELS = 10,
    EXEMPLAR = 256,
    FLATTEN_ROUNDS = 5,
    RELAX_ROUNDS = 12,
    RELAX_PRODUCTS = 15, /* of one round, as relax/elastic.c has them */
    USUAL_TURNS = 3,
    SAMPLES_MOST = 256
};

typedef struct scene
{
    otx_run run;
    otx_cage cage;
    otx_surface surface;
    otx_exemplar exemplar;
    otx_dual leaves;
    double texels;
    otx_cluster_list clusters;
    otx_chart_space space;
    otx_chart *charts; /* [clusters.count] */
    otx_rigid *rigids; /* of the charts */
    int32_t *products; /* of the charts' solves */
    otx_offer *offers;
    int32_t *labels; /* [leaf face_count] each face its cluster's */
    int32_t *cut;    /* and after the cut */
    otx_vec2 *uvs;   /* [leaf corner_count] texels, after the cut */
    int32_t rounds;  /* of the relaxation that lowered the energy */
    float *sink;     /* [3 * SAMPLES_MOST] */
} scene;

/* -- flattening ---------------------------------------------------------- */

static otx_chart_request
chart_request(const scene *s)
{
    return (otx_chart_request){
        .surface = &s->surface,
        .leaves = &s->leaves,
        .texels = s->texels,
        .collar = 0.25 * EXEMPLAR,
        .bend = 1.0,
        .rounds = FLATTEN_ROUNDS};
}

static otx_status
flatten_all(scene *s, otx_arena *arena, otx_chart *charts)
{
    const otx_chart_request request = chart_request(s);

    for (int32_t i = 0; i < s->clusters.count; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(s->run.scratch);
        int32_t count;
        const int32_t *leaves = otx_cluster_leaves(
            arena, &s->surface, &s->clusters.clusters[i], &count);

        if (!leaves)
            return OSDTEX_ERROR_MEMORY;
        OTX_TRY(otx_chart_build(
            &request, leaves, count, &s->space, s->run.scratch, arena,
            &charts[i]));
        otx_arena_release(s->run.scratch, mark);
    }
    return OSDTEX_OK;
}

static otx_status
run_flatten(void *context)
{
    scene *s = context;
    const otx_arena_mark mark = otx_arena_here(s->run.arena);
    otx_chart *charts = OTX_NEW(s->run.arena, otx_chart, s->clusters.count);
    const otx_status status =
        charts ? flatten_all(s, s->run.arena, charts) : OSDTEX_ERROR_MEMORY;

    otx_arena_release(s->run.arena, mark);
    return status;
}

typedef struct counted
{
    const otx_rigid *rigid;
    int64_t *rows;
} counted;

static void
apply_counted(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    const counted *c = context;

    *c->rows += end - first;
    otx_rigid_apply(c->rigid, x, first, end, out);
}

/* The matrix products that flattening the chart took. */
static otx_status
count_products(scene *s, int32_t index)
{
    const otx_chart *chart = &s->charts[index];
    const int32_t n = chart->vert_count;
    otx_arena *scratch = s->run.scratch;
    otx_vec2 *b = OTX_NEW(scratch, otx_vec2, n);
    otx_vec2 *diagonal = OTX_NEW(scratch, otx_vec2, n);
    otx_vec2 *flat = OTX_NEW(scratch, otx_vec2, n);
    int64_t rows = 0;
    counted c = {&s->rigids[index], &rows};
    const otx_rigid_system system = {
        .count = n,
        .apply = apply_counted,
        .context = &c,
        .diagonal = diagonal,
        .rounds = 60,
        .tolerance = 1e-3};

    if (!b || !diagonal || !flat)
        return OSDTEX_ERROR_MEMORY;
    memcpy(flat, chart->flat, (size_t)n * sizeof *flat);
    for (int32_t v = 0; v < n; ++v)
        diagonal[v] = (otx_vec2){c.rigid->diagonal[v], c.rigid->diagonal[v]};
    for (int32_t round = 0; round < FLATTEN_ROUNDS; ++round)
    {
        otx_rigid_pull(c.rigid, flat, b);
        OTX_TRY(otx_rigid_solve(scratch, &system, b, flat));
    }
    s->products[index] = (int32_t)(rows / n);
    return OSDTEX_OK;
}

static otx_status
make_rigids(scene *s)
{
    for (int32_t i = 0; i < s->clusters.count; ++i)
    {
        const otx_chart *c = &s->charts[i];
        const otx_rigid_mesh mesh = {
            c->face_count, c->vert_count,     c->first,  c->corners,
            c->verts,      s->surface.points, s->texels, NULL};
        const otx_arena_mark mark = otx_arena_here(s->run.scratch);

        OTX_TRY(otx_rigid_build(s->run.arena, &mesh, &s->rigids[i]));
        OTX_TRY(count_products(s, i));
        otx_arena_release(s->run.scratch, mark);
    }
    return OSDTEX_OK;
}

static otx_status
run_flatten_floor(void *context)
{
    scene *s = context;
    const otx_arena_mark mark = otx_arena_here(s->run.scratch);

    for (int32_t i = 0; i < s->clusters.count; ++i)
    {
        const int32_t n = s->charts[i].vert_count;
        otx_vec2 *out = OTX_NEW(s->run.scratch, otx_vec2, n);

        if (!out)
            return OSDTEX_ERROR_MEMORY;
        for (int32_t round = 0; round < FLATTEN_ROUNDS; ++round)
            otx_rigid_pull(&s->rigids[i], s->charts[i].flat, out);
        for (int32_t k = 0; k < s->products[i]; ++k)
            otx_rigid_apply(&s->rigids[i], s->charts[i].flat, 0, n, out);
    }
    otx_arena_release(s->run.scratch, mark);
    return OSDTEX_OK;
}

/* -- cut ----------------------------------------------------------------- */

typedef struct slot
{
    int32_t face, index;
} slot;

/* Of slots, and of the faces that they begin with. */
static int
by_face(const void *a, const void *b)
{
    const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;

    return (x > y) - (x < y);
}

/* The whole chart of a cluster, somewhere in the exemplar. */
static otx_status
make_offer(scene *s, int32_t index)
{
    const otx_chart *chart = &s->charts[index];
    const otx_vec2 turn =
        otx_vec2_polar(2.0 * OTX_PI * otx_random_unit(1, 1, (uint64_t)index));
    const otx_vec2 shift = {
        EXEMPLAR * otx_random_unit(1, 2, (uint64_t)index),
        EXEMPLAR * otx_random_unit(1, 3, (uint64_t)index)};
    slot *slots = OTX_NEW(s->run.scratch, slot, chart->face_count);
    int32_t *faces = OTX_NEW(s->run.arena, int32_t, chart->face_count);
    int32_t *first = OTX_NEW(s->run.arena, int32_t, chart->face_count + 1);
    otx_vec2 *uvs =
        OTX_NEW(s->run.arena, otx_vec2, chart->first[chart->face_count]);
    int32_t n = 0;

    if (!slots || !faces || !first || !uvs)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < chart->face_count; ++i)
        slots[i] = (slot){chart->faces[i], i};
    qsort(slots, (size_t)chart->face_count, sizeof *slots, by_face);
    for (int32_t k = 0; k < chart->face_count; ++k)
    {
        const int32_t i = slots[k].index;

        faces[k] = slots[k].face;
        first[k] = n;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            uvs[n++] = otx_vec2_add(
                otx_vec2_mul(turn, chart->flat[chart->corners[c]]), shift);
    }
    first[chart->face_count] = n;
    s->offers[index] =
        (otx_offer){chart->face_count, faces, uvs, first, NULL, 0};
    for (int32_t i = 0; i < chart->core_count; ++i)
        s->labels[chart->faces[i]] = index;
    return OSDTEX_OK;
}

static otx_status
run_cut(void *context)
{
    scene *s = context;
    otx_cut_options options = otx_cut_options_default();

    options.texels_per_unit = s->texels;
    memcpy(
        s->cut, s->labels,
        (size_t)s->leaves.level->face_count * sizeof *s->cut);
    return otx_cut_run(
        &s->run, &s->surface, &s->exemplar, s->offers, s->clusters.count,
        &options, s->cut, NULL);
}

/* Looks a side's colours up, at the places where the cut compares them. */
static void
look_up(const scene *s, const otx_vec2 side[2], double length, bool band)
{
    const int32_t wanted = otx_seam_sample_count(length);
    const int32_t n = wanted < SAMPLES_MOST ? wanted : SAMPLES_MOST;

    otx_seam_sample(&s->exemplar.match, true, true, side, 0.0, n, s->sink);
    for (int k = -1; band && k < 2; k += 2)
        otx_seam_sample(
            &s->exemplar.match, true, true, side, k, (n + 1) / 2, s->sink);
}

static otx_status
run_cut_floor(void *context)
{
    const scene *s = context;
    const otx_level *leaf = s->leaves.level;

    for (int32_t p = 0; p < s->clusters.count; ++p)
    {
        const otx_offer *offer = &s->offers[p];

        for (int32_t i = 0; i < offer->face_count; ++i)
            for (int32_t k = 0; k < otx_level_face_size(leaf, offer->faces[i]);
                 ++k)
            {
                const int32_t face = offer->faces[i];
                const int32_t base = leaf->face_first[face];
                const int32_t edge = leaf->face_edges[base + k];
                const int32_t *sides = leaf->edge_faces + 2 * (size_t)edge;
                int32_t corners[2];
                otx_vec2 side[2];

                /* An edge of two offered faces counts once. */
                if (sides[0] != face &&
                    bsearch(
                        &sides[0], offer->faces, (size_t)offer->face_count,
                        sizeof *offer->faces, by_face))
                    continue;
                otx_seam_corners(leaf, edge, face, corners);
                for (int e = 0; e < 2; ++e)
                    side[e] = offer->uvs[offer->first[i] + corners[e] - base];
                look_up(
                    s, side,
                    s->texels * otx_seam_edge_length(&s->surface, edge), true);
            }
    }
    return OSDTEX_OK;
}

static void
take_uvs(scene *s)
{
    for (int32_t p = 0; p < s->clusters.count; ++p)
        for (int32_t i = 0; i < s->offers[p].face_count; ++i)
        {
            const otx_offer *o = &s->offers[p];

            if (s->cut[o->faces[i]] == p)
                memcpy(
                    s->uvs + s->leaves.level->face_first[o->faces[i]],
                    o->uvs + o->first[i],
                    (size_t)(o->first[i + 1] - o->first[i]) * sizeof *s->uvs);
        }
}

/* -- relaxation ---------------------------------------------------------- */

static otx_status
run_relax(void *context)
{
    scene *s = context;
    const otx_arena_mark mark = otx_arena_here(s->run.scratch);
    const size_t count = (size_t)s->leaves.level->corner_count;
    otx_vec2 *uvs = OTX_NEW(s->run.scratch, otx_vec2, (int64_t)count);
    const otx_elastic_options options = {
        .texels = s->texels,
        .rounds = RELAX_ROUNDS,
        .levels = 3,
        .stiffness = 0.3,
        .stretch = 1.6};
    otx_elastic_stats stats;

    if (!uvs)
        return OSDTEX_ERROR_MEMORY;
    memcpy(uvs, s->uvs, count * sizeof *uvs);
    OTX_TRY(otx_elastic_run(
        &s->run, &s->surface, &s->exemplar, &options, s->cut, uvs, &stats));
    s->rounds = stats.rounds;
    otx_arena_release(s->run.scratch, mark);
    return OSDTEX_OK;
}

static otx_status
run_relax_floor(void *context)
{
    scene *s = context;
    const otx_arena_mark mark = otx_arena_here(s->run.scratch);
    otx_sheet sheet;
    otx_vec2 *out;

    OTX_TRY(otx_sheet_build(
        &s->run, &s->surface, s->texels, s->cut, NULL, s->uvs, &sheet));
    out = OTX_NEW(s->run.scratch, otx_vec2, sheet.count);
    if (!out)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t round = 0; round < s->rounds; ++round)
    {
        for (int32_t i = 0; i < sheet.seam_count; ++i)
        {
            const otx_sheet_seam *seam = &sheet.seams[i];
            const otx_vec2 a[2] = {sheet.at[seam->a[0]], sheet.at[seam->a[1]]};
            const otx_vec2 b[2] = {sheet.at[seam->b[0]], sheet.at[seam->b[1]]};

            look_up(s, a, seam->length, false);
            look_up(s, b, seam->length, false);
        }
        for (int32_t k = 0; k < RELAX_PRODUCTS; ++k)
            otx_rigid_apply(&sheet.rigid, sheet.at, 0, sheet.count, out);
    }
    otx_arena_release(s->run.scratch, mark);
    return OSDTEX_OK;
}

/* -- scene --------------------------------------------------------------- */

static otx_status
allocate(scene *s)
{
    otx_arena *arena = s->run.arena;
    const otx_level *leaf = s->leaves.level;
    const int32_t n = s->clusters.count;

    s->charts = OTX_NEW(arena, otx_chart, n);
    s->rigids = OTX_NEW(arena, otx_rigid, n);
    s->products = OTX_NEW(arena, int32_t, n);
    s->offers = OTX_NEW(arena, otx_offer, n);
    s->labels = OTX_NEW(arena, int32_t, leaf->face_count);
    s->cut = OTX_NEW(arena, int32_t, leaf->face_count);
    s->uvs = OTX_NEW(arena, otx_vec2, leaf->corner_count);
    s->sink = OTX_NEW(arena, float, 3 * SAMPLES_MOST);
    if (!s->charts || !s->rigids || !s->products || !s->offers || !s->labels ||
        !s->cut || !s->uvs || !s->sink)
        return OSDTEX_ERROR_MEMORY;
    return otx_chart_space_create(&s->run, arena, &s->surface, &s->space);
}

static otx_status
grow(scene *s)
{
    const otx_level *leaf = s->leaves.level;
    const double diameter = 0.5 * EXEMPLAR / s->texels;
    int32_t *faces = OTX_NEW(s->run.arena, int32_t, leaf->face_count);
    const otx_cluster all = {
        s->leaves.level_index, leaf->face_count, faces, s->surface.area, -1};
    otx_cluster_space space;
    const otx_growing how = {&s->leaves, 1.0, &space};

    if (!faces)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        faces[f] = f;
    OTX_TRY(otx_cluster_space_create(&s->run, leaf, &space));
    return otx_cluster_grow(
        &s->run, &how, &all, diameter * diameter, 1, &s->clusters);
}

static otx_status
open_scene(scene *s, int32_t level)
{
    otx_image pixels;

    OTX_TRY(bench_shapes_octopus(&s->run, &s->cage));
    OTX_TRY(otx_surface_refine(&s->run, &s->cage, level, 0, &s->surface));
    OTX_TRY(bench_patterns_pebbles(&s->run, EXEMPLAR, &pixels));
    OTX_TRY(bench_patterns_exemplar(&s->run, &pixels, &s->exemplar));
    OTX_TRY(otx_dual_build(&s->run, &s->surface, level, &s->leaves));
    s->texels = LEAF_TEXELS / s->surface.mean_edge_length;
    OTX_TRY(grow(s));
    OTX_TRY(allocate(s));
    OTX_TRY(flatten_all(s, s->run.arena, s->charts));
    OTX_TRY(make_rigids(s));
    for (int32_t i = 0; i < s->clusters.count; ++i)
        OTX_TRY(make_offer(s, i));
    OTX_TRY(run_cut(s));
    take_uvs(s);
    return run_relax(s);
}

/* -- row ----------------------------------------------------------------- */

static bool
time_stage(
    scene *s, const char *name, otx_status (*floor)(void *),
    otx_status (*ours)(void *), int32_t repeat, bench_report *report)
{
    bench_lane lanes[2] = {
        {.body = floor, .context = s}, {.body = ours, .context = s}};

    if (bench_stopwatch_race(lanes, 2, repeat) != OSDTEX_OK)
        return false;

    const double values[] = {
        1e3 * lanes[0].best.cpu, 1e3 * lanes[1].best.cpu,
        lanes[1].best.cpu / lanes[0].best.cpu,
        lanes[1].median.cpu / lanes[0].median.cpu};

    bench_report_row(report, name, values);
    return true;
}

static bool
time_stages(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "stage", "floor", "ours", "ours / floor", "same, median", NULL};
    const int32_t repeat = bench_row_repeat(options, USUAL_TURNS);
    scene s = {0};
    bool right = bench_workspace_open(&s.run, 1) == OSDTEX_OK &&
                 open_scene(&s, 3) == OSDTEX_OK;

    bench_report_begin(
        report,
        "stages: an octopus of 34 176 faces in patches of 128 texels, ms of "
        "one core",
        columns);
    right =
        right &&
        time_stage(
            &s, "flatten", run_flatten_floor, run_flatten, repeat, report) &&
        time_stage(&s, "cut", run_cut_floor, run_cut, repeat, report) &&
        time_stage(&s, "relax", run_relax_floor, run_relax, repeat, report);
    bench_workspace_close(&s.run);
    return right;
}

const bench_row bench_row_stages = {
    .name = "stages",
    .summary = "Flattening, cut and relaxation against bare loops over the "
               "same data.",
    .time = time_stages,
};

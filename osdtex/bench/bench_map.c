/* bench_map.c -- the whole job: a sphere and an octopus of the sizes that
 * [Soler02, sec. 6] gives times for, a cage of the user's, and growth.
 *
 * The job is refinement and mapping of a cage and an exemplar in memory;
 * reading and writing files are rows of their own. Every leaf face is about
 * ten texels wide, so that more faces are more texture to lay, not the same
 * texture in smaller pieces. */
#include "bench/general_mesh.h"
#include "bench/map_job.h"
#include "bench/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    LEAF_TEXELS = 10,
    EXEMPLAR = 256,
    MOST_TURNS = 99,
    STAGE_COUNT = 7
};

/* -- cages --------------------------------------------------------------- */

static otx_status
make_sphere(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_shapes_sphere(run, 4, false, out);
}

/* 12 * 9^2 * 4^l faces at level l: 995 328 at level 5. */
static otx_status
make_fine_sphere(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_shapes_sphere(run, 9, false, out);
}

static otx_status
make_octopus(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_shapes_octopus(run, out);
}

static otx_status
read_cage(otx_run *run, const bench_options *options, otx_cage *out)
{
    return bench_shapes_read(run, options->cage, out);
}

static otx_status
make_bunny(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_general_mesh(run, BENCH_GENERAL_BUNNY, out);
}

static otx_status
make_pumpkin(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_general_mesh(run, BENCH_GENERAL_PUMPKIN, out);
}

static otx_status
make_triceratops(otx_run *run, const bench_options *options, otx_cage *out)
{
    (void)options;
    return bench_general_mesh(run, BENCH_GENERAL_TRICERATOPS, out);
}

static const bench_map_cage GENERAL[BENCH_GENERAL_COUNT] = {
    make_bunny, make_pumpkin, make_triceratops};

/* -- figures ------------------------------------------------------------- */

static int
by_wall(const void *a, const void *b)
{
    const double x = ((const bench_map_result *)a)->whole.wall;
    const double y = ((const bench_map_result *)b)->whole.wall;

    return (x > y) - (x < y);
}

/* One job on one thread and on those of the options. */
typedef struct timing
{
    const char *label;
    bench_map_result median[2];  /* by wall time */
    double best[2][STAGE_COUNT]; /* wall seconds of stages, least */
} timing;

/* Refinement, the stages of the mapping, and the whole. */
static const char *const STAGES[STAGE_COUNT] = {
    "refine", "prepare", "flatten", "fit", "cut", "relax", "all"};

static double
stage_seconds(const bench_map_result *r, int32_t stage)
{
    if (stage == 0)
        return r->refine;
    return stage + 1 == STAGE_COUNT ? r->whole.wall
                                    : bench_map_job_stage(r, STAGES[stage]);
}

/* `repeat` jobs by turns on one thread and on several, where there are. */
static otx_status
run_turns(const bench_map_job *template, int32_t repeat, timing *out)
{
    const int lanes = template->options->threads > 1 ? 2 : 1;
    bench_map_result turns[2][MOST_TURNS];
    bench_map_job job = *template;

    for (int32_t r = 0; r < repeat; ++r)
        for (int l = 0; l < lanes; ++l)
        {
            job.threads = l == 0 ? 1 : job.options->threads;
            OTX_TRY(bench_map_job_run(&job, &turns[l][r]));
        }
    for (int l = 0; l < lanes; ++l)
    {
        for (int32_t s = 0; s < STAGE_COUNT; ++s)
        {
            out->best[l][s] = stage_seconds(&turns[l][0], s);
            for (int32_t r = 1; r < repeat; ++r)
                out->best[l][s] =
                    fmin(out->best[l][s], stage_seconds(&turns[l][r], s));
        }
        qsort(turns[l], (size_t)repeat, sizeof *turns[l], by_wall);
        out->median[l] = turns[l][repeat / 2];
    }
    return OSDTEX_OK;
}

static const char *const COLUMNS[] = {
    "cage",  "faces",     "patches",       "fits",          "threads", "wall s",
    "cpu s", "us a face", "refine",        "prepare",       "flatten", "fit",
    "cut",   "relax",     "heap B a face", "peak B a face", NULL};

static void
write_row(
    bench_report *report, const char *label, int32_t threads,
    const bench_map_result *r)
{
    const double faces = r->leaf_faces;
    const double values[] = {
        faces,
        r->patch_count,
        otx_figures_value(&r->figures, "fits"),
        threads,
        r->whole.wall,
        r->whole.cpu,
        1e6 * r->whole.cpu / faces,
        r->refine,
        bench_map_job_stage(r, "prepare"),
        bench_map_job_stage(r, "flatten"),
        bench_map_job_stage(r, "fit"),
        bench_map_job_stage(r, "cut"),
        bench_map_job_stage(r, "relax"),
        floor(r->heap_bytes / faces),
        floor(r->resident_bytes / faces),
    };

    bench_report_row(report, label, values);
}

/* One thread, then those of the options. */
static bool
time_job(
    const char *label, const bench_map_job *job, int32_t repeat,
    bench_report *report, timing *out)
{
    const int32_t threads = job->options->threads;

    out->label = label;
    if (run_turns(job, repeat, out) != OSDTEX_OK)
        return false;
    write_row(report, label, 1, &out->median[0]);
    if (threads > 1)
        write_row(report, label, threads, &out->median[1]);
    return true;
}

/* How much faster each stage is on several threads. */
static void
write_ratios(
    const bench_options *options, const timing *timings, int32_t count,
    bench_report *report)
{
    static const char *const columns[] = {
        "stage", "1 thread", "several", "ratio", NULL};
    char text[96];

    snprintf(
        text, sizeof text, "threads: wall seconds on 1 and on %d, best turns",
        (int)options->threads);
    bench_report_begin(report, text, columns);
    for (int32_t k = 0; k < count; ++k)
        for (int32_t s = 0; s < STAGE_COUNT; ++s)
        {
            const double *one = timings[k].best[0], *more = timings[k].best[1];
            const double values[] = {one[s], more[s], one[s] / more[s]};

            snprintf(text, sizeof text, "%s, %s", timings[k].label, STAGES[s]);
            bench_report_row(report, text, values);
        }
}

/* The user's cage as the program would map it without --level and --scale. */
static bench_map_job
own_job(const bench_options *options)
{
    return (bench_map_job){
        .options = options,
        .cage = read_cage,
        .level = -1,
        .leaf = LEAF_TEXELS,
        .exemplar_size = options->exemplar ? 0 : EXEMPLAR};
}

/* -- rows ---------------------------------------------------------------- */

static bool
time_map(const bench_options *options, bench_report *report)
{
    const int32_t repeat = bench_row_repeat(options, 3);
    const bench_map_job sphere = {
        .options = options,
        .cage = make_sphere,
        .level = 2,
        .leaf = LEAF_TEXELS,
        .exemplar_size = EXEMPLAR};
    const bench_map_job octopus = {
        .options = options,
        .cage = make_octopus,
        .level = 3,
        .leaf = LEAF_TEXELS,
        .exemplar_size = EXEMPLAR};
    const bench_map_job own = own_job(options);
    bench_map_job large = octopus;
    timing timings[4];
    int32_t count = 0;
    bool right;

    large.exemplar_size = 2 * EXEMPLAR;
    bench_report_begin(
        report,
        "map: refinement and mapping, exemplar 256 x 256, octopus also 512 x "
        "512; stages are wall seconds (median job)",
        COLUMNS);
    right =
        time_job("sphere", &sphere, repeat, report, &timings[count++]) &&
        time_job("octopus", &octopus, repeat, report, &timings[count++]) &&
        time_job("octopus, 512", &large, repeat, report, &timings[count++]) &&
        (!options->cage ||
         time_job("own", &own, repeat, report, &timings[count++]));
    if (right && options->threads > 1)
        write_ratios(options, timings, count, report);
    return right;
}

static bool
time_growth(const bench_options *options, bench_report *report)
{
    timing unused;
    bool right = true;

    bench_report_begin(
        report, "growth: the same on finer and finer spheres", COLUMNS);
    for (int32_t level = 1; level <= (options->large ? 5 : 3); ++level)
    {
        const bench_map_job job = {
            .options = options,
            .cage = make_fine_sphere,
            .level = level,
            .leaf = LEAF_TEXELS,
            .exemplar_size = EXEMPLAR};

        right = right && time_job(
                             "sphere", &job, bench_row_repeat(options, 1),
                             report, &unused);
    }
    return right;
}

/* A mesh without a hierarchy, as published. */
static bench_map_job
general_job(const bench_options *options, int kind)
{
    return (bench_map_job){
        .options = options,
        .cage = GENERAL[kind],
        .leaf = LEAF_TEXELS,
        .exemplar_size = EXEMPLAR,
        .paper = true};
}

static bool
time_general(const bench_options *options, bench_report *report)
{
    timing timings[BENCH_GENERAL_COUNT];
    bool right = true;

    bench_report_begin(
        report,
        "general: meshes without a hierarchy in mode paper, exemplar 256 x 256",
        COLUMNS);
    for (int k = 0; k < BENCH_GENERAL_COUNT; ++k)
    {
        const bench_map_job job = general_job(options, k);

        right =
            right && time_job(
                         bench_general_mesh_name((bench_general_kind)k), &job,
                         bench_row_repeat(options, 3), report, &timings[k]);
    }
    if (right && options->threads > 1)
        write_ratios(options, timings, BENCH_GENERAL_COUNT, report);
    return right;
}

/* Same bytes from 1, 2 and 8 threads; every face covered, none flipped. */
static bool
verify_job(const char *label, const bench_map_job *template)
{
    static const int32_t threads[] = {1, 2, 8};
    bench_map_result first, other;
    bool right = true;

    for (int t = 0; t < 3; ++t)
    {
        bench_map_job job = *template;

        job.threads = threads[t];
        if (bench_map_job_run(&job, t == 0 ? &first : &other) != OSDTEX_OK)
            return false;
        if (t > 0)
            right &= bench_row_check(
                strcmp(first.hash, other.hash) == 0,
                "map %s: UVs of 1 and %d threads %s %s", label, threads[t],
                first.hash, other.hash);
    }
    return bench_row_check(
               first.bare_faces == 0 && first.flipped_faces == 0,
               "map %s: %d of %d faces without UVs, %d flipped", label,
               first.bare_faces, first.leaf_faces, first.flipped_faces) &&
           right;
}

static bool
verify_map(const bench_options *options)
{
    const bench_map_job sphere = {
        .options = options,
        .cage = make_sphere,
        .level = 2,
        .leaf = LEAF_TEXELS,
        .exemplar_size = 128};
    const bench_map_job octopus = {
        .options = options,
        .cage = make_octopus,
        .level = 2,
        .leaf = LEAF_TEXELS,
        .exemplar_size = 128};
    const bench_map_job own = own_job(options);
    bool right = verify_job("sphere", &sphere);

    right &= verify_job("octopus", &octopus);
    if (options->cage)
        right &= verify_job("own", &own);
    return right;
}

const bench_row bench_row_map = {
    .name = "map",
    .summary = "The whole job on a sphere of 3072 faces and on an octopus of "
               "34 176, stage by stage.",
    .time = time_map,
    .verify = verify_map,
};

static bool
verify_general(const bench_options *options)
{
    bool right = true;

    for (int k = 0; k < BENCH_GENERAL_COUNT; ++k)
    {
        const bench_map_job job = general_job(options, k);

        right &=
            verify_job(bench_general_mesh_name((bench_general_kind)k), &job);
    }
    return right;
}

const bench_row bench_row_general = {
    .name = "general",
    .summary = "Meshes of 2962, 10 000 and 5660 triangles without a hierarchy, "
               "in the mode that is as published.",
    .time = time_general,
    .verify = verify_general,
};

const bench_row bench_row_growth = {
    .name = "growth",
    .summary = "Time and memory a face as the mesh grows, to a million faces "
               "with --large.",
    .time = time_growth,
};

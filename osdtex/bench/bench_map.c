/* bench_map.c -- the whole job: a sphere and an octopus of the sizes that
 * [Soler02, sec. 6] gives times for, a cage of the user's, and growth.
 *
 * The job is refinement and mapping of a cage and an exemplar in memory;
 * reading and writing files are rows of their own. Every leaf face is about
 * ten texels wide, so that more faces are more texture to lay, not the same
 * texture in smaller pieces. */
#include "bench/map_job.h"
#include "bench/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    LEAF_TEXELS = 10,
    EXEMPLAR = 256,
    MOST_TURNS = 99
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

/* -- figures ------------------------------------------------------------- */

static int
by_wall(const void *a, const void *b)
{
    const double x = ((const bench_map_result *)a)->whole.wall;
    const double y = ((const bench_map_result *)b)->whole.wall;

    return (x > y) - (x < y);
}

/* The median of `repeat` jobs, by wall time. */
static otx_status
run_median(const bench_map_job *job, int32_t repeat, bench_map_result *out)
{
    bench_map_result turns[MOST_TURNS];

    for (int32_t r = 0; r < repeat; ++r)
        OTX_TRY(bench_map_job_run(job, &turns[r]));
    qsort(turns, (size_t)repeat, sizeof *turns, by_wall);
    *out = turns[repeat / 2];
    return OSDTEX_OK;
}

static const char *const COLUMNS[] = {
    "cage",  "faces",     "patches",       "fits",          "threads", "wall s",
    "cpu s", "us a face", "refine",        "prepare",       "flatten", "fit",
    "cut",   "relax",     "heap B a face", "peak B a face", NULL};

static void
write_row(
    bench_report *report, const char *label, const bench_map_job *job,
    const bench_map_result *r)
{
    const double faces = r->leaf_faces;
    const double values[] = {
        faces,
        r->patch_count,
        r->stats.fit_count,
        job->threads,
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
    const char *label, const bench_map_job *template, int32_t repeat,
    bench_report *report)
{
    bench_map_job job = *template;
    bench_map_result result;

    for (int turn = 0; turn < 2; ++turn)
    {
        job.threads = turn == 0 ? 1 : job.options->threads;
        if (turn == 1 && job.threads == 1)
            break;
        if (run_median(&job, repeat, &result) != OSDTEX_OK)
            return false;
        write_row(report, label, &job, &result);
    }
    return true;
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

    large.exemplar_size = 2 * EXEMPLAR;
    bench_report_begin(
        report,
        "map: refinement and mapping, exemplar 256 x 256, octopus also 512 x "
        "512; stages are wall seconds (median job)",
        COLUMNS);
    return time_job("sphere", &sphere, repeat, report) &&
           time_job("octopus", &octopus, repeat, report) &&
           time_job("octopus, 512", &large, repeat, report) &&
           (!options->cage || time_job("own", &own, repeat, report));
}

static bool
time_growth(const bench_options *options, bench_report *report)
{
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

        right = right &&
                time_job("sphere", &job, bench_row_repeat(options, 1), report);
    }
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

const bench_row bench_row_growth = {
    .name = "growth",
    .summary = "Time and memory a face as the mesh grows, to a million faces "
               "with --large.",
    .time = time_growth,
};

/* bench_surface.c -- refinement and limit against bare OpenSubdiv calls.
 *
 * Both start at the same validated cage and end with everything destroyed. Ours
 * also copies out the relations of all levels and makes frames, which the
 * pipe needs; that is the price in processor time. In elapsed time it is
 * spread over the threads, which OpenSubdiv's own part is not. */
#include "bench/bench_row.h"
#include "bench/raw_refine.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include <math.h>
#include <stdio.h>

enum
{
    SPHERE = 16, /* 3072 faces */
    USUAL_TURNS = 5,
    LANES = 3
};

typedef struct refinement
{
    const otx_cage *cage;
    int32_t level;
    int32_t threads;
} refinement;

static bool
refine_raw(const otx_cage *cage, int32_t level, float *points)
{
    const bench_raw_cage raw = {
        .vert_count = cage->vert_count,
        .face_count = cage->face_count,
        .uv_count = cage->uv_count,
        .points = cage->points,
        .face_verts = cage->face_verts,
        .uvs = cage->uvs,
        .face_uvs = cage->face_uvs,
    };

    return bench_raw_refine_run(&raw, level, points);
}

static otx_status
run_raw(void *context)
{
    const refinement *r = context;

    return refine_raw(r->cage, r->level, NULL) ? OSDTEX_OK
                                               : OSDTEX_ERROR_NUMERIC;
}

static otx_status
run_ours(void *context)
{
    const refinement *r = context;
    otx_surface surface;
    otx_status status;
    otx_run run;

    OTX_TRY(bench_workspace_open(&run, r->threads));
    status = otx_surface_refine(&run, r->cage, r->level, 0, &surface);
    bench_workspace_close(&run);
    return status;
}

static bool
time_level(
    const otx_cage *cage, int32_t level, const bench_options *options,
    bench_report *report)
{
    refinement one = {cage, level, 1};
    refinement all = {cage, level, options->threads};
    bench_lane lanes[LANES] = {
        {.body = run_raw, .context = &one},
        {.body = run_ours, .context = &one},
        {.body = run_ours, .context = &all},
    };
    char label[64];

    if (bench_stopwatch_race(
            lanes, LANES, bench_row_repeat(options, USUAL_TURNS)) != OSDTEX_OK)
        return false;
    const double values[] = {
        floor(cage->face_count * pow(4.0, level)),
        lanes[0].best.cpu,
        lanes[1].best.cpu,
        lanes[1].best.cpu / lanes[0].best.cpu,
        lanes[1].median.cpu / lanes[0].median.cpu,
        lanes[0].best.wall,
        lanes[2].best.wall,
        lanes[2].best.wall / lanes[0].best.wall,
        lanes[2].median.wall / lanes[0].median.wall,
    };

    snprintf(
        label, sizeof label, "level %d%s", level,
        cage->uv_count > 0 ? ", UVs" : "");
    bench_report_row(report, label, values);
    return true;
}

static bool
time_surface(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "sphere",
        "faces",
        "raw, cpu s",
        "ours, cpu s",
        "ours / raw",
        "same, median",
        "raw, wall s",
        "ours, wall N",
        "ours / raw, wall",
        "same, median, wall",
        NULL};
    bool right = true;

    bench_report_begin(
        report,
        "surface: refinement, limit, tangents against bare OpenSubdiv calls, "
        "destruction included (cpu: one thread; wall N: all threads)",
        columns);
    for (int32_t with_uvs = 0; with_uvs < 2; ++with_uvs)
    {
        otx_run run;
        otx_cage cage;

        if (bench_workspace_open(&run, 1) != OSDTEX_OK)
            return false;
        right = right &&
                bench_shapes_sphere(&run, SPHERE, with_uvs, &cage) == OSDTEX_OK;
        for (int32_t level = 2; level <= (options->large ? 5 : 4); ++level)
            right = right && time_level(&cage, level, options, report);
        bench_workspace_close(&run);
    }
    return right;
}

/* Largest distance between our limit and OpenSubdiv's; INFINITY on failure. */
static double
largest_distance(otx_run *run, const otx_cage *cage, int32_t level)
{
    double largest = 0.0;
    otx_surface surface;
    float *points;

    if (otx_surface_refine(run, cage, level, 0, &surface) != OSDTEX_OK)
        return INFINITY;
    const int64_t floats = 3 * (int64_t)otx_surface_leaf(&surface)->vert_count;

    points = OTX_NEW(run->arena, float, floats);
    if (!points || !refine_raw(cage, level, points))
        return INFINITY;
    for (int64_t i = 0; i < floats; ++i)
        largest = fmax(largest, fabs((double)(points[i] - surface.points[i])));
    return largest;
}

static bool
verify_surface(const bench_options *options)
{
    double largest = INFINITY;
    otx_run run;
    otx_cage cage;

    if (bench_workspace_open(&run, options->threads) != OSDTEX_OK)
        return false;
    if (bench_shapes_sphere(&run, SPHERE, true, &cage) == OSDTEX_OK)
        largest = largest_distance(&run, &cage, 3);
    bench_workspace_close(&run);
    return bench_row_check(
        largest == 0.0,
        "surface: limit of level 3 and OpenSubdiv's differ by %.2g", largest);
}

const bench_row bench_row_surface = {
    .name = "surface",
    .summary = "Refinement and limit against bare OpenSubdiv calls that do "
               "the same.",
    .time = time_surface,
    .verify = verify_surface,
};

/* bench_field.c -- direction, scale and periodic coordinates, stage by stage,
 * on spheres of growing size, on the level that the method would solve on
 * and on the leaves. Lines on a sphere have singularities of half a
 * turn, so that the coordinates need the larger, real system. */
#include "bench/bench_row.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "field/nested.h"
#include "field/scale.h"
#include "periodic/phase.h"

#include <math.h>
#include <stdio.h>

enum
{
    STAGES = 4 /* connection, direction, scale, phase */
};

/* Leaf edges along a cell. */
static const double EDGES_PER_CELL = 6.0;

typedef struct field_job
{
    otx_run run;
    otx_surface *surface;
    int32_t symmetry;
    bool leaf; /* solves on the leaf level, not on that of its own choice */
    double seconds[STAGES];
    double peak;
    int32_t defects;
    int32_t solved; /* triangles of the level that is solved on */
} field_job;

static otx_status
open_job(field_job *job, int32_t side)
{
    otx_cage *cage;

    OTX_TRY(bench_workspace_open(&job->run, 1));
    job->surface = OTX_ZNEW(job->run.arena, otx_surface, 1);
    cage = OTX_ZNEW(job->run.arena, otx_cage, 1);
    if (!job->surface || !cage)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(bench_shapes_sphere(&job->run, side, false, cage));
    return otx_surface_refine(&job->run, cage, 2, 0, job->surface);
}

/* Adds what has passed since `since` to a stage; the next one starts. */
static void
note(field_job *job, int stage, bench_time *since)
{
    job->seconds[stage] = bench_stopwatch_since(*since).cpu;
    *since = bench_stopwatch_now();
}

static otx_status
solve(field_job *job)
{
    const double cell = EDGES_PER_CELL * job->surface->mean_edge_length;
    const otx_direction_request asked = {.symmetry = job->symmetry};
    otx_connection connection;
    otx_direction field;
    otx_phase_request request = {
        .field = &field, .gradient = {{1.0 / cell, 0}, {0, 1.0 / cell}}};
    otx_phase phase;
    double *log_scale;
    bench_time since = bench_stopwatch_now();

    OTX_TRY(otx_connection_build(
        &job->run, job->surface,
        job->leaf ? job->surface->level_count - 1
                  : otx_phase_level(job->surface, cell),
        &connection));
    job->solved = 2 * connection.level->face_count;
    note(job, 0, &since);
    OTX_TRY(otx_nested_solve(&job->run, &connection, &asked, &field));
    note(job, 1, &since);
    OTX_TRY(otx_scale_solve(&job->run, &field, 0.5 * log(2.0), &log_scale));
    note(job, 2, &since);
    request.log_scale = log_scale;
    OTX_TRY(otx_phase_solve(&job->run, &request, &phase));
    note(job, 3, &since);
    job->defects = phase.defect_count;
    return OSDTEX_OK;
}

static bool
time_size(int32_t side, bool leaf, bench_report *report)
{
    field_job job = {.symmetry = 2, .leaf = leaf};
    bool right;

    bench_workspace_reset_peak();
    right = open_job(&job, side) == OSDTEX_OK && solve(&job) == OSDTEX_OK;
    if (right)
    {
        const double triangles =
            2.0 * otx_surface_leaf(job.surface)->face_count;
        const double all =
            job.seconds[0] + job.seconds[1] + job.seconds[2] + job.seconds[3];
        const double values[] = {
            job.solved,
            job.seconds[0],
            job.seconds[1],
            job.seconds[2],
            job.seconds[3],
            all,
            1e6 * all / triangles,
            1e-6 * bench_workspace_peak(),
            job.defects};
        char label[16];

        snprintf(label, sizeof label, "%.0f", triangles);
        bench_report_row(report, label, values);
    }
    bench_workspace_close(&job.run);
    return right;
}

static bool
time_field(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "triangles", "solved on", "connection, s", "direction, s", "scale, s",
        "phase, s",  "all, s",    "us a triangle", "MB",           "defects",
        NULL};
    static const int32_t sides[] = {10, 26, 51}; /* 192 n^2 quads */
    bool right = true;

    bench_report_begin(
        report,
        "field: directions, scale and periodic coordinates, processor time of "
        "one thread",
        columns);
    for (int i = 0; i < 3 && right; ++i)
        right = time_size(sides[i], false, report);
    for (int i = 0; i < (options->large ? 3 : 2) && right; ++i)
        right = time_size(sides[i], true, report);
    return right;
}

const bench_row bench_row_field = {
    .name = "field",
    .summary = "Directions, scale and periodic coordinates on spheres of "
               "38 000, 260 000 and 1 000 000 triangles.",
    .time = time_field,
};

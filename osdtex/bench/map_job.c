/* map_job.c -- the whole job once, from a cage to a mapping. */
#include "bench/map_job.h"

#include "bench/patterns.h"
#include "bench/shapes.h"
#include "bench/workspace.h"

#include <string.h>

static otx_status
make_exemplar(otx_run *run, const bench_map_job *job, otx_exemplar *out)
{
    otx_image pixels;

    if (job->exemplar_size == 0)
        return bench_patterns_read(run, job->options->exemplar, out);
    OTX_TRY(bench_patterns_pebbles(run, job->exemplar_size, &pixels));
    return bench_patterns_exemplar(run, &pixels, out);
}

/* At the level asked for, or at a fifth of the cage's diagonal for the width
 * of the exemplar, as the program does without --level and --scale. */
static otx_status
make_surface(
    otx_run *run, const bench_map_job *job, const otx_cage *cage,
    const otx_exemplar *exemplar, otx_surface *out)
{
    const double texel = 0.2 * cage->diagonal / exemplar->match.width;
    const int32_t level = job->level >= 0
                              ? job->level
                              : otx_surface_level_for(cage, job->leaf * texel);

    return otx_surface_refine(run, cage, level, 0, out);
}

static void
inspect(const otx_mapping *mapping, bench_map_result *out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    out->leaf_faces = leaf->face_count;
    out->patch_count = mapping->patch_count;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        double area = 0.0;

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            const int32_t next =
                c + 1 < leaf->face_first[f + 1] ? c + 1 : leaf->face_first[f];
            const float *p = mapping->uvs + 2 * (size_t)c;
            const float *q = mapping->uvs + 2 * (size_t)next;

            area += (double)p[0] * (double)q[1] - (double)p[1] * (double)q[0];
        }
        out->bare_faces += !leaf->face_hole[f] && mapping->face_patch[f] < 0;
        out->flipped_faces += mapping->face_patch[f] >= 0 && !(area > 0.0);
    }
    otx_hash_text(
        mapping->uvs, 2 * (size_t)leaf->corner_count * sizeof(float),
        out->hash);
}

static otx_status
map(otx_run *run, const bench_map_job *job, bench_map_result *out)
{
    const otx_method *method = otx_method_find("hierarchical");
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    otx_map_request request = {.first_face = -1};
    bench_time start;
    otx_cage cage;
    otx_exemplar exemplar;
    otx_surface surface;
    otx_mapping mapping;

    if (!settings)
        return OSDTEX_ERROR_MEMORY;
    otx_option_defaults(method->options, method->option_count, settings);
    if (job->paper)
        OTX_TRY(otx_option_set(
            run, method->options, method->option_count, settings, "mode",
            "paper"));
    OTX_TRY(job->cage(run, job->options, &cage));
    OTX_TRY(make_exemplar(run, job, &exemplar));
    start = bench_stopwatch_now();
    OTX_TRY(make_surface(run, job, &cage, &exemplar, &surface));
    out->refine = bench_stopwatch_since(start).wall;
    request.scale = job->level < 0 ? 0.2 * cage.diagonal
                                   : exemplar.match.width / job->leaf *
                                         surface.mean_edge_length;
    OTX_TRY(otx_method_map(
        method,
        &(otx_job){
            .run = run,
            .surface = &surface,
            .exemplars = &exemplar,
            .exemplar_count = 1,
            .request = &request,
            .settings = settings,
            .figures = &out->figures,
        },
        &mapping));
    out->whole = bench_stopwatch_since(start);
    inspect(&mapping, out);
    return OSDTEX_OK;
}

otx_status
bench_map_job_run(const bench_map_job *job, bench_map_result *out)
{
    otx_status status;
    otx_run run;

    *out = (bench_map_result){0};
    bench_workspace_reset_peak();
    OTX_TRY(bench_workspace_open(&run, job->threads));
    status = map(&run, job, out);
    out->resident_bytes = bench_workspace_peak();
    out->heap_bytes = (double)otx_allocator_peak(run.allocator);
    bench_workspace_close(&run);
    return status;
}

double
bench_map_job_stage(const bench_map_result *result, const char *name)
{
    double seconds = NAN;

    for (int32_t s = 0; s < result->figures.stage_count; ++s)
        if (strcmp(result->figures.stages[s].name, name) == 0)
            seconds = (isfinite(seconds) ? seconds : 0.0) +
                      result->figures.stages[s].seconds;
    return seconds;
}

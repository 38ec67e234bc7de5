/* territory.c -- who makes which face. */
#include "heal/territory.h"

#include "mapping/seam.h"

enum
{
    ROUNDS = 5 /* of flattening */
};

#define BEND 1.0 /* how much borders of cores prefer bends */

/* Charts being laid out; each has an arena, every thread a space. */
typedef struct layout_job
{
    otx_run *run;
    const otx_surface *surface;
    const otx_dual *leaves;
    const otx_territory_options *options;
    const otx_cluster *clusters; /* [count] of the leaf level */
    otx_chart_space *spaces;
    otx_arena **arenas;
    otx_chart *charts;
    int32_t count;
} layout_job;

/* Leaf faces that show exemplar k; the count. */
static int32_t
faces_of(const otx_mapping *mapping, int32_t k, int32_t *out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    int32_t count = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (otx_seam_covered(mapping, f) && otx_source_of(mapping, f) == k)
            out[count++] = f;
    return count;
}

/* Cores of one exemplar, appended to those of the others. */
static otx_status
append_cores(
    otx_run *run, const otx_mapping *mapping, const otx_growing *how, int32_t k,
    const otx_territory_options *options, otx_cluster *all, int32_t *exemplar,
    int32_t *count)
{
    const otx_dual *dual = how->dual;
    const double side = options->side / options->texels;
    int32_t *faces = OTX_NEW(run->scratch, int32_t, dual->level->face_count);
    otx_cluster region = {.level = dual->level_index, .faces = faces};
    otx_cluster_list list;

    if (!faces)
        return otx_fail_memory(run, "heal");
    region.face_count = faces_of(mapping, k, faces);
    for (int32_t i = 0; i < region.face_count; ++i)
        region.area += dual->areas[faces[i]];
    OTX_TRY(otx_cluster_grow(run, how, &region, side * side, 1, &list));
    for (int32_t i = 0; i < list.count; ++i)
    {
        exemplar[*count] = k;
        all[(*count)++] = list.clusters[i];
    }
    return OSDTEX_OK;
}

static void
free_arenas(void *object)
{
    layout_job *job = object;

    for (int32_t i = 0; i < job->count; ++i)
        otx_arena_destroy(job->arenas[i]);
}

/* With a narrower collar where that folds the core. */
static otx_status
lay_out(void *context, int64_t index, otx_worker *worker)
{
    layout_job *job = context;
    const otx_cluster *core = &job->clusters[index];
    otx_chart *chart = &job->charts[index];
    otx_chart_request request = {
        .surface = job->surface,
        .leaves = job->leaves,
        .texels = job->options->texels,
        .collar = job->options->collar,
        .rounds = ROUNDS,
        .worker = worker};

    job->arenas[index] = otx_arena_create(job->run->allocator);
    if (!job->arenas[index])
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_chart_build(
        &request, core->faces, core->face_count, &job->spaces[worker->index],
        worker->scratch, job->arenas[index], chart));
    if (chart->worst < (double)INFINITY)
        return OSDTEX_OK;
    request.collar *= 0.5;
    OTX_TRY(otx_chart_build(
        &request, core->faces, core->face_count, &job->spaces[worker->index],
        worker->scratch, job->arenas[index], chart));
    if (!(chart->worst < (double)INFINITY))
        chart->face_count = chart->core_count = 0;
    return OSDTEX_OK;
}

static otx_status
lay_out_all(otx_run *run, layout_job *job)
{
    const int32_t threads = otx_pool_threads(run->pool);

    job->spaces = OTX_NEW(run->scratch, otx_chart_space, threads);
    job->arenas = OTX_ZNEW(run->scratch, otx_arena *, job->count);
    if (!job->spaces || !job->arenas ||
        !otx_arena_defer(run->scratch, free_arenas, job))
        return otx_fail_memory(run, "heal");
    for (int32_t i = 0; i < threads; ++i)
        OTX_TRY(otx_chart_space_create(
            run, run->scratch, job->surface, &job->spaces[i]));
    return otx_loop_result(
        run, "heal", otx_pool_for(run->pool, job->count, lay_out, job));
}

static void
claim(otx_territory *out, int32_t face_count)
{
    for (int32_t f = 0; f < face_count; ++f)
        out->owner[f] = -1;
    for (int32_t k = 0; k < out->count; ++k)
        for (int32_t i = 0; i < out->charts[k].core_count; ++i)
        {
            out->owner[out->charts[k].faces[i]] = k;
            out->slot[out->charts[k].faces[i]] = i;
        }
}

otx_status
otx_territory_build(
    otx_run *run, const otx_mapping *mapping,
    const otx_territory_options *options, otx_territory *out)
{
    const otx_surface *surface = mapping->surface;
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_dual *dual = OTX_NEW(run->scratch, otx_dual, 1);
    otx_cluster *cores = OTX_NEW(run->scratch, otx_cluster, leaf->face_count);
    int32_t *exemplar = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    layout_job *job = OTX_NEW(run->scratch, layout_job, 1);
    otx_cluster_space space;
    int32_t count = 0;

    out->owner = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    out->slot = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_dual_build(run, surface, surface->level_count - 1, dual));
    OTX_TRY(otx_cluster_space_create(run, leaf, &space));
    for (int32_t k = 0; k < otx_source_count(mapping); ++k)
        OTX_TRY(append_cores(
            run, mapping, &(otx_growing){dual, BEND, &space}, k, options, cores,
            exemplar, &count));
    *job = (layout_job){
        .run = run,
        .surface = surface,
        .leaves = dual,
        .options = options,
        .clusters = cores,
        .charts = OTX_ZNEW(run->scratch, otx_chart, count),
        .count = count};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(lay_out_all(run, job));
    out->count = count;
    out->charts = job->charts;
    out->exemplar = exemplar;
    claim(out, leaf->face_count);
    return OSDTEX_OK;
}

/* territory.c -- who makes which face. */
#include "territory/territory.h"

#include "mapping/seam.h"

enum
{
    ROUNDS = 5,  /* of flattening */
    COLLARS = 2, /* widths that are tried, and one more for each halving */
    HALVINGS = 8 /* of cores that fold */
};

#define BEND 1.0         /* how much borders of cores prefer bends */
#define STRETCH_MOST 1.8 /* of a face of a core, while it can be halved */

/* Cores that wait to be laid out, of the leaf level. */
typedef struct core_list
{
    otx_cluster *cores; /* [leaf face_count] */
    int32_t *exemplar;  /* likewise */
    int32_t count;
} core_list;

/* Charts being laid out; each has an arena, every thread a space. */
typedef struct layout_job
{
    otx_run *run;
    const otx_surface *surface;
    const otx_dual *leaves;
    const otx_territory_options *options;
    const otx_cluster *clusters; /* [count] */
    otx_chart_space *spaces;
    otx_arena **arenas;
    otx_chart *charts;
    int32_t count;
    int32_t collars; /* widths to try */
    double most;     /* stretch of a core's face */
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

/* The leaf faces that show exemplar k. */
static otx_status
region_of(
    otx_run *run, const otx_mapping *mapping, const otx_dual *dual, int32_t k,
    otx_cluster *out)
{
    int32_t *faces = OTX_NEW(run->scratch, int32_t, dual->level->face_count);

    if (!faces)
        return otx_fail_memory(run, "charts");
    *out = (otx_cluster){.level = dual->level_index, .faces = faces};
    out->face_count = faces_of(mapping, k, faces);
    for (int32_t i = 0; i < out->face_count; ++i)
        out->area += dual->areas[faces[i]];
    return OSDTEX_OK;
}

/* Parts a region into cores of about an area, at least `minimum` of them. */
static otx_status
append_cores(
    otx_run *run, const otx_growing *how, const otx_cluster *region,
    int32_t exemplar, double area, int32_t minimum, core_list *out)
{
    otx_cluster_list list;

    OTX_TRY(otx_cluster_grow(run, how, region, area, minimum, &list));
    for (int32_t i = 0; i < list.count; ++i)
    {
        out->exemplar[out->count] = exemplar;
        out->cores[out->count++] = list.clusters[i];
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

/* With narrower collars where they fold the core. */
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
    for (int i = 0; i < job->collars; ++i, request.collar *= 0.5)
    {
        OTX_TRY(otx_chart_build(
            &request, core->faces, core->face_count,
            &job->spaces[worker->index], worker->scratch, job->arenas[index],
            chart));
        if (chart->worst < job->most)
            return OSDTEX_OK;
    }
    chart->face_count = chart->core_count = 0;
    return OSDTEX_OK;
}

static otx_status
core_list_create(otx_run *run, int32_t capacity, core_list *out)
{
    out->cores = OTX_NEW(run->scratch, otx_cluster, capacity);
    out->exemplar = OTX_NEW(run->scratch, int32_t, capacity);
    out->count = 0;
    return otx_run_ok(run);
}

static otx_status
lay_out_all(
    otx_run *run, const otx_territory_options *options,
    const otx_surface *surface, const otx_growing *how, const core_list *list,
    int32_t collars, double most, layout_job **out)
{
    const int32_t threads = otx_pool_threads(run->pool);
    layout_job *job = OTX_NEW(run->scratch, layout_job, 1);

    OTX_TRY(otx_run_ok(run));
    *job = (layout_job){
        .run = run,
        .surface = surface,
        .leaves = how->dual,
        .options = options,
        .clusters = list->cores,
        .spaces = OTX_NEW(run->scratch, otx_chart_space, threads),
        .arenas = OTX_ZNEW(run->scratch, otx_arena *, list->count),
        .charts = OTX_ZNEW(run->scratch, otx_chart, list->count),
        .count = list->count,
        .collars = collars,
        .most = most};
    OTX_TRY(otx_run_ok(run));
    if (!otx_arena_defer(run->scratch, free_arenas, job))
        return otx_fail_memory(run, "charts");
    for (int32_t i = 0; i < threads; ++i)
        OTX_TRY(otx_chart_space_create(
            run, run->scratch, surface, &job->spaces[i]));
    *out = job;
    return otx_loop_result(
        run, "charts", otx_pool_for(run->pool, job->count, lay_out, job));
}

/* Appends the charts that were laid out without a fold. */
static otx_status
keep_charts(
    otx_run *run, const layout_job *job, const core_list *list,
    otx_territory *out)
{
    const int64_t most = (int64_t)out->count + job->count;
    otx_chart *charts = OTX_NEW(run->scratch, otx_chart, most);
    int32_t *exemplar = OTX_NEW(run->scratch, int32_t, most);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < out->count; ++i)
    {
        charts[i] = out->charts[i];
        exemplar[i] = out->exemplar[i];
    }
    for (int32_t i = 0; i < job->count; ++i)
        if (job->charts[i].face_count > 0)
        {
            exemplar[out->count] = list->exemplar[i];
            charts[out->count++] = job->charts[i];
        }
    out->charts = charts;
    out->exemplar = exemplar;
    return OSDTEX_OK;
}

/* The others in halves: around a limb, what is one disc does not lie flat. */
static otx_status
halve_folded(
    otx_run *run, const otx_growing *how, const layout_job *job,
    core_list *list)
{
    core_list halves;

    OTX_TRY(core_list_create(run, how->dual->level->face_count, &halves));
    for (int32_t i = 0; i < job->count; ++i)
        if (job->charts[i].face_count == 0 && list->cores[i].face_count > 1)
            OTX_TRY(append_cores(
                run, how, &list->cores[i], list->exemplar[i],
                0.5 * list->cores[i].area, 2, &halves));
    *list = halves;
    return OSDTEX_OK;
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

static otx_status
part(
    otx_run *run, const otx_mapping *mapping,
    const otx_territory_options *options, const otx_growing *how,
    core_list *out)
{
    const double side = options->side / options->texels;

    OTX_TRY(core_list_create(run, how->dual->level->face_count, out));
    for (int32_t k = 0; k < otx_source_count(mapping); ++k)
    {
        otx_cluster region;

        OTX_TRY(region_of(run, mapping, how->dual, k, &region));
        OTX_TRY(append_cores(run, how, &region, k, side * side, 1, out));
    }
    return OSDTEX_OK;
}

otx_status
otx_territory_build(
    otx_run *run, const otx_mapping *mapping,
    const otx_territory_options *options, otx_territory *out)
{
    const otx_surface *surface = mapping->surface;
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_dual *dual = OTX_NEW(run->scratch, otx_dual, 1);
    otx_cluster_space space;
    const otx_growing how = {dual, BEND, &space};
    core_list list;

    *out = (otx_territory){
        .owner = OTX_NEW(run->scratch, int32_t, leaf->face_count),
        .slot = OTX_NEW(run->scratch, int32_t, leaf->face_count)};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_dual_build(run, surface, surface->level_count - 1, dual));
    OTX_TRY(otx_cluster_space_create(run, leaf, &space));
    OTX_TRY(part(run, mapping, options, &how, &list));
    for (int i = 0; i <= HALVINGS && list.count > 0; ++i)
    {
        layout_job *job = NULL;

        OTX_TRY(lay_out_all(
            run, options, surface, &how, &list, COLLARS + i,
            i < HALVINGS ? STRETCH_MOST : (double)INFINITY, &job));
        OTX_TRY(keep_charts(run, job, &list, out));
        OTX_TRY(halve_folded(run, &how, job, &list));
    }
    claim(out, leaf->face_count);
    return OSDTEX_OK;
}

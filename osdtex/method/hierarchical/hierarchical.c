/* hierarchical.c -- the main loop [Soler02, sec. 2.2].
 *
 * One queue for all levels; patch/turn.c says what comes first. Flatness
 * depends on the surface alone, so clusters that are not flat are split before
 * anything is fitted, and all charts are made in parallel. */
#include "method/hierarchical/guides.h"
#include "method/hierarchical/settings.h"

#include "method/method.h"
#include "patch/first.h"
#include "patch/stitch.h"
#include "patch/turn.h"
#include "seam/unit.h"

/* Puts the children of a node that fitted nowhere into the queue. */
static otx_status
descend(otx_mosaic *m, otx_pqueue *queue, int32_t index)
{
    const int32_t first = m->forest.count;

    OTX_TRY(otx_forest_split(m, index));
    OTX_TRY(otx_forest_settle(m, first));
    otx_turn_push(m, queue, first, m->forest.count);
    return OSDTEX_OK;
}

static otx_status
fails_to_fit(otx_mosaic *m, int32_t index)
{
    const otx_cage *cage = m->job.surface->cage;
    const int32_t face =
        m->job.leaves.level->face_cage[m->forest.nodes[index].leaves[0]];

    return otx_fail(
        m->job.run, OSDTEX_ERROR_LIMIT, "map",
        (otx_where){
            cage->path, cage->face_line ? cage->face_line[face] : 0, face, -1},
        cage->scheme == OTX_SCHEME_NONE
            ? "face %d is larger than the exemplar, which does not tile; raise "
              "{scale}, or subdivide the mesh with {scheme} bilinear"
            : "a leaf of face %d is larger than the exemplar, which does not "
              "tile; raise {level} or {scale}",
        face);
}

/* Commits a wave in its order; what is not accepted is split. */
static otx_status
settle(otx_mosaic *m, otx_pqueue *queue, const otx_fit *fits, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
    {
        const int32_t index = fits[i].node;

        if (otx_fit_commit(m, &fits[i]))
            otx_turn_wake(m, queue, index);
        else if (!otx_forest_can_split(m, &m->forest.nodes[index]))
            return fails_to_fit(m, index);
        else
            OTX_TRY(descend(m, queue, index));
    }
    return OSDTEX_OK;
}

static otx_status
fit_all(otx_mosaic *m)
{
    otx_pqueue queue = otx_pqueue_make(m->job.run->scratch);
    const int32_t first = otx_first_node(m);
    otx_fit fits[OTX_TURN_NODES];
    int32_t count;

    if (first >= 0)
        otx_pqueue_push(&queue, -INFINITY, first);
    otx_turn_push(m, &queue, 0, m->forest.count);
    OTX_TRY(otx_turn_next(m, &queue, fits, &count));
    while (count > 0)
    {
        OTX_TRY(otx_fit_find(m, fits, count));
        OTX_TRY(settle(m, &queue, fits, count));
        /* The user's first patch was split: its part comes first. */
        if (first >= 0 && m->cover.patch_count == 0)
            otx_pqueue_push(&queue, -INFINITY, otx_first_node(m));
        OTX_TRY(otx_progress(
            m->job.run, "fit",
            fmin(1.0, m->cover.done_area / m->cover.total_area)));
        OTX_TRY(otx_turn_next(m, &queue, fits, &count));
    }
    return OSDTEX_OK;
}

/*   surface  the job's, or a copy of it with the sizes that are asked for
 *   guides   [exemplars]; without directions: not to be followed */
static otx_status
cover(
    const otx_job *job, const otx_surface *surface, const otx_guide *guides,
    const otx_patch_given *given, otx_mapping *out)
{
    const otx_map_request *request = job->request;
    otx_mosaic *m = OTX_ZNEW(job->run->arena, otx_mosaic, 1);

    OTX_TRY(otx_run_ok(job->run));
    m->job = (otx_mosaic_job){
        .run = job->run,
        .surface = surface,
        .exemplars = job->exemplars,
        .exemplar_count = job->exemplar_count,
        .demand = request->demand,
        .scale = request->scale,
        .texels = otx_unit_texels(job->exemplars, request->scale),
        .first =
            {request->first_face, request->first_position,
             request->first_angle},
        .given = given,
        .settings = *(const otx_hierarchical_settings *)job->settings,
        .figures = job->figures,
    };
    OTX_TRY(otx_mosaic_begin(m, guides));
    otx_figures_stage(job->figures, "flatten");
    OTX_TRY(otx_forest_settle(m, 0));
    otx_figures_stage(job->figures, "fit");
    OTX_TRY(fit_all(m));
    if (m->cover.patch_count > 0)
        m->tally.fit_error /= m->cover.patch_count;
    OTX_TRY(otx_stitch_run(m));
    return otx_mosaic_finish(m, out);
}

static otx_status
fill(const otx_job *job, const otx_patch_given *given, otx_mapping *out)
{
    return cover(job, job->surface, job->request->guide, given, out);
}

static otx_status
map(const otx_job *job, otx_mapping *out)
{
    otx_guide *guides = OTX_ZNEW(job->run->arena, otx_guide, OTX_EXEMPLARS_MAX);
    const otx_surface *surface;

    OTX_TRY(otx_run_ok(job->run));
    OTX_TRY(otx_guides_density(job, &surface));
    OTX_TRY(otx_guides_make(job, surface, guides));
    return cover(job, surface, guides, NULL, out);
}

/* Patches suit everything, and nothing best. */
static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    (void)job;
    *out = (otx_suitability){0.5, "patches suit any exemplar and surface"};
    return OSDTEX_OK;
}

static void
resolve(void *settings, const otx_exemplar *exemplar, const otx_cage *cage)
{
    otx_patch_resolve(settings, exemplar, cage);
}

const otx_method otx_method_hierarchical = {
    .name = "hierarchical",
    .summary = "Covers the surface with patches of the exemplar, coarse to "
               "fine, that continue one another.",
    .source = "Soler, Cani, Angelidis: Hierarchical Pattern Mapping, 2002",
    .options = otx_hierarchical_options,
    .option_count = OTX_HIERARCHICAL_OPTION_COUNT,
    .settings_bytes = sizeof(otx_patch_settings),
    .mixes = true,
    .begins = true,
    .resolve = resolve,
    .applicable = applicable,
    .map = map,
    .fill = fill,
};

/* mosaic.c -- how patches begin, and how they end. */
#include "patch/mosaic.h"

#include "patch/forest_check.h"
#include "patch/given_patches.h"
#include "patch/straighten.h"
#include "patch/unfold.h"

#include <assert.h>

/* All exemplars, the settings resolved for each. */
static void
list_supplies(otx_mosaic *m, const otx_guide *guides)
{
    for (int32_t k = 0; k < m->job.exemplar_count; ++k)
    {
        otx_supply *s = &m->supplies.items[k];

        s->exemplar = &m->job.exemplars[k];
        s->settings = m->job.settings;
        s->guide = guides && guides[k].directions ? &guides[k] : NULL;
        otx_patch_resolve(&s->settings, m->job.exemplars, m->job.surface->cage);
        if (k > 0)
            otx_patch_adapt(&s->settings, m->job.exemplars, s->exemplar);
        /* What goes on as it was would be what is not wanted. */
        if (m->job.given && m->job.given->avoid)
            s->settings.continuation = 0;
    }
    m->job.settings = m->supplies.items[0].settings;
}

static otx_status
make_forest(otx_mosaic *m)
{
    const otx_mosaic_job *job = &m->job;
    const otx_level *leaf = job->leaves.level;
    const int32_t threads = otx_pool_threads(job->run->pool);
    otx_forest *forest = &m->forest;

    forest->leaf_node = OTX_NEW(job->run->arena, int32_t, leaf->face_count);
    forest->patch_node = OTX_NEW(job->run->arena, int32_t, leaf->face_count);
    forest->spaces = OTX_NEW(job->run->arena, otx_chart_space, threads);
    OTX_TRY(otx_run_ok(job->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        forest->leaf_node[f] = forest->patch_node[f] = -1;
    for (int32_t t = 0; t < threads; ++t)
        OTX_TRY(otx_chart_space_create(
            job->run, job->run->arena, job->surface, &forest->spaces[t]));
    return otx_forest_defer(m) ? OSDTEX_OK : otx_fail_memory(job->run, "map");
}

otx_status
otx_mosaic_begin(otx_mosaic *m, const otx_guide *guides)
{
    otx_mosaic_job *job = &m->job;

    list_supplies(m, guides);
    OTX_TRY(otx_dual_build(
        job->run, job->surface, job->surface->level_count - 1, &job->leaves));
    OTX_TRY(otx_cover_create(job, &m->cover));
    if (job->given)
        otx_given_take(job, &m->cover);
    OTX_TRY(make_forest(m));
    OTX_TRY(otx_supply_prepare(m));
    OTX_TRY(otx_spares_create(m));
    OTX_TRY(otx_forest_start(m));
    assert(!otx_forest_check(m));
    return OSDTEX_OK;
}

/* Patches by level of the hierarchy of clusters. */
static void
report_levels(const otx_mosaic *m)
{
    const otx_cluster_tree *tree = &m->forest.tree;
    otx_figures *f = m->job.figures;

    otx_figures_count(f, "clusters.face_level", "", tree->face_level);
    otx_figures_count(f, "clusters.subdivision_level", "", tree->base);
    for (int32_t l = 0; l < otx_cluster_tree_levels(tree); ++l)
        otx_figures_item(
            f, "patches_by_level", "patches", otx_forest_patches(m, l));
}

static void
report(const otx_mosaic *m)
{
    const otx_patch_tally *t = &m->tally;
    otx_figures *f = m->job.figures;

    report_levels(m);
    otx_figures_count(f, "fits", "searches", t->fits);
    otx_figures_count(f, "splits", "clusters", t->splits);
    otx_figures_real(f, "threshold", "random pairs", m->job.settings.tau);
    otx_figures_real(f, "fit_error_mean", "random pairs", t->fit_error);
    otx_figures_real(f, "cut_before", "seam energy", t->cut_before);
    otx_figures_real(f, "cut_after", "seam energy", t->cut_after);
    otx_figures_real(f, "relax_before", "seam energy", t->relax_before);
    otx_figures_real(f, "relax_after", "seam energy", t->relax_after);
}

static otx_status
keep_guide(const otx_mosaic *m, otx_mapping *out)
{
    otx_guide *guide;

    if (!m->supplies.items[0].guide)
        return OSDTEX_OK;
    guide = OTX_NEW(m->job.run->arena, otx_guide, 1);
    OTX_TRY(otx_run_ok(m->job.run));
    *guide = *m->supplies.items[0].guide;
    out->guide = guide;
    return OSDTEX_OK;
}

otx_status
otx_mosaic_finish(otx_mosaic *m, otx_mapping *out)
{
    OTX_TRY(otx_straighten(&m->job, &m->cover));
    otx_unfold(&m->job, &m->cover);
    OTX_TRY(otx_cover_write(&m->job, &m->cover, out));
    OTX_TRY(keep_guide(m, out));
    report(m);
    return OSDTEX_OK;
}

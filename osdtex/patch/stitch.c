/* stitch.c -- what each patch can show, and where it is cut and bent.
 *
 * Every patch offers its whole chart, collar included; the cut chooses, and
 * the relaxation closes what is left. */
#include "patch/stitch.h"
#include "patch/forest_check.h"
#include "patch/given_patches.h"

#include "analysis/outline.h"
#include "relax/elastic.h"

#include <assert.h>
#include <stdlib.h>

typedef struct slot
{
    int32_t face;  /* leaf */
    int32_t index; /* in the chart */
    float cost;
} slot;

static int
compare_slots(const void *a, const void *b)
{
    const int32_t x = ((const slot *)a)->face, y = ((const slot *)b)->face;

    return (x > y) - (x < y);
}

typedef struct offering
{
    const otx_mosaic *m;
    otx_offer *offers; /* [patch_count] */
} offering;

/* The offer of one patch that was fitted, in its chart's arena. */
static otx_status
make_offer(void *context, int64_t index, otx_worker *worker)
{
    const offering *o = context;
    const otx_mosaic *m = o->m;
    const int64_t patch =
        index + (m->job.given ? m->job.given->patch_count : 0);
    const otx_node *node = &m->forest.nodes[m->forest.patch_node[patch]];
    const otx_chart *chart = &node->chart;
    slot *slots = OTX_NEW(worker->scratch, slot, chart->face_count);
    int32_t *faces = OTX_NEW(node->arena, int32_t, chart->face_count);
    int32_t *first = OTX_NEW(node->arena, int32_t, chart->face_count + 1);
    float *cost = OTX_NEW(node->arena, float, chart->face_count);
    otx_vec2 *uvs =
        OTX_NEW(node->arena, otx_vec2, chart->first[chart->face_count]);
    int32_t count = 0, n = 0;

    if (!slots || !faces || !first || !cost || !uvs)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < chart->face_count; ++i)
    {
        const float c = otx_spare_cost(m, node, i);

        if (c >= 0.0f)
            slots[count++] = (slot){chart->faces[i], i, c};
    }
    qsort(slots, (size_t)count, sizeof *slots, compare_slots);
    for (int32_t k = 0; k < count; ++k)
    {
        const int32_t i = slots[k].index;

        faces[k] = slots[k].face;
        cost[k] = slots[k].cost;
        first[k] = n;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            uvs[n++] = otx_spare_place(m, node, chart->flat[chart->corners[c]]);
    }
    first[count] = n;
    o->offers[patch] =
        (otx_offer){count, faces, uvs, first, cost, node->supply};
    return OSDTEX_OK;
}

/* The offer of every patch that is no given one; of these, what they have. */
static otx_status
make_offers(offering *o)
{
    const otx_mosaic *m = o->m;
    const int32_t given = m->job.given ? m->job.given->patch_count : 0;

    o->offers = OTX_NEW(m->job.run->arena, otx_offer, m->cover.patch_count);
    OTX_TRY(otx_run_ok(m->job.run));
    OTX_TRY(otx_loop_result(
        m->job.run, "cut",
        otx_pool_for(
            m->job.run->pool, m->cover.patch_count - given, make_offer, o)));
    if (given > 0)
        OTX_TRY(otx_given_offers(m, o->offers));
    return OSDTEX_OK;
}

/* Corner UVs of the faces that each patch has now. */
static void
take_offers(
    const otx_mosaic_job *job, const otx_offer *offers, otx_cover *cover)
{
    for (int32_t p = 0; p < cover->patch_count; ++p)
        for (int32_t k = 0; k < offers[p].face_count; ++k)
        {
            const int32_t face = offers[p].faces[k];
            const int32_t corner = job->leaves.level->face_first[face];

            if (cover->face_patch[face] != p)
                continue;
            for (int32_t c = offers[p].first[k]; c < offers[p].first[k + 1];
                 ++c)
                cover->uvs[corner + c - offers[p].first[k]] = offers[p].uvs[c];
        }
}

/* Where the pictures of several exemplars can be cut; NULL of one. */
static otx_status
find_outlines(const otx_mosaic *m, const otx_image **out)
{
    otx_image *outlines;

    *out = NULL;
    if (!m->job.demand)
        return OSDTEX_OK;
    outlines = OTX_NEW(m->job.run->scratch, otx_image, m->job.exemplar_count);
    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t k = 0; k < m->job.exemplar_count; ++k)
        OTX_TRY(
            otx_outline_find(m->job.run, &m->job.exemplars[k], &outlines[k]));
    *out = outlines;
    return OSDTEX_OK;
}

static otx_status
cut_offers(otx_mosaic *m, const otx_offer *offers, otx_cut_stats *stats)
{
    const otx_arena_mark mark = otx_arena_here(m->job.run->scratch);
    otx_cut_options options = otx_cut_options_default();

    options.texels_per_unit = m->job.texels;
    options.sweeps = m->job.settings.sweeps;
    OTX_TRY(find_outlines(m, &options.outlines));
    OTX_TRY(otx_cut_run(
        m->job.run, m->job.surface, m->job.exemplars, offers,
        m->cover.patch_count, &options, m->cover.face_patch, stats));
    otx_arena_release(m->job.run->scratch, mark);
    take_offers(&m->job, offers, &m->cover);
    return OSDTEX_OK;
}

static otx_status
cut(otx_mosaic *m)
{
    offering o = {.m = m};
    otx_cut_stats stats;

    OTX_TRY(make_offers(&o));
    OTX_TRY(cut_offers(m, o.offers, &stats));
    m->tally.cut_before = stats.energy_before;
    m->tally.cut_after = stats.energy_after;
    return OSDTEX_OK;
}

/* What an edit may move, and what is around it, which is held.
 *
 *   inside, still  [leaf face_count] in run->scratch; NULL where there is no
 *                  edit */
static otx_status
bound(const otx_mosaic *m, uint8_t **inside, uint8_t **still)
{
    const otx_level *leaf = m->job.leaves.level;
    otx_arena *arena = m->job.run->scratch;
    uint8_t *verts;

    *inside = *still = NULL;
    if (!m->job.given || !m->job.given->state)
        return OSDTEX_OK;
    verts = OTX_ZNEW(arena, uint8_t, leaf->vert_count);
    *inside = OTX_ZNEW(arena, uint8_t, leaf->face_count);
    *still = OTX_ZNEW(arena, uint8_t, leaf->face_count);
    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        (*still)[f] = otx_given_holds(&m->job, f);
        for (int32_t c = leaf->face_first[f];
             !(*still)[f] && c < leaf->face_first[f + 1]; ++c)
            verts[leaf->face_verts[c]] = 1;
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
            (*inside)[f] |= verts[leaf->face_verts[c]];
    return OSDTEX_OK;
}

static otx_status
relax(otx_mosaic *m)
{
    const otx_arena_mark mark = otx_arena_here(m->job.run->scratch);
    otx_elastic_options options = {
        .texels = m->job.texels,
        .rounds = m->job.settings.relax_rounds,
        .levels = 3,
        .stiffness = m->job.settings.stiffness,
        .stretch = 1.6,
        .reach = m->job.given ? m->job.given->reach : 0.0,
        .patch_exemplar = m->cover.patch_exemplar,
        .exemplar_count = m->job.exemplar_count,
        .keep_shape = m->job.given && !m->job.given->state,
    };
    otx_elastic_stats stats;
    uint8_t *inside, *still;

    OTX_TRY(bound(m, &inside, &still));
    options.inside = inside;
    options.still = still;
    OTX_TRY(otx_elastic_run(
        m->job.run, m->job.surface, m->job.exemplars, &options,
        m->cover.face_patch, m->cover.uvs, &stats));
    m->tally.relax_before = stats.seam_before;
    m->tally.relax_after = stats.seam_after;
    otx_arena_release(m->job.run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_stitch_run(otx_mosaic *m)
{
    const otx_patch_settings *s = &m->job.settings;

    assert(!otx_forest_check(m));
    /* Nothing was covered: there is nothing to join to what is given. */
    if (m->job.given && !m->job.given->state && m->forest.count == 0)
        return OSDTEX_OK;
    if (s->cut == OTX_PATCH_ON && m->cover.patch_count > 1 &&
        m->forest.count > 0)
    {
        otx_figures_stage(m->job.figures, "cut");
        OTX_TRY(cut(m));
    }
    otx_forest_free(m);
    if (s->relax == OTX_PATCH_RELAX_GLOBAL)
    {
        otx_figures_stage(m->job.figures, "relax");
        OTX_TRY(relax(m));
    }
    return OSDTEX_OK;
}

/* assemble.c -- from fitted patches to a mapping.
 *
 * Every patch offers its whole chart, collar included; the cut chooses, the
 * relaxation closes what is left, and UVs go out in units of the picture. */
#include "method/hierarchical/hierarchical.h"

#include "relax/cut.h"
#include "relax/elastic.h"

#include <stdlib.h>

/* Collar faces that are squeezed or stretched more than this are not offered:
 * they would show. */
static const double OFFER_STRETCH = 1.5;

static otx_vec2
place(const otx_node *node, otx_vec2 flat)
{
    return otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(node->placed.angle), flat),
        node->placed.shift);
}

static bool
lands_inside(const otx_mapper *m, otx_vec2 p)
{
    const otx_exemplar *e = m->exemplar;
    const double w = e->match.width - 0.5, h = e->match.height - 0.5;

    return (e->wrap_x || (p.x >= 0.5 && p.x <= w)) &&
           (e->wrap_y || (p.y >= 0.5 && p.y <= h));
}

/* What a face of the chart costs in the cut: its squared strain; negative when
 * it is not to be offered. */
static float
offer_cost(const otx_mapper *m, const otx_node *node, int32_t i)
{
    const otx_chart *chart = &node->chart;
    double s[2];

    otx_chart_face_stretch(chart, m->surface, m->texels, i, s);
    if (i >= chart->core_count)
    {
        if (!(s[1] > 1.0 / OFFER_STRETCH) || s[0] > OFFER_STRETCH)
            return -1.0f;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            if (!lands_inside(m, place(node, chart->flat[chart->corners[c]])))
                return -1.0f;
    }
    s[0] = fmax(s[0], 0.1);
    s[1] = fmax(s[1], 0.1);
    return (float)(log(s[0]) * log(s[0]) + log(s[1]) * log(s[1]));
}

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

typedef struct offer_job
{
    otx_mapper *mapper;
    otx_offer *offers;
} offer_job;

/* The offer of one patch, in its chart's arena. */
static otx_status
make_offer(void *context, int64_t patch, otx_worker *worker)
{
    const offer_job *job = context;
    otx_mapper *m = job->mapper;
    const otx_node *node = &m->nodes[m->patch_node[patch]];
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
        const float c = offer_cost(m, node, i);

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
            uvs[n++] = place(node, chart->flat[chart->corners[c]]);
    }
    first[count] = n;
    job->offers[patch] = (otx_offer){count, faces, uvs, first, cost};
    return OSDTEX_OK;
}

/* Corner UVs of the faces that each patch has now. */
static void
take_offers(otx_mapper *m, const otx_offer *offers)
{
    for (int32_t p = 0; p < m->patch_count; ++p)
        for (int32_t k = 0; k < offers[p].face_count; ++k)
        {
            const int32_t face = offers[p].faces[k];
            const int32_t corner = m->leaves.level->face_first[face];

            if (m->face_patch[face] != p)
                continue;
            for (int32_t c = offers[p].first[k]; c < offers[p].first[k + 1];
                 ++c)
                m->uvs[corner + c - offers[p].first[k]] = offers[p].uvs[c];
        }
}

static otx_status
cut(otx_mapper *m)
{
    offer_job job = {m, OTX_NEW(m->run->arena, otx_offer, m->patch_count)};
    otx_cut_options options = otx_cut_options_default();
    otx_cut_stats stats;

    if (!job.offers ||
        otx_pool_for(m->run->pool, m->patch_count, make_offer, &job) !=
            OSDTEX_OK)
        return otx_fail_memory(m->run, "cut");
    options.density = m->texels;
    options.sweeps = m->settings.sweeps;
    OTX_TRY(otx_cut_run(
        m->run, m->surface, m->exemplar, job.offers, m->patch_count, &options,
        m->face_patch, &stats));
    m->stats->cut_before = stats.energy_before;
    m->stats->cut_after = stats.energy_after;
    take_offers(m, job.offers);
    return OSDTEX_OK;
}

static otx_status
relax(otx_mapper *m)
{
    const otx_elastic_options options = {
        .texels = m->texels,
        .rounds = m->settings.relax_rounds,
        .levels = 3,
        .stiffness = m->settings.stiffness,
        .stretch = 1.6,
    };
    otx_elastic_stats stats;

    OTX_TRY(otx_elastic_run(
        m->run, m->surface, m->exemplar, &options, m->face_patch, m->uvs,
        &stats));
    m->stats->relax_before = stats.seam_before;
    m->stats->relax_after = stats.seam_after;
    return OSDTEX_OK;
}

/* Whole pictures by which each patch is moved so that its first corner lies in
 * [0, 1): floats are finest there. */
static otx_status
write_uvs(const otx_mapper *m, otx_mapping *out)
{
    const otx_level *leaf = m->leaves.level;
    const otx_exemplar *e = m->exemplar;
    otx_vec2 *shift = OTX_NEW(m->run->scratch, otx_vec2, m->patch_count + 1);
    uint8_t *known = OTX_ZNEW(m->run->scratch, uint8_t, m->patch_count + 1);

    if (!shift || !known)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t p = m->face_patch[f];

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            otx_vec2 uv = {
                m->uvs[c].x / e->match.width, m->uvs[c].y / e->match.height};

            if (p < 0)
                uv = (otx_vec2){0, 0};
            else if (!known[p])
            {
                shift[p].x = e->wrap_x ? floor(uv.x) : 0.0;
                shift[p].y = e->wrap_y ? floor(uv.y) : 0.0;
                known[p] = 1;
            }
            if (p >= 0)
                uv = otx_vec2_sub(uv, shift[p]);
            out->uvs[2 * (size_t)c] = (float)uv.x;
            out->uvs[2 * (size_t)c + 1] = (float)uv.y;
        }
    }
    return OSDTEX_OK;
}

/* Patches keep their order; those that the cut emptied lose their number. */
static otx_status
number_patches(const otx_mapper *m, otx_mapping *out)
{
    const int32_t faces = m->leaves.level->face_count;
    int32_t *number = OTX_ZNEW(m->run->scratch, int32_t, m->patch_count + 1);

    if (!number)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < faces; ++f)
        if (m->face_patch[f] >= 0)
            number[m->face_patch[f]] = 1;
    for (int32_t p = 0; p < m->patch_count; ++p)
        number[p] = number[p] ? out->patch_count++ : -1;
    for (int32_t f = 0; f < faces; ++f)
        out->face_patch[f] =
            m->face_patch[f] < 0 ? -1 : number[m->face_patch[f]];
    return OSDTEX_OK;
}

otx_status
otx_assemble(otx_mapper *m, otx_mapping *out)
{
    const otx_level *leaf = m->leaves.level;

    *out = (otx_mapping){.surface = m->surface, .scale = m->request->scale};
    if (m->settings.cut == OTX_HIERARCHICAL_ON && m->patch_count > 1)
    {
        otx_map_stats_stage(m->stats, "cut");
        OTX_TRY(cut(m));
    }
    otx_nodes_free(m);
    if (m->settings.relax == OTX_HIERARCHICAL_RELAX_GLOBAL)
    {
        otx_map_stats_stage(m->stats, "relax");
        OTX_TRY(relax(m));
    }
    out->uvs = OTX_NEW(m->run->arena, float, 2 * (int64_t)leaf->corner_count);
    out->face_patch = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    if (!out->uvs || !out->face_patch)
        return otx_fail_memory(m->run, "map");
    OTX_TRY(write_uvs(m, out));
    return number_patches(m, out);
}

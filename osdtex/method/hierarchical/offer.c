/* offer.c -- what each patch can show: its whole chart, collar included. */
#include "method/hierarchical/hierarchical.h"

#include "analysis/outline.h"

#include <stdlib.h>

/* Collar faces that are squeezed or stretched more than this are not offered:
 * they would show. */
static const double OFFER_STRETCH = 1.5;

/* Weight of a squared turn against the guide, of a squared strain 1. */
static const double TURN_COST = 0.4;

static otx_vec2
place(const otx_node *node, otx_vec2 flat)
{
    return otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(node->placed.angle), flat),
        node->placed.shift);
}

static bool
lands_inside(const otx_exemplar *e, otx_vec2 p)
{
    const double w = e->match.width - 0.5, h = e->match.height - 0.5;

    return (e->wrap_x || (p.x >= 0.5 && p.x <= w)) &&
           (e->wrap_y || (p.y >= 0.5 && p.y <= h));
}

/* What a face of the chart costs in the cut: its squared strain and turn;
 * negative when it is not to be offered. */
static float
offer_cost(const otx_mapper *m, const otx_node *node, int32_t i)
{
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_chart *chart = &node->chart;
    const float foreign = otx_supply_cost(m, node, chart->faces[i]);
    double s[2], turn = 0.0;

    if (foreign < 0.0f ||
        (node->patch != 0 && otx_first_holds(m, chart->faces[i])))
        return -1.0f;
    otx_chart_face_stretch(chart, m->surface, m->texels, i, s);
    if (i >= chart->core_count)
    {
        if (!(s[1] > 1.0 / OFFER_STRETCH) || s[0] > OFFER_STRETCH)
            return -1.0f;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            if (!lands_inside(
                    supply->exemplar,
                    place(node, chart->flat[chart->corners[c]])))
                return -1.0f;
    }
    if (supply->guide)
        turn = otx_follow_deviation(m, node, i);
    s[0] = fmax(s[0], 0.1);
    s[1] = fmax(s[1], 0.1);
    return foreign +
           (float)(log(s[0]) * log(s[0]) + log(s[1]) * log(s[1]) + TURN_COST * turn * turn);
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

/* The offer of one patch that was fitted, in its chart's arena. */
static otx_status
make_offer(void *context, int64_t index, otx_worker *worker)
{
    otx_mapper *m = context;
    const int64_t patch = index + (m->given ? m->given->patch_count : 0);
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
    m->offers[patch] =
        (otx_offer){count, faces, uvs, first, cost, node->supply};
    return OSDTEX_OK;
}

otx_status
otx_offers_make(otx_mapper *m)
{
    const int32_t given = m->given ? m->given->patch_count : 0;

    m->offers = OTX_NEW(m->run->arena, otx_offer, m->patch_count);
    if (!m->offers)
        return otx_fail_memory(m->run, "cut");
    OTX_TRY(otx_loop_result(
        m->run, "cut",
        otx_pool_for(m->run->pool, m->patch_count - given, make_offer, m)));
    if (given > 0)
        OTX_TRY(otx_given_offers(m));
    return OSDTEX_OK;
}

/* Corner UVs of the faces that each patch has now. */
static void
take_offers(otx_mapper *m)
{
    for (int32_t p = 0; p < m->patch_count; ++p)
        for (int32_t k = 0; k < m->offers[p].face_count; ++k)
        {
            const int32_t face = m->offers[p].faces[k];
            const int32_t corner = m->leaves.level->face_first[face];

            if (m->face_patch[face] != p)
                continue;
            for (int32_t c = m->offers[p].first[k];
                 c < m->offers[p].first[k + 1]; ++c)
                m->uvs[corner + c - m->offers[p].first[k]] =
                    m->offers[p].uvs[c];
        }
}

/* Where the pictures of several exemplars can be cut; NULL of one. */
static otx_status
find_outlines(const otx_mapper *m, const otx_image **out)
{
    otx_image *outlines;

    *out = NULL;
    if (!m->request->demand)
        return OSDTEX_OK;
    outlines = OTX_NEW(m->run->scratch, otx_image, m->supply_count);
    if (!outlines)
        return otx_fail_memory(m->run, "cut");
    for (int32_t k = 0; k < m->supply_count; ++k)
        OTX_TRY(otx_outline_find(m->run, &m->exemplars[k], &outlines[k]));
    *out = outlines;
    return OSDTEX_OK;
}

otx_status
otx_offers_cut(otx_mapper *m, otx_cut_stats *stats)
{
    const otx_arena_mark mark = otx_arena_here(m->run->scratch);
    otx_cut_options options = otx_cut_options_default();

    options.texels_per_unit = m->texels;
    options.sweeps = m->settings.sweeps;
    OTX_TRY(find_outlines(m, &options.outlines));
    OTX_TRY(otx_cut_run(
        m->run, m->surface, m->exemplars, m->offers, m->patch_count, &options,
        m->face_patch, stats));
    otx_arena_release(m->run->scratch, mark);
    take_offers(m);
    return OSDTEX_OK;
}

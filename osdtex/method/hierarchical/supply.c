/* supply.c -- what is made for each of the exemplars of a run.
 *
 * A patch comes from one exemplar, the one that all of its leaves are asked
 * for, and is fitted to what its neighbours show of theirs. */
#include "method/hierarchical/hierarchical.h"

#include "analysis/edges.h"
#include "surface/distance.h"

/* The area that asks for each, of the leaves that are no holes. */
static void
sum_areas(otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f])
            m->supplies[otx_supply_wanted(m, f)].area += m->leaves.areas[f];
}

/* The picture that matches are looked up in: colours, and edges, if they are
 * to count. Of several exemplars they are measured by those of the first.
 * In run->scratch.
 *
 *   sigma  out: RMS distance of two random texels */
static otx_status
match_picture(otx_mapper *m, int32_t k, otx_image *out, double *sigma)
{
    const otx_exemplar *e = m->supplies[k].exemplar;
    const double weight = m->settings.edges;
    otx_edges edges;

    *out = e->match;
    *sigma = e->match_sigma;
    if (weight <= 0.0)
        return OSDTEX_OK;
    OTX_TRY(otx_edges_find(
        m->run, m->run->scratch, &e->match, e->wrap_x, e->wrap_y, &edges));
    if (k == 0)
        m->edge_unit =
            edges.sigma > 0.0 ? weight * e->match_sigma / edges.sigma : 0.0;
    *sigma = hypot(e->match_sigma, m->edge_unit * edges.sigma);
    return otx_edges_append(
        m->run, m->run->scratch, &e->match, &edges, m->edge_unit, out);
}

static otx_status
prepare(otx_mapper *m, int32_t k)
{
    otx_supply *s = &m->supplies[k];
    const otx_exemplar *e = s->exemplar;
    const otx_arena_mark mark = otx_arena_here(m->run->scratch);
    otx_image match;
    double sigma;

    s->usage = OTX_ZNEW(m->run->arena, float, OTX_USAGE_CELLS *OTX_USAGE_CELLS);
    if (!s->usage)
        return otx_fail_memory(m->run, "map");
    OTX_TRY(match_picture(m, k, &match, &sigma));
    OTX_TRY(otx_matcher_create_like(
        m->run, &match, e->wrap_x, e->wrap_y, sigma, s->settings.coarse,
        k > 0 ? m->supplies[0].matcher : NULL, &s->matcher));
    otx_arena_release(m->run->scratch, mark);
    return OSDTEX_OK;
}

/* Half the width of the band in which seams between exemplars run. */
static double
transition(const otx_mapper *m)
{
    const otx_image *image = &m->exemplars[0].match;

    return m->settings.transition >= 0.0
               ? m->settings.transition
               : 0.125 * fmin(image->width, image->height);
}

otx_status
otx_supply_prepare(otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;

    sum_areas(m);
    for (int32_t k = 0; k < m->supply_count; ++k)
        OTX_TRY(prepare(m, k));
    if (!m->request->demand)
        return OSDTEX_OK;
    m->transition = transition(m);
    m->patch_exemplar =
        OTX_ZNEW(m->run->arena, uint8_t, 2 * (int64_t)leaf->face_count);
    m->away = OTX_NEW(m->run->arena, double, leaf->face_count);
    if (!m->patch_exemplar || !m->away)
        return otx_fail_memory(m->run, "map");
    return otx_distance_measure(
        m->run, m->surface, m->request->demand, m->texels, m->transition,
        m->away);
}

int32_t
otx_supply_wanted(const otx_mapper *m, int32_t face)
{
    return m->request->demand ? m->request->demand[face] : 0;
}

const otx_supply *
otx_supply_of(const otx_mapper *m, const otx_node *node)
{
    return &m->supplies[node->supply];
}

int32_t
otx_supply_of_patch(const otx_mapper *m, int32_t patch)
{
    return m->patch_exemplar ? m->patch_exemplar[patch] : 0;
}

bool
otx_supply_is_pure(const otx_mapper *m, const otx_node *node)
{
    for (int32_t i = 0; m->request->demand && i < node->leaf_count; ++i)
        if (otx_supply_wanted(m, node->leaves[i]) != node->supply)
            return false;
    return true;
}

bool
otx_supply_meets(const otx_mapper *m, const otx_node *node)
{
    for (int32_t i = 0; m->away && i < node->leaf_count; ++i)
        if (isfinite(m->away[node->leaves[i]]))
            return true;
    return false;
}

/* Relative to the squared strain that an offer costs elsewhere: over the whole
 * band it comes to a third of sigma per texel of the border, which is about
 * what a good seam saves. */
float
otx_supply_cost(const otx_mapper *m, const otx_node *node, int32_t face)
{
    const double weight = otx_cut_options_default().distortion;
    double share;

    if (otx_supply_wanted(m, face) == node->supply)
        return 0.0f;
    if (!(m->away[face] < m->transition))
        return -1.0f;
    share = m->away[face] / m->transition;
    return (
        float)(m->exemplars[0].match_sigma / m->transition * share * share / weight);
}

/* What the faces of a level are asked for: that of their leaves, MIXED where
 * these differ. In run->scratch. */
static int32_t *
level_demand(const otx_mapper *m, int32_t level, bool *mixed)
{
    const otx_surface *surface = m->surface;
    const int32_t count = surface->levels[level].face_count;
    int32_t *demand = OTX_NEW(m->run->scratch, int32_t, count);

    *mixed = false;
    for (int32_t f = 0; demand && f < count; ++f)
        demand[f] = -1;
    for (int32_t f = 0; demand && f < m->leaves.level->face_count; ++f)
    {
        const int32_t wanted = otx_supply_wanted(m, f);
        int32_t face = f;

        for (int32_t l = surface->level_count - 1; l > level; --l)
            face = surface->levels[l].face_parent[face];
        *mixed |= demand[face] >= 0 && demand[face] != wanted;
        demand[face] = wanted;
    }
    return demand;
}

/* The faces that are asked for `k`. */
static otx_status
take_region(
    const otx_mapper *m, const otx_level *level, int32_t level_index,
    const int32_t *demand, int32_t k, otx_cluster *out)
{
    int32_t *faces = OTX_NEW(m->run->arena, int32_t, level->face_count);

    if (!faces)
        return otx_fail_memory(m->run, "map");
    *out = (otx_cluster){
        level_index, 0, faces,
        m->request->demand ? m->supplies[k].area : m->surface->area};
    for (int32_t f = 0; f < level->face_count; ++f)
        if (demand[f] == k)
            faces[out->face_count++] = f;
    return OSDTEX_OK;
}

otx_status
otx_supply_regions(otx_mapper *m, int32_t level, otx_cluster *out)
{
    const int32_t last = m->surface->level_count - 1;
    bool mixed;
    int32_t *demand = level_demand(m, level, &mixed);

    if (demand && mixed)
    {
        level = last;
        demand = level_demand(m, level, &mixed);
    }
    if (!demand)
        return otx_fail_memory(m->run, "map");
    for (int32_t k = 0; k < m->supply_count; ++k)
        OTX_TRY(take_region(
            m, &m->surface->levels[level], level, demand, k, &out[k]));
    return OSDTEX_OK;
}

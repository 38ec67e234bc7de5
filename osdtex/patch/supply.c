/* supply.c -- what is made for each of the exemplars of a run.
 *
 * A patch comes from one exemplar, the one that all of its leaves are asked
 * for, and is fitted to what its neighbours show of theirs. */
#include "patch/mosaic.h"

#include "analysis/edges.h"
#include "base/random.h"
#include "relax/cut.h"
#include "surface/distance.h"

enum
{
    STAGE_AVOID = 0x41564F49, /* of random numbers */
    AVOID_BLOCK = 4 /* cells a side that one is drawn for: patches see the
                     * mean of many cells */
};

/* Usage of what faces showed that are to show something else, and the largest
 * of all the rest: 1 is an even share of the surface. */
static const double USED_BEFORE = 16.0;
static const double USED_AT_RANDOM = 16.0;

/* The area that asks for each, of the leaves that are no holes. */
static void
sum_areas(otx_mosaic *m)
{
    const otx_level *leaf = m->job.leaves.level;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f])
            m->supplies.items[otx_supply_wanted(&m->job, f)].area +=
                m->job.leaves.areas[f];
}

/* The picture that matches are looked up in: colours, and edges, if they are
 * to count. Of several exemplars they are measured by those of the first.
 * In run->scratch.
 *
 *   sigma  out: RMS distance of two random texels */
static otx_status
match_picture(otx_mosaic *m, int32_t k, otx_image *out, double *sigma)
{
    const otx_exemplar *e = m->supplies.items[k].exemplar;
    const double weight = m->job.settings.edges;
    otx_edges edges;

    *out = e->match;
    *sigma = e->match_sigma;
    if (weight <= 0.0)
        return OSDTEX_OK;
    OTX_TRY(otx_edges_find(
        m->job.run, m->job.run->scratch, &e->match, e->wrap_x, e->wrap_y,
        &edges));
    if (k == 0)
        m->supplies.edge_unit =
            edges.sigma > 0.0 ? weight * e->match_sigma / edges.sigma : 0.0;
    *sigma = hypot(e->match_sigma, m->supplies.edge_unit * edges.sigma);
    return otx_edges_append(
        m->job.run, m->job.run->scratch, &e->match, &edges,
        m->supplies.edge_unit, out);
}

static int32_t
cell_of(double x, int32_t size)
{
    const double share = x / size;
    const int32_t cell = (int32_t)((share - floor(share)) * OTX_USAGE_CELLS);

    return cell < OTX_USAGE_CELLS ? cell : OTX_USAGE_CELLS - 1;
}

int32_t
otx_supply_cell(const otx_supply *supply, otx_vec2 at)
{
    const otx_image *match = &supply->exemplar->match;

    return cell_of(at.y, match->height) * OTX_USAGE_CELLS +
           cell_of(at.x, match->width);
}

/* As if what is not to be shown again had been used a lot, and where others are
 * to be tried all else here and there. */
static void
use_up(const otx_mosaic *m, int32_t k, float *usage)
{
    const otx_patch_given *given = m->job.given;
    const otx_level *leaf = m->job.leaves.level;

    for (int32_t i = 0;
         given->avoid > 1 && i < OTX_USAGE_CELLS * OTX_USAGE_CELLS; ++i)
    {
        const int32_t block =
            i / OTX_USAGE_CELLS / AVOID_BLOCK * OTX_USAGE_CELLS +
            i % OTX_USAGE_CELLS / AVOID_BLOCK;
        const double chance =
            otx_random_unit(m->job.run->seed, STAGE_AVOID, (uint64_t)block);

        usage[i] = (float)(USED_AT_RANDOM * chance * chance);
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (given->face_patch[f] < 0)
            usage[otx_supply_cell(
                &m->supplies.items[k], given->uvs[leaf->face_first[f]])] =
                (float)USED_BEFORE;
}

static otx_status
prepare(otx_mosaic *m, int32_t k)
{
    otx_supply *s = &m->supplies.items[k];
    const otx_exemplar *e = s->exemplar;
    const otx_arena_mark mark = otx_arena_here(m->job.run->scratch);
    otx_image match;
    double sigma;

    s->usage =
        OTX_ZNEW(m->job.run->arena, float, OTX_USAGE_CELLS *OTX_USAGE_CELLS);
    OTX_TRY(otx_run_ok(m->job.run));
    if (m->job.given && m->job.given->avoid)
        use_up(m, k, s->usage);
    OTX_TRY(match_picture(m, k, &match, &sigma));
    OTX_TRY(otx_matcher_create_like(
        m->job.run, &match, e->wrap_x, e->wrap_y, sigma, s->settings.coarse,
        k > 0 ? m->supplies.items[0].matcher : NULL, &s->matcher));
    otx_arena_release(m->job.run->scratch, mark);
    return OSDTEX_OK;
}

/* Half the width of the band in which seams between exemplars run. */
static double
transition(const otx_mosaic *m)
{
    const otx_image *image = &m->job.exemplars[0].match;

    return m->job.settings.transition >= 0.0
               ? m->job.settings.transition
               : 0.125 * fmin(image->width, image->height);
}

otx_status
otx_supply_prepare(otx_mosaic *m)
{
    const otx_level *leaf = m->job.leaves.level;

    sum_areas(m);
    for (int32_t k = 0; k < m->job.exemplar_count; ++k)
        OTX_TRY(prepare(m, k));
    if (!m->job.demand)
        return OSDTEX_OK;
    m->supplies.transition = transition(m);
    m->supplies.away = OTX_NEW(m->job.run->arena, double, leaf->face_count);
    OTX_TRY(otx_run_ok(m->job.run));
    return otx_distance_measure(
        m->job.run, m->job.surface, m->job.demand, m->job.texels,
        m->supplies.transition, m->supplies.away);
}

int32_t
otx_supply_wanted(const otx_mosaic_job *job, int32_t face)
{
    return job->demand ? job->demand[face] : 0;
}

const otx_supply *
otx_supply_of(const otx_mosaic *m, const otx_node *node)
{
    return &m->supplies.items[node->supply];
}

bool
otx_supply_is_pure(const otx_mosaic *m, const otx_node *node)
{
    for (int32_t i = 0; m->job.demand && i < node->leaf_count; ++i)
        if (otx_supply_wanted(&m->job, node->leaves[i]) != node->supply)
            return false;
    return true;
}

bool
otx_supply_meets(const otx_mosaic *m, const otx_node *node)
{
    for (int32_t i = 0; m->supplies.away && i < node->leaf_count; ++i)
        if (isfinite(m->supplies.away[node->leaves[i]]))
            return true;
    return false;
}

/* Relative to the squared strain that an offer costs elsewhere: over the whole
 * band it comes to a third of sigma per texel of the border, which is about
 * what a good seam saves. */
float
otx_supply_cost(const otx_mosaic *m, const otx_node *node, int32_t face)
{
    const double weight = otx_cut_options_default().distortion;
    double share;

    if (otx_supply_wanted(&m->job, face) == node->supply)
        return 0.0f;
    if (!(m->supplies.away[face] < m->supplies.transition))
        return -1.0f;
    share = m->supplies.away[face] / m->supplies.transition;
    return (
        float)(m->job.exemplars[0].match_sigma / m->supplies.transition * share * share / weight);
}

/* What the faces of a level are asked for: that of their leaves, MIXED where
 * these differ. In run->scratch. */
static int32_t *
level_demand(const otx_mosaic *m, int32_t level, bool *mixed)
{
    const otx_surface *surface = m->job.surface;
    const int32_t count = surface->levels[level].face_count;
    int32_t *demand = OTX_NEW(m->job.run->scratch, int32_t, count);

    *mixed = false;
    for (int32_t f = 0; demand && f < count; ++f)
        demand[f] = -1;
    for (int32_t f = 0; demand && f < m->job.leaves.level->face_count; ++f)
    {
        const int32_t wanted = otx_supply_wanted(&m->job, f);
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
    const otx_mosaic *m, const otx_level *level, int32_t level_index,
    const int32_t *demand, int32_t k, otx_cluster *out)
{
    int32_t *faces = OTX_NEW(m->job.run->arena, int32_t, level->face_count);

    OTX_TRY(otx_run_ok(m->job.run));
    *out = (otx_cluster){
        level_index, 0, faces,
        m->job.demand ? m->supplies.items[k].area : m->job.surface->area, -1};
    for (int32_t f = 0; f < level->face_count; ++f)
        if (demand[f] == k)
            faces[out->face_count++] = f;
    return OSDTEX_OK;
}

otx_status
otx_supply_regions(otx_mosaic *m, int32_t level, otx_cluster *out)
{
    const int32_t last = m->job.surface->level_count - 1;
    bool mixed;
    int32_t *demand = level_demand(m, level, &mixed);

    if (demand && mixed)
    {
        level = last;
        demand = level_demand(m, level, &mixed);
    }
    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t k = 0; k < m->job.exemplar_count; ++k)
        OTX_TRY(take_region(
            m, &m->job.surface->levels[level], level, demand, k, &out[k]));
    return OSDTEX_OK;
}

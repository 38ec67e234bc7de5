/* fit.c -- search, commit [Soler02, sec. 4]. */
#include "patch/fit.h"
#include "patch/band.h"
#include "patch/bend.h"
#include "patch/continuation.h"
#include "patch/first.h"
#include "patch/follow.h"

#include "patch/angles.h"
#include "patch/mask_build.h"
#include "patch/placing.h"

/* One node that is looked up, and what the thread that does it works with. */
typedef struct trial
{
    int32_t index;
    otx_worker *worker; /* of the turn; NULL: the only node */
    otx_arena *scratch;
    otx_chart_space *space;
    otx_vec2 *points; /* [point_count] that must land inside */
    int32_t point_count;
} trial;

static otx_status
search(
    const otx_mosaic *m, const trial *t, const otx_mask *mask, otx_match *best,
    int32_t *count)
{
    const otx_node *node = &m->forest.nodes[t->index];
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_patch_settings *s = &supply->settings;
    double angles[OTX_ANGLES_MAX];
    otx_match_query query = otx_match_query_defaults(
        angles, otx_angles_list(m, t->index, mask, angles));

    query.coarse_levels = s->coarse;
    query.coarse_keep = s->keep;
    query.gauss_newton = s->mode == OTX_PATCH_BEST;
    query.overhang = m->spares.patch != NULL;
    query.cover = t->points;
    query.cover_count = t->point_count;
    query.centre = otx_placing_middle(&node->chart);
    if (s->usage > 0.0 && m->cover.done_area > 0.0)
    {
        query.usage = supply->usage;
        query.usage_width = query.usage_height = OTX_USAGE_CELLS;
        query.usage_weight =
            s->usage * m->cover.total_area / m->cover.done_area;
    }
    return t->worker ? otx_matcher_search_within(
                           t->worker, supply->matcher, mask, &query, best,
                           s->candidates, count)
                     : otx_matcher_search(
                           m->job.run, supply->matcher, mask, &query, best,
                           s->candidates, count);
}

/* Puts the exact continuation first when the search found nothing better. */
static void
offer_continuation(
    const otx_mosaic *m, const trial *t, const otx_mask *mask, otx_match *best,
    int32_t *count)
{
    const otx_node *node = &m->forest.nodes[t->index];
    otx_match match;

    if (!otx_continuation_match(
            otx_supply_of(m, node), mask, t->points, t->point_count, &match) ||
        !otx_follow_allows(m, node, match.angle) ||
        (*count > 0 && match.error > best[0].error))
        return;
    best[0] = match;
    *count = *count > 0 ? *count : 1;
}

/* Whether a patch's surroundings are wider than a search takes them: beside
 * faces of many pictures, as of a plain mesh and a small picture that tiles. */
static bool
is_vast(const otx_mosaic *m, const otx_node *node, const otx_mask *mask)
{
    const otx_mask_frame frame = {.rotation = {1.0, 0.0}, .pixel = {1.0, 1.0}};
    otx_mask_box box;

    if (mask->triangle_count == 0)
        return false;
    box = otx_mask_bounds(mask, &frame);
    return hypot(box.high.x - box.low.x, box.high.y - box.low.y) >
           otx_matcher_reach(otx_supply_of(m, node)->matcher);
}

/* Leaves the search what it takes of them. Where that is nothing the patch
 * itself repeats the picture, and had better go on as its neighbours do: found
 * in *out, when the result is true. */
static bool
reduce_vast(
    const otx_mosaic *m, const trial *t, otx_mask_triangle *triangles,
    otx_mask *mask, otx_match *out)
{
    const otx_node *node = &m->forest.nodes[t->index];
    const otx_supply *supply = otx_supply_of(m, node);
    const bool found =
        otx_continuation_place(supply, mask, t->points, t->point_count, out) &&
        otx_follow_allows(m, node, out->angle);

    otx_band_keep_near(
        triangles, &mask->triangle_count, otx_placing_middle(&node->chart),
        otx_matcher_reach(supply->matcher) / 3.0);
    return found && mask->triangle_count == 0;
}

/* Looks at what is committed and changes nothing but the node's own chart. */
static otx_status
find_place(const otx_mosaic *m, trial *t, otx_fit *fit)
{
    const otx_node *node = &m->forest.nodes[t->index];
    const bool bend = m->job.settings.relax == OTX_PATCH_RELAX_LOOP;
    otx_mask_triangle *triangles;
    otx_match best[16];
    otx_mask mask;
    int32_t count = 0;
    bool goes_on;

    t->points = otx_placing_points(m, node, t->scratch, &t->point_count);
    if (!t->points)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(
        otx_mask_build(m, node, t->scratch, &triangles, &mask.triangle_count));
    mask.triangles = triangles;
    goes_on = is_vast(m, node, &mask) &&
              reduce_vast(m, t, triangles, &mask, &best[0]);
    fit->searched = mask.triangle_count > 0 && !otx_first_is(m, node);
    if (otx_first_is(m, node))
        count = otx_placing_first(m, node, t->points, t->point_count, &best[0]);
    else if (fit->searched)
        OTX_TRY(search(m, t, &mask, best, &count));
    else if (goes_on)
        count = 1;
    else
        count = otx_placing_freely(
            m, t->index, t->points, t->point_count, &best[0]);
    if (m->job.settings.continuation && mask.triangle_count > 0)
        offer_continuation(m, t, &mask, best, &count);
    /* The surroundings may reach out of the exemplar where the patch does not;
     * a patch that cannot be split goes without them. */
    if (count == 0 && !otx_forest_can_split(m, node))
        count = otx_placing_freely(
            m, t->index, t->points, t->point_count, &best[0]);
    if (bend && count > 0 && mask.triangle_count > 0)
        OTX_TRY(otx_bend_relax(
            m, t->index, best, count, t->space, t->scratch, &best[0]));
    fit->found = count > 0;
    fit->placed = best[0];
    return OSDTEX_OK;
}

/* -- turns --------------------------------------------------------------- */

typedef struct fit_turn
{
    const otx_mosaic *mosaic;
    otx_fit *fits;
} fit_turn;

static otx_status
fit_of_turn(void *context, int64_t index, otx_worker *worker)
{
    const fit_turn *w = context;
    trial t = {
        .index = w->fits[index].node,
        .worker = worker,
        .scratch = worker->scratch,
        .space = &w->mosaic->forest.spaces[worker->index]};

    return find_place(w->mosaic, &t, &w->fits[index]);
}

/* One node with all threads. */
static otx_status
fit_alone(const otx_mosaic *m, otx_fit *fit)
{
    const otx_arena_mark mark = otx_arena_here(m->job.run->scratch);
    trial t = {
        .index = fit->node,
        .scratch = m->job.run->scratch,
        .space = &m->forest.spaces[0]};
    const otx_status status = find_place(m, &t, fit);

    otx_arena_release(m->job.run->scratch, mark);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(m->job.run, "map")
                                         : status;
}

/* What a search objects to is said only to a lone fit. */
otx_status
otx_fit_find(const otx_mosaic *m, otx_fit *fits, int32_t count)
{
    fit_turn w = {m, fits};

    if (count > 1)
    {
        const otx_status status =
            otx_pool_for(m->job.run->pool, count, fit_of_turn, &w);

        if (status == OSDTEX_ERROR_MEMORY)
            return otx_fail_memory(m->job.run, "map");
        if (status == OSDTEX_OK)
            return OSDTEX_OK;
    }
    for (int32_t i = 0; i < count; ++i)
        OTX_TRY(fit_alone(m, &fits[i]));
    return OSDTEX_OK;
}

/* -- commit -------------------------------------------------------------- */

/* 1 where a cell has got its even share of the surface. */
static void
note_usage(otx_mosaic *m, const otx_node *node, int32_t face, otx_vec2 middle)
{
    const otx_supply *supply = otx_supply_of(m, node);

    supply->usage[otx_supply_cell(supply, middle)] +=
        (float)(m->job.leaves.areas[face] / supply->area * OTX_USAGE_CELLS * OTX_USAGE_CELLS);
}

/* Gives a face to a placed node, in whose chart it is face `i`. */
static void
show(otx_mosaic *m, const otx_node *node, int32_t i)
{
    const otx_chart *chart = &node->chart;
    const int32_t face = chart->faces[i];
    const int32_t corner = m->job.leaves.level->face_first[face];
    const int32_t sides = chart->first[i + 1] - chart->first[i];
    otx_vec2 sum = {0, 0};

    m->cover.face_patch[face] = node->patch;
    for (int32_t k = 0; k < sides; ++k)
    {
        const otx_vec2 at = otx_spare_place(
            m, node, chart->flat[chart->corners[chart->first[i] + k]]);

        m->cover.uvs[corner + k] = at;
        sum = otx_vec2_add(sum, at);
    }
    note_usage(m, node, face, otx_vec2_scale(1.0 / sides, sum));
}

/* Faces that reach over the rim are shown by who could. */
static void
commit(otx_mosaic *m, int32_t index, otx_match placed)
{
    otx_node *node = &m->forest.nodes[index];

    node->placed = placed;
    node->patch = m->cover.patch_count;
    if (m->cover.patch_exemplar)
        m->cover.patch_exemplar[node->patch] = (uint8_t)node->supply;
    m->forest.patch_node[m->cover.patch_count++] = index;
    for (int32_t i = 0; i < node->chart.core_count; ++i)
    {
        int32_t at;
        const otx_node *other =
            otx_spare_find(m, node, node->chart.faces[i], &at);

        if (other && !otx_spare_is_inside(m, node, i))
            show(m, other, at);
        else
            show(m, node, i);
    }
    m->cover.done_area += node->cluster.area;
    m->tally.fit_error += placed.error;
    otx_spare_note(m, node);
}

bool
otx_fit_commit(otx_mosaic *m, const otx_fit *fit)
{
    const otx_node *node = &m->forest.nodes[fit->node];

    m->tally.fits += fit->searched;
    if (!fit->found || (fit->placed.error > m->job.settings.tau &&
                        otx_forest_can_split(m, node)))
        return false;
    commit(m, fit->node, fit->placed);
    return true;
}

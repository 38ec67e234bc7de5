/* fit.c -- mask, search, commit [Soler02, sec. 4].
 *
 * The mask is what the textured part of the collar shows, in the plane of the
 * chart. The paper takes a narrow band of it at full weight; here the band
 * counts fully and the rest of the collar with a weight that falls off, since
 * a wider view tells structures apart that agree along the border. */
#include "method/hierarchical/hierarchical.h"

#include "base/random.h"
#include "match/mask.h"

enum
{
    STAGE_ANGLE = 0x616e676c,
    STAGE_PLACE = 0x706c6163
};

/* Share of the side of an exemplar that does not tile that a patch and its mask
 * may take up. */
static const double MASK_SHARE = 0.6;

/* -- mask ---------------------------------------------------------------- */

static double
mask_weight(double reach, double band, double collar)
{
    if (reach <= band)
        return 1.0;
    return fmax(0.05, 1.0 - (reach - band) / fmax(collar - band, 1.0)) * 0.5;
}

/* Where vertices have position values the mask is the paper's: all of the band
 * and nothing else. Elsewhere the triangle as it is. */
static int32_t
add_triangle(
    const otx_chart *chart, otx_mask_triangle *t, int32_t first,
    const int32_t at[3], double band, otx_mask_triangle *out)
{
    double reach[3];

    if (!chart->vert_reach)
    {
        *out = *t;
        return 1;
    }
    for (int j = 0; j < 3; ++j)
    {
        reach[j] = chart->vert_reach[chart->corners[first + at[j]]];
        t->weight[j] = 1.0f;
    }
    return otx_band_clip(t, reach, band, out);
}

/* How far the mask may reach round a patch of `size`. All of the mask must
 * land inside an exemplar that does not tile, so a wide one leaves few places
 * to choose from, and keeps the patch away from the exemplar's rim. */
static double
widest_mask(const otx_exemplar *e, double size)
{
    const double width = e->wrap_x ? INFINITY : e->match.width;
    const double height = e->wrap_y ? INFINITY : e->match.height;

    return 0.5 * (MASK_SHARE * fmin(width, height) - size);
}

/* The collar's textured faces as mask triangles. */
static otx_status
make_mask(
    const otx_mapper *m, const otx_node *node, otx_arena *scratch,
    otx_mask_triangle **out, int32_t *out_count)
{
    const otx_chart *chart = &node->chart;
    const otx_level *leaf = m->leaves.level;
    const double band = otx_nodes_band(m, node);
    const double collar = otx_nodes_collar(m, node);
    const double widest = fmax(
        band,
        widest_mask(otx_supply_of(m, node)->exemplar, otx_nodes_size(m, node)));
    /* A triangle that is cut leaves two. */
    otx_mask_triangle *triangles = OTX_NEW(
        scratch, otx_mask_triangle,
        2 * (int64_t)chart->first[chart->face_count]);
    int32_t count = 0;

    if (!triangles)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = chart->core_count; i < chart->face_count; ++i)
    {
        const int32_t face = chart->faces[i];
        const int32_t corner = leaf->face_first[face];
        const int32_t first = chart->first[i];
        const float weight = (float)mask_weight(chart->reach[i], band, collar);

        if (m->face_patch[face] < 0 || chart->reach[i] > widest)
            continue;

        const int32_t from = otx_supply_of_patch(m, m->face_patch[face]);

        for (int32_t k = 1; k + 1 < chart->first[i + 1] - first; ++k)
        {
            const int32_t at[3] = {0, k, k + 1};
            otx_mask_triangle t = {
                .from =
                    from == node->supply ? NULL : m->supplies[from].matcher};

            for (int j = 0; j < 3; ++j)
            {
                t.flat[j] = chart->flat[chart->corners[first + at[j]]];
                t.source[j] = m->uvs[corner + at[j]];
                t.weight[j] = weight;
            }
            count +=
                add_triangle(chart, &t, first, at, band, triangles + count);
        }
    }
    *out = triangles;
    *out_count = count;
    return OSDTEX_OK;
}

/* -- placement ----------------------------------------------------------- */

/* One node that is looked up, and what the thread that does it works with. */
typedef struct trial
{
    int32_t index;
    otx_worker *worker; /* of the wave; NULL: the only node */
    otx_arena *scratch;
    otx_chart_space *space;
    otx_vec2 *points; /* [point_count] corners of the core */
    int32_t point_count;
} trial;

static otx_vec2
core_middle(const otx_chart *chart)
{
    otx_vec2 sum = {0, 0};
    const int32_t corners = chart->first[chart->core_count];

    for (int32_t c = 0; c < corners; ++c)
        sum = otx_vec2_add(sum, chart->flat[chart->corners[c]]);
    return otx_vec2_scale(1.0 / corners, sum);
}

/* Corners of the core: they must land inside an exemplar that does not tile. */
static otx_vec2 *
core_points(const otx_chart *chart, otx_arena *scratch, int32_t *count)
{
    const int32_t corners = chart->first[chart->core_count];
    otx_vec2 *points = OTX_NEW(scratch, otx_vec2, corners);

    *count = corners;
    for (int32_t c = 0; points && c < corners; ++c)
        points[c] = chart->flat[chart->corners[c]];
    return points;
}

/* Bounding box of turned points. */
static void
turned_bounds(
    const otx_vec2 *points, int32_t count, otx_vec2 turn, otx_vec2 *low,
    otx_vec2 *high)
{
    *low = (otx_vec2){INFINITY, INFINITY};
    *high = (otx_vec2){-INFINITY, -INFINITY};
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 p = otx_vec2_mul(turn, points[i]);

        *low = (otx_vec2){fmin(low->x, p.x), fmin(low->y, p.y)};
        *high = (otx_vec2){fmax(high->x, p.x), fmax(high->y, p.y)};
    }
}

/* Range of shifts along one axis that keeps the points inside, or the whole
 * period where the exemplar tiles. False when there is none. */
static bool
shift_range(
    bool wraps, double size, double low, double high, double *first,
    double *span)
{
    *first = wraps ? 0.0 : 0.5 - low;
    *span = wraps ? size : size - 1.0 - (high - low);
    return *span >= 0.0;
}

/* A placement by chance or by the user's wish, for a patch that has nothing to
 * match [Soler02, sec. 2.2]. Tries orientations until one lies inside. */
static bool
place_freely(
    const otx_mapper *m, int32_t index, const otx_vec2 *points, int32_t count,
    otx_match *out)
{
    const otx_supply *supply = otx_supply_of(m, &m->nodes[index]);
    const otx_exemplar *e = supply->exemplar;
    double guided[OTX_FOLLOW_ANGLES];
    const int32_t guided_count =
        supply->guide ? otx_follow_angles(m, &m->nodes[index], NAN, guided) : 0;

    for (int32_t turn = 0; turn < 64; ++turn)
    {
        const uint64_t element = (uint64_t)index * 64u + (uint64_t)turn;
        const double angle =
            guided_count > 0
                ? guided[turn % guided_count]
                : 2.0 * OTX_PI *
                      otx_random_unit(m->run->seed, STAGE_ANGLE, element);
        otx_vec2 low, high;
        double x, y, dx, dy;

        turned_bounds(points, count, otx_vec2_polar(angle), &low, &high);
        if (!shift_range(e->wrap_x, e->match.width, low.x, high.x, &x, &dx) ||
            !shift_range(e->wrap_y, e->match.height, low.y, high.y, &y, &dy))
            continue;
        x += dx * otx_random_unit(m->run->seed, STAGE_PLACE, 2 * element);
        y += dy * otx_random_unit(m->run->seed, STAGE_PLACE, 2 * element + 1);
        *out = (otx_match){angle, {x, y}, 0.0};
        return true;
    }
    return false;
}

/* Nearest shift to the wanted one that keeps points between low and high
 * inside along an axis that does not tile; centred when there is no room. */
static double
shift_inside(bool wraps, double size, double low, double high, double wanted)
{
    const double least = 0.5 - low, most = size - 0.5 - high;

    if (wraps)
        return wanted;
    return least <= most ? fmin(fmax(wanted, least), most)
                         : 0.5 * (least + most);
}

/* The user's first patch: the middle of its face at a given place, that face's
 * first edge turned as asked, or as near to there as it lies inside. False when
 * it does not fit so turned. */
static bool
place_first(
    const otx_mapper *m, const otx_node *node, const otx_vec2 *points,
    int32_t count, otx_match *out)
{
    const otx_map_request *r = m->request;
    const otx_exemplar *e = otx_supply_of(m, node)->exemplar;
    const otx_chart *chart = &node->chart;
    const double w = e->match.width, h = e->match.height;
    const double angle = r->first_angle - otx_first_heading(m, chart);
    const otx_vec2 turn = otx_vec2_polar(angle);
    const otx_vec2 middle = otx_first_middle(m, chart);
    const otx_vec2 target = {r->first_position.x * w, r->first_position.y * h};
    otx_vec2 shift = otx_vec2_sub(target, otx_vec2_mul(turn, middle));
    otx_vec2 low, high;

    turned_bounds(points, count, turn, &low, &high);
    shift.x = shift_inside(e->wrap_x, w, low.x, high.x, shift.x);
    shift.y = shift_inside(e->wrap_y, h, low.y, high.y, shift.y);
    *out = (otx_match){angle, shift, 0.0};
    return (e->wrap_x || high.x - low.x <= w - 1.0) &&
           (e->wrap_y || high.y - low.y <= h - 1.0);
}

/* Degrees about the continuing orientation that are left out where exact
 * continuation is to be avoided: on what is flat it would always win, and the
 * picture repeat itself. */
static const double AVOIDED = 5.0;

/* From -drift to drift as `share` goes from 0 to 1, but for what is avoided. */
static double
offset_of(const otx_hierarchical_settings *s, double drift, double share)
{
    const double avoided =
        s->continuation ? 0.0 : fmin(AVOIDED * OTX_PI / 180.0, 0.5 * drift);
    const double x = 2.0 * share - 1.0;

    return copysign(avoided, x) + x * (drift - avoided);
}

/* Orientations to search, into angles[360]; how many. Drawn at random, so that
 * the exact continuation of a single neighbour is not among them unless it is
 * wanted [Soler02, sec. 4.2]; within `drift` of what continues the neighbours,
 * so that the first patch's direction spreads. */
static int32_t
list_angles(
    const otx_mapper *m, int32_t index, const otx_mask *mask, double *angles)
{
    const otx_node *node = &m->nodes[index];
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_hierarchical_settings *s = &supply->settings;
    const double continuing = otx_continuation_angle(mask);
    const double chance =
        otx_random_unit(m->run->seed, STAGE_ANGLE, (uint64_t)index * 64u);
    const double drift = s->drift * OTX_PI / 180.0;

    if (supply->guide)
        return otx_follow_angles(m, node, continuing, angles);
    for (int32_t k = 0; k < s->angles; ++k)
        if (drift >= OTX_PI)
            angles[k] = (s->continuation ? continuing : 2.0 * OTX_PI * chance) +
                        2.0 * OTX_PI * k / s->angles;
        else
            angles[k] = continuing +
                        offset_of(
                            s, drift,
                            (k + (s->continuation ? 0.5 : chance)) / s->angles);
    return s->angles;
}

static otx_status
search(
    const otx_mapper *m, const trial *t, const otx_mask *mask, otx_match *best,
    int32_t *count)
{
    const otx_node *node = &m->nodes[t->index];
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_hierarchical_settings *s = &supply->settings;
    double angles[360];
    otx_match_query query = otx_match_query_defaults(
        angles, list_angles(m, t->index, mask, angles));

    query.coarse_levels = s->coarse;
    query.coarse_keep = s->keep;
    query.gauss_newton = s->mode == OTX_HIERARCHICAL_BEST;
    query.cover = t->points;
    query.cover_count = t->point_count;
    query.centre = core_middle(&node->chart);
    if (s->usage > 0.0 && m->done_area > 0.0)
    {
        query.usage = supply->usage;
        query.usage_width = query.usage_height = OTX_USAGE_CELLS;
        query.usage_weight = s->usage;
    }
    return t->worker ? otx_matcher_search_within(
                           t->worker, supply->matcher, mask, &query, best,
                           s->candidates, count)
                     : otx_matcher_search(
                           m->run, supply->matcher, mask, &query, best,
                           s->candidates, count);
}

/* Puts the exact continuation first when the search found nothing better. */
static void
offer_continuation(
    const otx_mapper *m, const trial *t, const otx_mask *mask, otx_match *best,
    int32_t *count)
{
    const otx_node *node = &m->nodes[t->index];
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
is_vast(const otx_mapper *m, const otx_node *node, const otx_mask *mask)
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
    const otx_mapper *m, const trial *t, otx_mask_triangle *triangles,
    otx_mask *mask, otx_match *out)
{
    const otx_node *node = &m->nodes[t->index];
    const otx_supply *supply = otx_supply_of(m, node);
    const bool found =
        otx_continuation_place(supply, mask, t->points, t->point_count, out) &&
        otx_follow_allows(m, node, out->angle);

    otx_band_keep_near(
        triangles, &mask->triangle_count, core_middle(&node->chart),
        otx_matcher_reach(supply->matcher) / 3.0);
    return found && mask->triangle_count == 0;
}

/* Looks at what is committed and changes nothing but the node's own chart. */
static otx_status
find_place(const otx_mapper *m, trial *t, otx_fit *fit)
{
    const otx_node *node = &m->nodes[t->index];
    const bool bend = m->settings.relax == OTX_HIERARCHICAL_RELAX_LOOP;
    otx_mask_triangle *triangles;
    otx_match best[16];
    otx_mask mask;
    int32_t count = 0;
    bool goes_on;

    t->points = core_points(&node->chart, t->scratch, &t->point_count);
    if (!t->points)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(make_mask(m, node, t->scratch, &triangles, &mask.triangle_count));
    mask.triangles = triangles;
    goes_on = is_vast(m, node, &mask) &&
              reduce_vast(m, t, triangles, &mask, &best[0]);
    fit->searched = mask.triangle_count > 0 && !otx_first_is(m, node);
    if (otx_first_is(m, node))
        count = place_first(m, node, t->points, t->point_count, &best[0]);
    else if (fit->searched)
        OTX_TRY(search(m, t, &mask, best, &count));
    else if (goes_on)
        count = 1;
    else
        count = place_freely(m, t->index, t->points, t->point_count, &best[0]);
    if (m->settings.continuation && mask.triangle_count > 0)
        offer_continuation(m, t, &mask, best, &count);
    /* The surroundings may reach out of the exemplar where the patch does not;
     * a patch that cannot be split goes without them. */
    if (count == 0 && !otx_nodes_can_split(m, node))
        count = place_freely(m, t->index, t->points, t->point_count, &best[0]);
    if (bend && count > 0 && mask.triangle_count > 0)
        OTX_TRY(otx_loop_relax(
            m, t->index, best, count, t->space, t->scratch, &best[0]));
    fit->found = count > 0;
    fit->placed = best[0];
    return OSDTEX_OK;
}

/* -- waves --------------------------------------------------------------- */

typedef struct wave
{
    const otx_mapper *mapper;
    otx_fit *fits;
} wave;

static otx_status
fit_of_wave(void *context, int64_t index, otx_worker *worker)
{
    const wave *w = context;
    trial t = {
        .index = w->fits[index].node,
        .worker = worker,
        .scratch = worker->scratch,
        .space = &w->mapper->spaces[worker->index]};

    return find_place(w->mapper, &t, &w->fits[index]);
}

/* One node with all threads. */
static otx_status
fit_alone(const otx_mapper *m, otx_fit *fit)
{
    const otx_arena_mark mark = otx_arena_here(m->run->scratch);
    trial t = {
        .index = fit->node, .scratch = m->run->scratch, .space = &m->spaces[0]};
    const otx_status status = find_place(m, &t, fit);

    otx_arena_release(m->run->scratch, mark);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(m->run, "map")
                                         : status;
}

/* What a search objects to is said only to a lone fit. */
otx_status
otx_fit_find(const otx_mapper *m, otx_fit *fits, int32_t count)
{
    wave w = {m, fits};

    if (count > 1)
    {
        const otx_status status =
            otx_pool_for(m->run->pool, count, fit_of_wave, &w);

        if (status == OSDTEX_ERROR_MEMORY)
            return otx_fail_memory(m->run, "map");
        if (status == OSDTEX_OK)
            return OSDTEX_OK;
    }
    for (int32_t i = 0; i < count; ++i)
        OTX_TRY(fit_alone(m, &fits[i]));
    return OSDTEX_OK;
}

/* -- commit -------------------------------------------------------------- */

static void
note_usage(otx_mapper *m, const otx_node *node, otx_vec2 middle)
{
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_image *image = &supply->exemplar->match;
    const otx_vec2 p = otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(node->placed.angle), middle),
        node->placed.shift);
    const double u = p.x / image->width, v = p.y / image->height;
    int32_t x = (int32_t)((u - floor(u)) * OTX_USAGE_CELLS);
    int32_t y = (int32_t)((v - floor(v)) * OTX_USAGE_CELLS);

    if (x >= OTX_USAGE_CELLS)
        x = OTX_USAGE_CELLS - 1;
    if (y >= OTX_USAGE_CELLS)
        y = OTX_USAGE_CELLS - 1;
    /* 1 where a cell has got its even share of the surface. */
    supply->usage[y * OTX_USAGE_CELLS + x] +=
        (float)(node->cluster.area / supply->area * OTX_USAGE_CELLS * OTX_USAGE_CELLS);
}

static void
commit(otx_mapper *m, int32_t index, otx_match placed)
{
    otx_node *node = &m->nodes[index];
    const otx_chart *chart = &node->chart;
    const otx_vec2 turn = otx_vec2_polar(placed.angle);

    node->placed = placed;
    node->patch = m->patch_count;
    if (m->patch_exemplar)
        m->patch_exemplar[node->patch] = (uint8_t)node->supply;
    m->patch_node[m->patch_count++] = index;
    for (int32_t i = 0; i < chart->core_count; ++i)
    {
        const int32_t face = chart->faces[i];
        const int32_t corner = m->leaves.level->face_first[face];

        m->face_patch[face] = node->patch;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            m->uvs[corner + c - chart->first[i]] = otx_vec2_add(
                otx_vec2_mul(turn, chart->flat[chart->corners[c]]),
                placed.shift);
    }
    m->done_area += node->cluster.area;
    m->stats->fit_error_mean += placed.error;
    ++m->stats
          ->patches[node->cluster.face_count > 1 ? 0 : node->cluster.level + 1];
    note_usage(m, node, core_middle(chart));
}

bool
otx_fit_commit(otx_mapper *m, const otx_fit *fit)
{
    const otx_node *node = &m->nodes[fit->node];

    m->stats->fit_count += fit->searched;
    if (!fit->found ||
        (fit->placed.error > m->settings.tau && otx_nodes_can_split(m, node)))
        return false;
    commit(m, fit->node, fit->placed);
    return true;
}

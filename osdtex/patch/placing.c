/* placing.c -- placements that are not searched: by chance, or as asked for. */
#include "patch/placing.h"
#include "patch/first.h"
#include "patch/follow.h"

#include "base/random.h"
#include "patch/angles.h"

enum
{
    STAGE_PLACE = 0x706c6163
};

otx_vec2
otx_placing_middle(const otx_chart *chart)
{
    otx_vec2 sum = {0, 0};
    const int32_t corners = chart->first[chart->core_count];

    for (int32_t c = 0; c < corners; ++c)
        sum = otx_vec2_add(sum, chart->flat[chart->corners[c]]);
    return otx_vec2_scale(1.0 / corners, sum);
}

otx_vec2 *
otx_placing_points(
    const otx_mosaic *m, const otx_node *node, otx_arena *scratch,
    int32_t *count)
{
    const otx_chart *chart = &node->chart;
    otx_vec2 *points =
        OTX_NEW(scratch, otx_vec2, chart->first[chart->core_count] + 1);

    *count = 0;
    for (int32_t i = 0; points && i < chart->core_count; ++i)
    {
        int32_t index;

        if (otx_spare_find(m, node, chart->faces[i], &index))
            continue;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            points[(*count)++] = chart->flat[chart->corners[c]];
    }
    if (points && m->spares.patch)
        points[(*count)++] = otx_placing_middle(chart);
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
bool
otx_placing_freely(
    const otx_mosaic *m, int32_t index, const otx_vec2 *points, int32_t count,
    otx_match *out)
{
    const otx_supply *supply = otx_supply_of(m, &m->forest.nodes[index]);
    const otx_exemplar *e = supply->exemplar;
    double guided[OTX_FOLLOW_ANGLES];
    const int32_t guided_count =
        supply->guide
            ? otx_follow_angles(m, &m->forest.nodes[index], NAN, guided)
            : 0;

    for (int32_t turn = 0; turn < 64; ++turn)
    {
        const uint64_t element = (uint64_t)index * 64u + (uint64_t)turn;
        const double angle =
            guided_count > 0
                ? guided[turn % guided_count]
                : 2.0 * OTX_PI *
                      otx_random_unit(
                          m->job.run->seed, OTX_ANGLES_DRAW, element);
        otx_vec2 low, high;
        double x, y, dx, dy;

        turned_bounds(points, count, otx_vec2_polar(angle), &low, &high);
        if (!shift_range(e->wrap_x, e->match.width, low.x, high.x, &x, &dx) ||
            !shift_range(e->wrap_y, e->match.height, low.y, high.y, &y, &dy))
            continue;
        x += dx * otx_random_unit(m->job.run->seed, STAGE_PLACE, 2 * element);
        y += dy *
             otx_random_unit(m->job.run->seed, STAGE_PLACE, 2 * element + 1);
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
bool
otx_placing_first(
    const otx_mosaic *m, const otx_node *node, const otx_vec2 *points,
    int32_t count, otx_match *out)
{
    const otx_first *r = &m->job.first;
    const otx_exemplar *e = otx_supply_of(m, node)->exemplar;
    const otx_chart *chart = &node->chart;
    const double w = e->match.width, h = e->match.height;
    const double angle = r->angle - otx_first_heading(m, chart);
    const otx_vec2 turn = otx_vec2_polar(angle);
    const otx_vec2 middle = otx_first_middle(m, chart);
    const otx_vec2 target = {r->position.x * w, r->position.y * h};
    otx_vec2 shift = otx_vec2_sub(target, otx_vec2_mul(turn, middle));
    otx_vec2 low, high;

    turned_bounds(points, count, turn, &low, &high);
    shift.x = shift_inside(e->wrap_x, w, low.x, high.x, shift.x);
    shift.y = shift_inside(e->wrap_y, h, low.y, high.y, shift.y);
    *out = (otx_match){angle, shift, 0.0};
    return (e->wrap_x || high.x - low.x <= w - 1.0) &&
           (e->wrap_y || high.y - low.y <= h - 1.0);
}

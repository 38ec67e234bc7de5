/* period.c -- lengths along the sides by which a lattice repeats. */
#include "quilt/period.h"

#include <math.h>

enum
{
    ORDER_MAX = 64, /* generators to a side that are tried */
    ADJUST = 2,     /* texels by which a length may be bettered */
    STRIP = 4       /* texels on either side of an end that are compared */
};

static const double ASIDE = 1.0 / 30; /* of the shorter generator */
static const double LEAST = 0.5;      /* of the side */

static double
along(otx_vec2 v, int axis)
{
    return axis == 0 ? v.x : v.y;
}

static double
aside(const otx_vec2 g[2])
{
    return ASIDE * fmin(otx_vec2_length(g[0]), otx_vec2_length(g[1]));
}

/* The longest combination along an axis that is not longer than `side`; 0 where
 * there is none. */
static double
longest(const otx_vec2 g[2], int axis, int32_t side)
{
    const double tolerance = aside(g);
    double best = 0.0;

    for (int32_t j = -ORDER_MAX; j <= ORDER_MAX; ++j)
        for (int32_t i = -ORDER_MAX; i <= ORDER_MAX; ++i)
        {
            const otx_vec2 v =
                otx_vec2_add(otx_vec2_scale(i, g[0]), otx_vec2_scale(j, g[1]));
            const double length = along(v, axis);

            if (fabs(along(v, 1 - axis)) <= tolerance && length > best &&
                lround(length) <= side)
                best = length;
        }
    return best;
}

/* Squared difference of the strips around `from` and `from + length`. */
static double
difference(const otx_image *lab, int axis, int32_t from, int32_t length)
{
    const int32_t side = axis == 0 ? lab->width : lab->height;
    const int32_t across = axis == 0 ? lab->height : lab->width;
    double sum = 0.0, count = 0.0;

    for (int32_t i = from - STRIP; i < from + STRIP; ++i)
    {
        if (i < 0 || i + length >= side)
            continue;
        for (int32_t j = 0; j < across; ++j)
            sum += axis == 0 ? otx_image_distance_sq(
                                   otx_image_at(lab, i, j),
                                   otx_image_at(lab, i + length, j))
                             : otx_image_distance_sq(
                                   otx_image_at(lab, j, i),
                                   otx_image_at(lab, j, i + length));
        count += across;
    }
    return count > 0.0 ? sum / count : INFINITY;
}

static bool
find_axis(
    const otx_exemplar *e, const otx_vec2 g[2], int axis, int32_t *from,
    int32_t *length)
{
    const int32_t side = axis == 0 ? e->lab.width : e->lab.height;
    const double period = longest(g, axis, side);
    double best = INFINITY;

    *from = 0;
    *length = side;
    /* The border of a lattice that is cut off inside a brick has no step; its
     * generators know better. */
    if ((axis == 0 ? e->wrap_x : e->wrap_y) &&
        side - period <= ADJUST + aside(g))
        return true;
    if (!(period >= LEAST * side) || period < 1.0)
        return false;
    for (int32_t n = (int32_t)lround(period) - ADJUST;
         n <= (int32_t)lround(period) + ADJUST; ++n)
        for (int32_t x = 0; x + n <= side; ++x)
        {
            const double d = difference(&e->lab, axis, x, n);

            if (!(d < best))
                continue;
            best = d;
            *from = x;
            *length = n;
        }
    return true;
}

bool
otx_period_find(
    const otx_exemplar *exemplar, const otx_vec2 generators[2], otx_period *out)
{
    return find_axis(exemplar, generators, 0, &out->x, &out->width) &&
           find_axis(exemplar, generators, 1, &out->y, &out->height);
}

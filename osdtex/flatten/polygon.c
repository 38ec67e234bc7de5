/* polygon.c -- sides kept, angles as near as can be.
 *
 * All the freedom of a closed polygon with given sides is in its angles: none
 * for a triangle, one for a quadrangle, n - 3 beyond. */
#include "flatten/polygon.h"

enum
{
    DIAGONAL_STEPS = 48,
    CLOSING_ROUNDS = 12
};

/* Angle of a triangle between sides a and b, opposite c. */
static double
corner_angle(double a, double b, double c)
{
    const double product = 2.0 * a * b;
    const double cosine =
        product > 0.0 ? (a * a + b * b - c * c) / product : 1.0;

    return acos(fmin(1.0, fmax(-1.0, cosine)));
}

/* Angle at corner i inside the polygon, in (0, 2 pi). */
static double
angle_in_space(const otx_vec3 *p, int32_t n, int32_t i, otx_vec3 normal)
{
    const otx_vec3 next = otx_vec3_sub(p[(i + 1) % n], p[i]);
    const otx_vec3 last = otx_vec3_sub(p[(i + n - 1) % n], p[i]);
    const otx_vec3 cross = otx_vec3_cross(next, last);
    const double angle =
        atan2(otx_vec3_length(cross), otx_vec3_dot(next, last));

    return otx_vec3_dot(cross, normal) < 0.0 ? 2.0 * OTX_PI - angle : angle;
}

/* Side lengths, and the angles in space scaled to the sum of a plane
 * polygon. */
static void
measure_polygon(
    const otx_vec3 *p, int32_t n, otx_vec3 normal, double *side, double *angle)
{
    double sum = 0.0;

    for (int32_t i = 0; i < n; ++i)
    {
        side[i] = otx_vec3_length(otx_vec3_sub(p[(i + 1) % n], p[i]));
        angle[i] = angle_in_space(p, n, i, normal);
        sum += angle[i];
    }
    for (int32_t i = 0; i < n && sum > 0.0; ++i)
        angle[i] *= (n - 2) * OTX_PI / sum;
}

/* Angles of the quadrangle whose diagonal from corner 0 to 2 is `d`. */
static void
angles_of_diagonal(const double side[4], double d, double angle[4])
{
    angle[1] = corner_angle(side[0], side[1], d);
    angle[3] = corner_angle(side[2], side[3], d);
    angle[0] =
        corner_angle(side[0], d, side[1]) + corner_angle(d, side[3], side[2]);
    angle[2] =
        corner_angle(side[1], d, side[0]) + corner_angle(d, side[2], side[3]);
}

static double
diagonal_misfit(const double side[4], const double wanted[4], double d)
{
    double angle[4], sum = 0.0;

    angles_of_diagonal(side, d, angle);
    for (int i = 0; i < 4; ++i)
        sum += (angle[i] - wanted[i]) * (angle[i] - wanted[i]);
    return sum;
}

/* The best diagonal: a scan, then golden sections around the best place. */
static double
search_diagonal(const double side[4], const double wanted[4])
{
    const double golden = 0.6180339887498949;
    const double shortest =
        fmax(fabs(side[0] - side[1]), fabs(side[2] - side[3]));
    const double longest = fmin(side[0] + side[1], side[2] + side[3]);
    const double step = (longest - shortest) / DIAGONAL_STEPS;
    double best = 0.5 * (shortest + longest), least = INFINITY;
    double low, high;

    if (!(step > 0.0))
        return best;
    for (int32_t i = 0; i < DIAGONAL_STEPS; ++i)
    {
        const double d = shortest + (i + 0.5) * step;
        const double misfit = diagonal_misfit(side, wanted, d);

        if (misfit < least)
        {
            least = misfit;
            best = d;
        }
    }
    low = fmax(best - step, shortest + 0.01 * step);
    high = fmin(best + step, longest - 0.01 * step);
    for (int32_t i = 0; i < DIAGONAL_STEPS; ++i)
    {
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);

        if (diagonal_misfit(side, wanted, a) < diagonal_misfit(side, wanted, b))
            high = b;
        else
            low = a;
    }
    return 0.5 * (low + high);
}

/* Walks along the sides, turning by pi - angle at each corner. `*gap` is what
 * is missing to come back to the start. */
static void
walk_sides(
    const double *side, const double *angle, int32_t n, otx_vec2 *out,
    otx_vec2 *gap)
{
    otx_vec2 at = {0, 0};
    double heading = 0.0;

    for (int32_t i = 0; i < n; ++i)
    {
        out[i] = at;
        at = otx_vec2_add(at, otx_vec2_scale(side[i], otx_vec2_polar(heading)));
        heading += OTX_PI - angle[(i + 1) % n];
    }
    *gap = at;
}

/* Solves the symmetric 3 x 3 system m x = b by elimination; the pivots of a
 * positive definite matrix need no order. False when it is singular. */
static bool
solve3(double m[3][3], double b[3], double x[3])
{
    for (int i = 0; i < 3; ++i)
    {
        if (!(m[i][i] > 1e-12))
            return false;
        for (int j = i + 1; j < 3; ++j)
        {
            const double f = m[j][i] / m[i][i];

            for (int k = i; k < 3; ++k)
                m[j][k] -= f * m[i][k];
            b[j] -= f * b[i];
        }
    }
    for (int i = 2; i >= 0; --i)
    {
        x[i] = b[i];
        for (int k = i + 1; k < 3; ++k)
            x[i] -= m[i][k] * x[k];
        x[i] /= m[i][i];
    }
    return true;
}

/* One Gauss-Newton step towards the wanted angles under the constraint that
 * the walk closes: with c the gap and the excess turn and J its derivative by
 * the angles, delta = r + J^T lambda, J J^T lambda = -c - J r, r = wanted -
 * angle. False when the polygon has no freedom left. */
static bool
close_polygon(
    const double *wanted, const otx_vec2 *at, otx_vec2 gap, int32_t n,
    double *angle)
{
    double m[3][3] = {{0}}, b[3] = {-gap.x, -gap.y, (n - 2) * OTX_PI};
    double lambda[3];

    for (int32_t i = 0; i < n; ++i)
    {
        /* Opening corner i turns all that is walked after it clockwise about
         * it; corner 0 only turns the end, where nothing is walked. */
        const otx_vec2 arm =
            i > 0 ? otx_vec2_sub(gap, at[i]) : (otx_vec2){0, 0};
        const double row[3] = {arm.y, -arm.x, 1.0};
        const double residual = wanted[i] - angle[i];

        b[2] -= angle[i];
        for (int j = 0; j < 3; ++j)
        {
            b[j] -= row[j] * residual;
            for (int k = 0; k < 3; ++k)
                m[j][k] += row[j] * row[k];
        }
    }
    if (!solve3(m, b, lambda))
        return false;
    for (int32_t i = 0; i < n; ++i)
    {
        const otx_vec2 arm =
            i > 0 ? otx_vec2_sub(gap, at[i]) : (otx_vec2){0, 0};

        angle[i] =
            wanted[i] + lambda[0] * arm.y - lambda[1] * arm.x + lambda[2];
    }
    return true;
}

/* Any number of corners. What gap is left is shared out along the sides. */
static void
layout_sides(
    const double *side, const double *wanted, int32_t n, double *angle,
    otx_vec2 *out)
{
    otx_vec2 gap;

    for (int32_t i = 0; i < n; ++i)
        angle[i] = wanted[i];
    walk_sides(side, angle, n, out, &gap);
    for (int32_t round = 0; round < CLOSING_ROUNDS; ++round)
    {
        if (!close_polygon(wanted, out, gap, n, angle))
            break;
        walk_sides(side, angle, n, out, &gap);
    }
    for (int32_t i = 0; i < n; ++i)
        out[i] = otx_vec2_sub(out[i], otx_vec2_scale((double)i / n, gap));
}

static void
layout_triangle(const double side[3], otx_vec2 out[3])
{
    const double angle = corner_angle(side[0], side[2], side[1]);

    out[0] = (otx_vec2){0, 0};
    out[1] = (otx_vec2){side[0], 0};
    out[2] = otx_vec2_scale(side[2], otx_vec2_polar(angle));
}

static void
layout_quadrangle(const double side[4], const double wanted[4], otx_vec2 out[4])
{
    const double d = search_diagonal(side, wanted);
    const double low = corner_angle(side[0], d, side[1]);
    const double high = corner_angle(d, side[3], side[2]);

    out[0] = (otx_vec2){0, 0};
    out[1] = (otx_vec2){side[0], 0};
    out[2] = otx_vec2_scale(d, otx_vec2_polar(low));
    out[3] = otx_vec2_scale(side[3], otx_vec2_polar(low + high));
}

otx_status
otx_polygon_layout(
    otx_arena *scratch, const otx_vec3 *points, int32_t count, otx_vec3 normal,
    otx_vec2 *out)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    double *side = OTX_NEW(scratch, double, count);
    double *wanted = OTX_NEW(scratch, double, count);
    double *angle = OTX_NEW(scratch, double, count);

    if (!side || !wanted || !angle)
        return OSDTEX_ERROR_MEMORY;
    measure_polygon(points, count, normal, side, wanted);
    if (count == 3)
        layout_triangle(side, out);
    else if (count == 4)
        layout_quadrangle(side, wanted, out);
    else
        layout_sides(side, wanted, count, angle, out);
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

/* Twice tan(angle / 2) at x between corners a and b, both relative to x; on
 * the side between them the sum that it is divided by vanishes. */
static double
half_tangent(otx_vec2 a, otx_vec2 b)
{
    const double below =
        otx_vec2_length(a) * otx_vec2_length(b) + otx_vec2_dot(a, b);

    return otx_vec2_cross(a, b) / fmax(below, 1e-300);
}

/* Those on the side that is nearest to x, of its nearest point; even ones in a
 * polygon without sides. */
static void
nearest_side(
    const otx_vec2 *corners, int32_t count, otx_vec2 x, double *weights)
{
    double least = INFINITY, along = 0.0, perimeter = 0.0;
    int32_t best = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 side =
            otx_vec2_sub(corners[(i + 1) % count], corners[i]);
        const otx_vec2 way = otx_vec2_sub(x, corners[i]);
        const double length_sq = otx_vec2_dot(side, side);
        const double part =
            length_sq > 0.0
                ? fmin(1.0, fmax(0.0, otx_vec2_dot(way, side) / length_sq))
                : 0.0;
        const double away =
            otx_vec2_length(otx_vec2_sub(way, otx_vec2_scale(part, side)));

        weights[i] = 0.0;
        perimeter += length_sq;
        if (away < least)
        {
            least = away;
            along = part;
            best = i;
        }
    }
    weights[best] = 1.0 - along;
    weights[(best + 1) % count] += along;
    for (int32_t i = 0; i < count && perimeter == 0.0; ++i)
        weights[i] = 1.0 / count;
}

void
otx_polygon_coordinates(
    const otx_vec2 *corners, int32_t count, otx_vec2 x, double *weights)
{
    double sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 last = otx_vec2_sub(corners[(i + count - 1) % count], x);
        const otx_vec2 here = otx_vec2_sub(corners[i], x);
        const otx_vec2 next = otx_vec2_sub(corners[(i + 1) % count], x);
        const double radius = fmax(otx_vec2_length(here), 1e-300);

        weights[i] =
            (half_tangent(last, here) + half_tangent(here, next)) / radius;
        sum += weights[i];
    }
    /* Written so that NaN lands here too: x at a corner, on a side or far
     * outside, or a polygon without area. */
    if (!(fabs(sum) > 1e-12) || !(fabs(sum) < 1e12))
    {
        nearest_side(corners, count, x, weights);
        return;
    }
    for (int32_t i = 0; i < count; ++i)
        weights[i] /= sum;
}

/* continuation.c -- the placement that continues what is textured.
 *
 * Where one chart goes on over a border, or several that continue each other,
 * there is a placement without any seam. The search finds it to a fraction of
 * a texel; here it is computed exactly, so that a developable surface comes out
 * as one piece. */
#include "patch/continuation.h"

double
otx_continuation_angle(const otx_mask *mask)
{
    otx_vec2 turn = {0, 0};

    for (int32_t i = 0; i < mask->triangle_count; ++i)
    {
        const otx_mask_triangle *t = &mask->triangles[i];

        for (int k = 1; k < 3 && !t->from; ++k)
        {
            const otx_vec2 a = otx_vec2_sub(t->flat[k], t->flat[0]);
            const otx_vec2 b = otx_vec2_sub(t->source[k], t->source[0]);

            turn = otx_vec2_add(
                turn,
                otx_vec2_scale(
                    t->weight[0], otx_vec2_mul((otx_vec2){a.x, -a.y}, b)));
        }
    }
    return atan2(turn.y, turn.x);
}

/* x without the whole pictures in it, nearest to 0. */
static double
within_picture(double x, bool wraps, double size)
{
    return wraps ? x - size * nearbyint(x / size) : x;
}

/* The first triangle of the exemplar that is searched; NULL when all are of
 * others. */
static const otx_mask_triangle *
first_own(const otx_mask *mask)
{
    for (int32_t i = 0; i < mask->triangle_count; ++i)
        if (!mask->triangles[i].from)
            return &mask->triangles[i];
    return NULL;
}

/* Mean shift over the mask. Neighbours may lie whole pictures apart, so it is
 * taken relative to the first triangle's. */
static otx_vec2
mean_shift(
    const otx_exemplar *e, const otx_mask *mask, const otx_mask_triangle *first,
    otx_vec2 turn)
{
    const otx_vec2 origin =
        otx_vec2_sub(first->source[0], otx_vec2_mul(turn, first->flat[0]));
    otx_vec2 sum = {0, 0};
    double weight = 0.0;

    for (int32_t i = 0; i < mask->triangle_count; ++i)
        for (int k = 0; k < 3 && !mask->triangles[i].from; ++k)
        {
            const otx_mask_triangle *t = &mask->triangles[i];
            const otx_vec2 d = otx_vec2_sub(
                otx_vec2_sub(t->source[k], otx_vec2_mul(turn, t->flat[k])),
                origin);

            sum.x +=
                t->weight[k] * within_picture(d.x, e->wrap_x, e->match.width);
            sum.y +=
                t->weight[k] * within_picture(d.y, e->wrap_y, e->match.height);
            weight += t->weight[k];
        }
    return weight > 0.0
               ? otx_vec2_add(origin, otx_vec2_scale(1.0 / weight, sum))
               : origin;
}

bool
otx_continuation_place(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out)
{
    const otx_exemplar *e = supply->exemplar;
    const otx_mask_triangle *first = first_own(mask);
    const double angle = otx_continuation_angle(mask);
    const otx_vec2 turn = otx_vec2_polar(angle);
    otx_vec2 shift;

    if (!first)
        return false;
    shift = mean_shift(e, mask, first, turn);
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 p = otx_vec2_add(otx_vec2_mul(turn, points[i]), shift);

        if ((!e->wrap_x && !(p.x >= 0.5 && p.x <= e->match.width - 0.5)) ||
            (!e->wrap_y && !(p.y >= 0.5 && p.y <= e->match.height - 0.5)))
            return false;
    }
    *out = (otx_match){angle, shift, 0.0};
    return true;
}

bool
otx_continuation_match(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out)
{
    if (!otx_continuation_place(supply, mask, points, count, out))
        return false;
    out->error = otx_matcher_score(supply->matcher, mask, out);
    return isfinite(out->error);
}

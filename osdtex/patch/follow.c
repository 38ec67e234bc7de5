/* follow.c -- patches that follow a field.
 *
 * A patch is laid with one orientation, the field turns across it: the mean of
 * the field over the patch is what it can follow. See docs/notes/field.md. */
#include "patch/follow.h"

static const double DEGREE = OTX_PI / 180.0;

/* Orientations about the mean that are searched, degrees. */
static const double SPREAD[] = {0.0, -5.0, 5.0};

/* How far an orientation that continues the neighbours may depart, degrees. */
static const double LEEWAY = 8.0;

/* A vector of the surface on a chart face, carried into the plane by the
 * face's first fan triangle. */
static otx_vec2
carry(const otx_mosaic *m, const otx_chart *chart, int32_t i, otx_vec3 v)
{
    const int32_t *c = chart->corners + chart->first[i];
    otx_vec3 p[3];
    otx_vec2 q[3];
    otx_vec3 a, b;
    double aa, ab, bb, va, vb, det;

    for (int k = 0; k < 3; ++k)
    {
        p[k] = otx_vec3_load(m->job.surface->points, chart->verts[c[k]]);
        q[k] = chart->flat[c[k]];
    }
    a = otx_vec3_sub(p[1], p[0]);
    b = otx_vec3_sub(p[2], p[0]);
    aa = otx_vec3_dot(a, a);
    ab = otx_vec3_dot(a, b);
    bb = otx_vec3_dot(b, b);
    va = otx_vec3_dot(v, a);
    vb = otx_vec3_dot(v, b);
    det = aa * bb - ab * ab;
    if (!(det > 0.0))
        return (otx_vec2){0, 0};
    return otx_vec2_add(
        otx_vec2_scale((va * bb - vb * ab) / det, otx_vec2_sub(q[1], q[0])),
        otx_vec2_scale((vb * aa - va * ab) / det, otx_vec2_sub(q[2], q[0])));
}

/* Angle in the chart of the mean: that of directions of symmetry s is that of
 * their s-th powers. */
static double
mean_direction(const otx_mosaic *m, const otx_node *node)
{
    const otx_guide *guide = otx_supply_of(m, node)->guide;
    const otx_chart *chart = &node->chart;
    otx_vec2 sum = {0, 0};

    for (int32_t i = 0; i < chart->core_count; ++i)
    {
        const int32_t face = chart->faces[i];
        const otx_vec2 d = carry(m, chart, i, guide->directions[face]);

        if (otx_vec2_dot(d, d) > 0.0)
            sum = otx_vec2_add(
                sum, otx_vec2_scale(
                         m->job.leaves.areas[face],
                         otx_vec2_polar(guide->symmetry * atan2(d.y, d.x))));
    }
    return atan2(sum.y, sum.x) / guide->symmetry;
}

int32_t
otx_follow_angles(
    const otx_mosaic *m, const otx_node *node, double continuing,
    double *angles)
{
    const otx_guide *guide = otx_supply_of(m, node)->guide;
    const double sector = 2.0 * OTX_PI / guide->symmetry;
    const double mean = guide->angle - mean_direction(m, node);
    const double off = remainder(continuing - mean, sector);
    int32_t count = 0;

    for (int32_t k = 0; k < guide->symmetry; ++k)
        for (size_t i = 0; i < sizeof SPREAD / sizeof SPREAD[0]; ++i)
            angles[count++] = mean + k * sector + SPREAD[i] * DEGREE;
    if (isfinite(continuing) && fabs(off) <= LEEWAY * DEGREE)
        angles[count++] = continuing;
    return count;
}

bool
otx_follow_allows(const otx_mosaic *m, const otx_node *node, double angle)
{
    const otx_guide *guide = otx_supply_of(m, node)->guide;

    return !guide || fabs(remainder(
                         angle - guide->angle + mean_direction(m, node),
                         2.0 * OTX_PI / guide->symmetry)) <= LEEWAY * DEGREE;
}

double
otx_follow_deviation(const otx_mosaic *m, const otx_node *node, int32_t i)
{
    const otx_guide *guide = otx_supply_of(m, node)->guide;
    const otx_vec2 d =
        carry(m, &node->chart, i, guide->directions[node->chart.faces[i]]);

    if (!(otx_vec2_dot(d, d) > 0.0))
        return 0.0;
    return fabs(remainder(
        atan2(d.y, d.x) + node->placed.angle - guide->angle,
        2.0 * OTX_PI / guide->symmetry));
}

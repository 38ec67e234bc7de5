/* alignment.c -- how well a mapping lies along the field that it follows. */
#include "mapping/alignment.h"

#include "mapping/source.h"

#include <stdlib.h>

typedef struct weighed
{
    double value, weight;
} weighed;

typedef struct survey
{
    const otx_mapping *mapping;
    const otx_level *leaf;
    otx_vec2 unit; /* scene units of one unit of u and of v */
    int32_t count;
    weighed *angles, *scales; /* [count] */
} survey;

static int
compare(const void *a, const void *b)
{
    const weighed *p = a, *q = b;

    if (p->value != q->value)
        return p->value < q->value ? -1 : 1;
    return (p->weight > q->weight) - (p->weight < q->weight);
}

/* The least value that `share` of the weight does not exceed. Of sorted
 * items. */
static double
quantile(const weighed *items, int32_t count, double share)
{
    double total = 0.0, sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
        total += items[i].weight;
    for (int32_t i = 0; i < count; ++i)
    {
        sum += items[i].weight;
        if (sum >= share * total)
            return items[i].value;
    }
    return 0.0;
}

static otx_vec2
corner_uv(const survey *s, int32_t corner)
{
    const float *uv = s->mapping->uvs + 2 * (size_t)corner;

    return (otx_vec2){s->unit.x * uv[0], s->unit.y * uv[1]};
}

/* One triangle of the fan: q = edges in the picture, p = on the surface. The
 * exemplar's direction e = x q0 + y q1 lies on the surface as x p0 + y p1. */
static void
add_triangle(
    survey *s, const otx_vec3 p[2], const otx_vec2 q[2], otx_vec3 direction)
{
    const otx_guide *guide = s->mapping->guide;
    const otx_vec2 e = otx_vec2_polar(guide->angle);
    const otx_vec3 normal = otx_vec3_cross(p[0], p[1]);
    const double area = 0.5 * otx_vec3_length(normal);
    const double det = otx_vec2_cross(q[0], q[1]);
    const double sector = 2.0 * OTX_PI / guide->symmetry;
    otx_vec3 lies;
    double angle;

    if (!(area > 0.0) || !(det > 0.0))
        return;
    lies = otx_vec3_mix(
        otx_vec2_cross(e, q[1]) / det, p[0], otx_vec2_cross(q[0], e) / det,
        p[1]);
    angle = atan2(
        otx_vec3_dot(otx_vec3_cross(direction, lies), otx_vec3_unit(normal)),
        otx_vec3_dot(direction, lies));
    s->angles[s->count] = (weighed){fabs(remainder(angle, sector)), area};
    s->scales[s->count++] = (weighed){sqrt(2.0 * area / det), area};
}

static void
add_face(survey *s, int32_t face)
{
    const int32_t first = s->leaf->face_first[face];
    const float *points = s->mapping->surface->points;

    for (int32_t c = first + 1; c + 1 < s->leaf->face_first[face + 1]; ++c)
    {
        otx_vec3 p[2];
        otx_vec2 q[2];

        for (int k = 0; k < 2; ++k)
        {
            p[k] = otx_vec3_sub(
                otx_vec3_load(points, s->leaf->face_verts[c + k]),
                otx_vec3_load(points, s->leaf->face_verts[first]));
            q[k] = otx_vec2_sub(corner_uv(s, c + k), corner_uv(s, first));
        }
        add_triangle(s, p, q, s->mapping->guide->directions[face]);
    }
}

static void
sum_up(survey *s, otx_alignment *out)
{
    double sum = 0.0, weight = 0.0;

    for (int32_t i = 0; i < s->count; ++i)
    {
        sum += s->angles[i].value * s->angles[i].weight;
        weight += s->angles[i].weight;
    }
    qsort(s->angles, (size_t)s->count, sizeof *s->angles, compare);
    qsort(s->scales, (size_t)s->count, sizeof *s->scales, compare);
    *out = (otx_alignment){
        .angle_mean = weight > 0.0 ? sum / weight : 0.0,
        .angle_p50 = quantile(s->angles, s->count, 0.5),
        .angle_p95 = quantile(s->angles, s->count, 0.95),
        .scale_p01 = quantile(s->scales, s->count, 0.01),
        .scale_p50 = quantile(s->scales, s->count, 0.5),
        .scale_p99 = quantile(s->scales, s->count, 0.99),
    };
}

otx_status
otx_alignment_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    otx_alignment *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_image *image = &exemplar->linear;
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    survey s = {
        .mapping = mapping,
        .leaf = leaf,
        .unit = {mapping->scale, mapping->scale * image->height / image->width},
        .angles = OTX_NEW(run->scratch, weighed, leaf->corner_count),
        .scales = OTX_NEW(run->scratch, weighed, leaf->corner_count),
    };

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f] && mapping->face_patch[f] >= 0 &&
            otx_source_of(mapping, f) == 0)
            add_face(&s, f);
    sum_up(&s, out);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

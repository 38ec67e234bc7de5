/* carry.c -- normals and heights from the picture's frame to a texture's. */
#include "mapping/carry.h"

#include "mapping/source.h"

#include <math.h>

/* Twice the area of a leaf face as a fan, on the surface and in its picture in
 * scene units. */
static void
measure_face(
    const otx_mapping *mapping, int32_t face, otx_vec2 unit, double areas[2])
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const float *points = mapping->surface->points;
    const int32_t first = leaf->face_first[face];
    const int32_t end = leaf->face_first[face + 1];
    otx_vec3 sum = {0.0, 0.0, 0.0};
    double in_picture = 0.0;

    for (int32_t c = first + 1; c + 1 < end; ++c)
    {
        const otx_vec3 p = otx_vec3_load(points, leaf->face_verts[first]);
        const float *a = mapping->uvs + 2 * (size_t)first;
        const float *b = mapping->uvs + 2 * (size_t)c;

        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(points, leaf->face_verts[c]), p),
                otx_vec3_sub(
                    otx_vec3_load(points, leaf->face_verts[c + 1]), p)));
        in_picture += ((double)b[0] - a[0]) * ((double)b[3] - a[1]) -
                      ((double)b[1] - a[1]) * ((double)b[2] - a[0]);
    }
    areas[0] = otx_vec3_length(sum);
    areas[1] = fabs(in_picture) * unit.x * unit.y;
}

otx_status
otx_carry_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const float **out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    float *scale = OTX_NEW(run->arena, float, leaf->vert_count);
    double *sums = OTX_ZNEW(run->scratch, double, 2 * (size_t)leaf->vert_count);

    if (!scale || !sums)
        return otx_fail_memory(run, "bake");
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        double areas[2];

        if (mapping->face_patch[f] < 0)
            continue;
        measure_face(
            mapping, f,
            otx_source_unit(mapping, exemplars, otx_source_of(mapping, f)),
            areas);
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
            for (int i = 0; i < 2; ++i)
                sums[2 * (size_t)leaf->face_verts[c] + (size_t)i] += areas[i];
    }
    for (int32_t v = 0; v < leaf->vert_count; ++v)
    {
        const double *s = sums + 2 * (size_t)v;

        scale[v] = s[0] > 0.0 && s[1] > 0.0 ? (float)sqrt(s[0] / s[1]) : 1.0f;
    }
    otx_arena_release(run->scratch, mark);
    *out = scale;
    return OSDTEX_OK;
}

/* A change of places on the surface. */
static otx_vec3
change_of(const otx_vec3 p[3], const double *w)
{
    otx_vec3 sum = otx_vec3_scale(w[0], p[0]);

    sum = otx_vec3_add(sum, otx_vec3_scale(w[1], p[1]));
    return otx_vec3_add(sum, otx_vec3_scale(w[2], p[2]));
}

otx_carry_matrix
otx_carry_matrix_of(
    const otx_carry *carry, const int32_t *corners, const otx_vec2 uvs[3],
    int32_t exemplar, const double *dx, const double *dy)
{
    const otx_level *leaf = otx_surface_leaf(carry->surface);
    const otx_vec2 unit = carry->units[exemplar];
    otx_vec2 e[2], f[2];
    otx_vec3 p[3];

    for (int k = 0; k < 3; ++k)
        p[k] =
            otx_vec3_load(carry->surface->points, leaf->face_verts[corners[k]]);

    const otx_vec3 x = otx_vec3_unit(change_of(p, dx));
    const otx_vec3 across = change_of(p, dy);
    const otx_vec3 y = otx_vec3_unit(
        otx_vec3_sub(across, otx_vec3_scale(otx_vec3_dot(across, x), x)));

    for (int k = 0; k < 2; ++k)
    {
        const otx_vec3 side = otx_vec3_sub(p[k + 1], p[0]);
        const otx_vec2 uv = otx_vec2_sub(uvs[k + 1], uvs[0]);

        e[k] = (otx_vec2){uv.x * unit.x, uv.y * unit.y};
        f[k] = (otx_vec2){otx_vec3_dot(side, x), otx_vec3_dot(side, y)};
    }

    const double area2 = otx_vec2_cross(f[0], f[1]);

    /* Written so that NaN lands here too. */
    if (!(fabs(area2) > 0.0))
        return (otx_carry_matrix){1.0, 0.0, 0.0, 1.0};
    return (otx_carry_matrix){
        (f[1].y * e[0].x - f[0].y * e[1].x) / area2,
        (f[1].y * e[0].y - f[0].y * e[1].y) / area2,
        (f[0].x * e[1].x - f[1].x * e[0].x) / area2,
        (f[0].x * e[1].y - f[1].x * e[0].y) / area2};
}

double
otx_carry_scale(
    const otx_carry *carry, const int32_t *corners, const double *at)
{
    const int32_t *verts = otx_surface_leaf(carry->surface)->face_verts;
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
        sum += at[k] * (double)carry->scale[verts[corners[k]]];
    return sum;
}

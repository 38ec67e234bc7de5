/* laid_face.c -- a leaf face laid into its plane, beside its UVs. */
#include "mapping/laid_face.h"

#include "mapping/seam.h"

double
otx_laid_face_area(const otx_vec2 *points, int32_t count)
{
    double area2 = 0.0;

    for (int32_t k = 1; k + 1 < count; ++k)
        area2 += otx_vec2_cross(
            otx_vec2_sub(points[k], points[0]),
            otx_vec2_sub(points[k + 1], points[0]));
    return 0.5 * area2;
}

/* Unit vectors of the face's plane, e1 x e2 along the sum of its fan's cross
 * products. False when the face has no area. */
static bool
face_plane(const otx_surface *surface, int32_t face, otx_vec3 *e1, otx_vec3 *e2)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const float *points = surface->points;
    const int32_t *verts = leaf->face_verts + leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const otx_vec3 origin = otx_vec3_load(points, verts[0]);
    otx_vec3 normal = {0.0, 0.0, 0.0}, longest = {0.0, 0.0, 0.0};

    for (int32_t k = 1; k < size; ++k)
    {
        const otx_vec3 a =
            otx_vec3_sub(otx_vec3_load(points, verts[k]), origin);

        if (otx_vec3_dot(a, a) > otx_vec3_dot(longest, longest))
            longest = a;
        if (k + 1 < size)
            normal = otx_vec3_add(
                normal,
                otx_vec3_cross(
                    a,
                    otx_vec3_sub(otx_vec3_load(points, verts[k + 1]), origin)));
    }
    normal = otx_vec3_unit(normal);

    const double along = otx_vec3_dot(longest, normal);

    *e1 = otx_vec3_unit(otx_vec3_mix(1.0, longest, -along, normal));
    *e2 = otx_vec3_cross(normal, *e1);
    return otx_vec3_dot(*e2, *e2) > 0.5;
}

void
otx_laid_face_set(
    const otx_mapping *mapping, const otx_exemplar *exemplar,
    double texels_per_unit, int32_t face, otx_laid_face *out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const int32_t first = leaf->face_first[face];
    const int32_t *verts = leaf->face_verts + first;
    const float *points = mapping->surface->points;
    const int32_t size = otx_level_face_size(leaf, face);
    otx_vec3 e1, e2;
    const bool flat = face_plane(mapping->surface, face, &e1, &e2);
    const double density = otx_surface_density(mapping->surface, verts, size);

    out->size = size < OTX_LAID_FACE_CORNERS ? size : OTX_LAID_FACE_CORNERS;
    for (int32_t k = 0; k < out->size; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(points, verts[k]), otx_vec3_load(points, verts[0]));

        out->p[k] =
            flat ? otx_vec2_scale(
                       density,
                       (otx_vec2){otx_vec3_dot(d, e1), otx_vec3_dot(d, e2)})
                 : (otx_vec2){0.0, 0.0};
        out->q[k] = otx_vec2_scale(
            1.0 / texels_per_unit,
            otx_seam_texel(mapping, exemplar, first + k));
    }
}

bool
otx_laid_face_is_folded(const otx_laid_face *face)
{
    for (int32_t k = 0; k < face->size; ++k)
    {
        const int32_t n = (k + 1) % face->size;
        const int32_t m = (k + 2) % face->size;
        const double surface = otx_vec2_cross(
            otx_vec2_sub(face->p[n], face->p[k]),
            otx_vec2_sub(face->p[m], face->p[n]));
        const double uv = otx_vec2_cross(
            otx_vec2_sub(face->q[n], face->q[k]),
            otx_vec2_sub(face->q[m], face->q[n]));

        if (surface > 0.0 && uv < 0.0)
            return true;
    }
    return false;
}

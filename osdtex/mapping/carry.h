/* carry.h -- normals and heights from the picture's frame to a texture's.
 *
 * A normal of a map is told in the frame of its picture, which lies on the
 * surface at any angle and is stretched there. What is baked is told in the
 * frame of the texture that it goes to: x along its rows, as they run over the
 * surface, y across them, both orthonormal, as renderers have it. A slope g of
 * the picture is J^-T g of the surface, J the change of places on the surface
 * by places in the picture; heights grow with the local scale s of the mapping,
 * and slopes with them: s J^-T g. See docs/notes/materials.md. */
#ifndef OTX_MAPPING_CARRY_H
#define OTX_MAPPING_CARRY_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

typedef struct otx_carry
{
    const otx_surface *surface;
    /* [leaf vert_count] how many times its nominal size the texture has there:
     * a surface's own, so that it is the same from all sides. */
    const float *scale;
    int32_t normal, height;            /* first channels; -1 none */
    otx_vec2 units[OTX_EXEMPLARS_MAX]; /* scene units of u and of v */
    otx_companion_scale heights[OTX_EXEMPLARS_MAX];
} otx_carry;

/* The change of slopes in a triangle: rows of s J^-T but for s. */
typedef struct otx_carry_matrix
{
    double xx, xy, yx, yy;
} otx_carry_matrix;

/* Measures the local scale of a mapping at its leaf vertices: the root of the
 * area around one by that which it has in the picture; 1 where there is none.
 * [leaf vert_count] in run->arena. MEMORY. */
otx_status otx_carry_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const float **out);

/* The matrix of a triangle.
 *
 *   corners  [3] of the leaf level
 *   uvs      of the corners, in exemplar `exemplar`
 *   dx, dy   [3] barycentric, sum 0: changes along the texture's x and y */
otx_carry_matrix otx_carry_matrix_of(
    const otx_carry *carry, const int32_t *corners, const otx_vec2 uvs[3],
    int32_t exemplar, const double *dx, const double *dy);

/* The local scale at barycentric coordinates of a triangle. */
double otx_carry_scale(
    const otx_carry *carry, const int32_t *corners, const double *at);

/* Carries the values of a lookup over.
 *
 *   scale  local, there */
static inline void
otx_carry_values(
    const otx_carry *carry, const otx_carry_matrix *m, double scale,
    int32_t exemplar, float *values)
{
    if (carry->normal >= 0)
    {
        float *n = values + carry->normal;
        const double x = n[0], y = n[1];

        n[0] = (float)(scale * (m->xx * x + m->xy * y));
        n[1] = (float)(scale * (m->yx * x + m->yy * y));
    }
    if (carry->height >= 0)
    {
        const otx_companion_scale *h = &carry->heights[exemplar];
        float *value = values + carry->height;

        *value = (float)((*value - h->middle) * h->range * scale);
    }
}

#endif

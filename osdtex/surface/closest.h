/* closest.h -- the point of a surface that is nearest to another one.
 *
 * A tree of boxes over the leaf faces, for many questions about one surface. */
#ifndef OTX_SURFACE_CLOSEST_H
#define OTX_SURFACE_CLOSEST_H

#include "math/vec.h"
#include "surface/facet.h"
#include "surface/surface.h"

/* In the order of a curve that fills space, faces lie in buckets; node n has
 * the children 2n and 2n + 1, the root is 1 and the buckets come last. */
typedef struct otx_closest
{
    const otx_surface *surface;
    const int32_t *faces; /* [face_count] of the leaf level, holes left out */
    const float *boxes;   /* [2 * bucket_count * 6] low and high of nodes */
    int32_t face_count;
    int32_t bucket_count; /* a power of two */
} otx_closest;

/* In run->arena; borrows the surface, of which points and leaf level are read.
 * MEMORY. */
otx_status
otx_closest_build(otx_run *run, const otx_surface *surface, otx_closest *out);

typedef struct otx_closest_ask
{
    otx_vec3 point;
    otx_vec3 normal; /* facets turned away from it by less than 60 degrees are
                      * meant; zero: all */
    double reach;    /* scene units; what is farther does not count */
    const int32_t *labels; /* [leaf face_count] NULL: all faces are meant */
    int32_t label;         /* else those that have this one */
} otx_closest_ask;

typedef struct otx_closest_place
{
    int32_t face;       /* of the leaf level; -1: there is none */
    int32_t corners[3]; /* of the level, a facet of that face */
    double at[3];       /* barycentric, sum 1, none negative */
    double distance;    /* scene units */
} otx_closest_place;

/* Of equally near ones the first in the order of the tree. */
otx_closest_place
otx_closest_find(const otx_closest *tree, const otx_closest_ask *ask);

/* The corners of a facet as they lie on a surface. */
static inline void
otx_closest_corners(
    const otx_surface *surface, const int32_t corners[3], otx_vec3 out[3])
{
    const int32_t *verts = otx_surface_leaf(surface)->face_verts;

    for (int k = 0; k < 3; ++k)
        out[k] = otx_vec3_load(surface->points, verts[corners[k]]);
}

/* Barycentric coordinates of the point of a triangle that is nearest to p, and
 * its distance. */
double otx_closest_on(otx_vec3 p, const otx_vec3 triangle[3], double at[3]);

/* Those of the point of the triangle's plane that is below p, which may lie
 * outside of it; false where it has no area. */
bool otx_closest_below(otx_vec3 p, const otx_vec3 triangle[3], double at[3]);

#endif

/* dual.h -- a level seen through its faces: area, centroid, normal.
 *
 * All of it is measured on the limit surface below each face, so that clusters
 * of different levels speak of the same shape. */
#ifndef OTX_CLUSTER_DUAL_H
#define OTX_CLUSTER_DUAL_H

#include "base/run.h"
#include "math/vec.h"
#include "surface/surface.h"

typedef struct otx_dual
{
    const otx_level *level;
    int32_t level_index;
    otx_vec3 *centroids; /* [face_count] */
    otx_vec3 *normals;   /* [face_count], unit; zero where there is no area */
    /* [face_count], scene units squared, 0 on holes; where the surface has a
     * density, times its square. */
    double *areas;
    double *densities; /* [face_count]; NULL: 1 */
} otx_dual;

/* In run->arena. MEMORY. */
otx_status otx_dual_build(
    otx_run *run, const otx_surface *surface, int32_t level, otx_dual *out);

/* Mean density at the corners of a leaf face. */
double otx_dual_leaf_density(const otx_surface *surface, int32_t face);

/* Twice the vector area of a leaf face and its centroid. */
otx_vec3 otx_dual_leaf_area(
    const otx_surface *surface, int32_t face, otx_vec3 *centroid);

/* Length, times density, of the step from one face to its neighbour, the way
 * through the middle of their common edge not being taken: |c_a - c_b|,
 * lengthened where the normals turn so that clusters prefer to end at bends and
 * creases.
 *
 *   bend  weight of the turn; 0 gives the plain distance */
double otx_dual_step(const otx_dual *dual, int32_t a, int32_t b, double bend);

#endif

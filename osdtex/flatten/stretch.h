/* stretch.h -- how far a flattening departs from isometry. */
#ifndef OTX_FLATTEN_STRETCH_H
#define OTX_FLATTEN_STRETCH_H

#include "math/vec.h"

/* Singular values of the linear map that takes a triangle on the surface to
 * its place in the plane, larger first. Both are positive for a map that keeps
 * orientation; the second is negative when the triangle is flipped, and 0 when
 * it has no area in the plane. A triangle without area on the surface has no
 * map: both are 1.
 *
 *   p   corners on the surface
 *   uv  the same corners in the plane, same unit */
void otx_stretch_singular(
    const otx_vec3 p[3], const otx_vec2 uv[3], double sigma[2]);

/* The triangle laid out in its own plane: q[0] at the origin, q[1] on the
 * positive x axis, counter-clockwise. */
void otx_stretch_layout(const otx_vec3 p[3], otx_vec2 q[3]);

#endif

/* attract.h -- what pulls a whole field: an axis, edge loops, curvature.
 *
 * A pull is, for each face, the s-th power of a direction (see direction.h),
 * as long as it is sure: 1 at most, 0 where it says nothing. */
#ifndef OTX_FIELD_ATTRACT_H
#define OTX_FIELD_ATTRACT_H

#include "field/direction.h"

/* The part of a vector along each face. [face_count] in run->arena. MEMORY. */
otx_status otx_attract_axis(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    otx_vec3 axis, otx_vec2 **out);

/* The edges of quads, which run along the cage's edge loops. Other faces say
 * nothing.
 *
 *   near  of the four ways a quad has, the one nearest to this field; crosses
 *         need none: NULL
 */
otx_status otx_attract_edges(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const otx_direction *near, otx_vec2 **out);

/* The way in which the surface bends least, as along a limb; for crosses both
 * principal directions. Surer the more the two curvatures differ.
 *
 *   near  for arrows, which of the two ways of the line; else NULL
 */
otx_status otx_attract_curvature(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const otx_direction *near, otx_vec2 **out);

#endif

/* polygon.h -- control polygons of face clusters, laid out in the plane
 * [Soler02, sec. 3.2], and coordinates inside a polygon. */
#ifndef OTX_FLATTEN_POLYGON_H
#define OTX_FLATTEN_POLYGON_H

#include "base/arena.h"
#include "math/vec.h"

/* Lays a closed polygon out in the plane, counter-clockwise, corner 0 at the
 * origin and corner 1 on the positive x axis. Side lengths are kept; angles
 * are, in the least-squares sense, in proportion to those in space. A triangle
 * has no freedom, a quadrangle one (its diagonal).
 *
 *   points  [count] in space, count >= 3
 *   normal  unit, of the polygon's outside; tells hollow corners
 *   out     [count]
 *
 * MEMORY, without a finding. */
otx_status otx_polygon_layout(
    otx_arena *scratch, const otx_vec3 *points, int32_t count, otx_vec3 normal,
    otx_vec2 *out);

/* Mean value coordinates [Floater03] of `x` in a polygon; they sum to 1 and
 * reproduce x.
 *
 *   corners  [count] counter-clockwise
 *   weights  [count] out */
void otx_polygon_coordinates(
    const otx_vec2 *corners, int32_t count, otx_vec2 x, double *weights);

#endif

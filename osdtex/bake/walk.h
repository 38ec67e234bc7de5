/* walk.h -- going on across edges, on the surface.
 *
 * A point outside of a facet, given by barycentric coordinates of that facet,
 * is found on the facets around by unfolding them into one plane. So the
 * texels beside a border show what the surface beside it shows. */
#ifndef OTX_BAKE_WALK_H
#define OTX_BAKE_WALK_H

#include "math/vec.h"
#include "surface/facet.h"
#include "surface/surface.h"

/* A place on the surface, and where the texels beside it are. */
typedef struct otx_walk
{
    otx_facet facet;
    double at[3]; /* barycentric, sum 1 */
    double dx[3]; /* change from a texel to the next, sum 0 */
    double dy[3];
} otx_walk;

/* Moves `walk` to the facet that the place is in, in at most `steps`. Where
 * the surface ends (or `covered` is 0), the place is held at the edge.
 *
 *   covered  [leaf face_count] 1 where the surface has a texture
 *
 * Returns whether the place was reached or held: after `steps` it is not, and
 * the nearest point of the facet there is taken. */
bool otx_walk_on(
    const otx_surface *surface, const uint8_t *covered, int32_t steps,
    otx_walk *walk);

/* Crosses side `side` of the facet, whatever is beyond: coordinates of the
 * neighbour, which may be negative. False where there is none. */
bool otx_walk_cross(
    const otx_surface *surface, const uint8_t *covered, int32_t side,
    otx_walk *walk);

/* The side that barycentric coordinates are farthest beyond; -1 inside. */
int32_t otx_walk_side_beyond(const double at[3]);

#endif

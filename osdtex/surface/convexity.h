/* convexity.h -- where a surface is a ridge and where a hollow. */
#ifndef OTX_SURFACE_CONVEXITY_H
#define OTX_SURFACE_CONVEXITY_H

#include "base/run.h"
#include "surface/surface.h"

/* The mean curvature of the leaf vertices, each the mean of what its edges say
 * [Taubin95], and then smoothed along edges.
 *
 *   radius  scene units that it is smoothed over, about
 *   out     [leaf vert_count] 1 / scene unit, above 0 where the surface is
 *           convex as seen from outside
 *
 * CANCELLED, MEMORY. */
otx_status otx_convexity(
    otx_run *run, const otx_surface *surface, double radius, double *out);

#endif

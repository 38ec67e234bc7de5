/* plain.h -- a mesh that is not subdivided is a surface of one level. */
#ifndef OTX_SURFACE_PLAIN_H
#define OTX_SURFACE_PLAIN_H

#include "surface/surface.h"

/* As otx_refine_cage of surface/refine.h; the tangents are zero. A cage that is
 * no manifold is severed (surface/sever.h): its level has more vertices than
 * the cage then, the cage's first, and the same faces. */
otx_status otx_plain_cage(
    otx_run *run, const otx_cage *cage, otx_surface *out, float **tangents);

#endif

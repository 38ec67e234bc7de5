/* refine.h -- the levels and the limit of a cage, through OpenSubdiv. */
#ifndef OTX_SURFACE_REFINE_H
#define OTX_SURFACE_REFINE_H

#include "surface/surface.h"

/* Fills all of `out` but its normals, area and mean edge length.
 *
 *   tangents  the array behind out->tangents, still as OpenSubdiv leaves it:
 *             neither unit nor orthogonal, zero where there is none
 *
 * OpenSubdiv's own memory is given back before the return. */
otx_status otx_refine_cage(
    otx_run *run, const otx_cage *cage, int32_t level, otx_surface *out,
    float **tangents);

#endif

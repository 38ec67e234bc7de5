/* fvar_linear.h -- texture coordinates of the cage's corners, on the leaves. */
#ifndef OTX_BAKE_FVAR_LINEAR_H
#define OTX_BAKE_FVAR_LINEAR_H

#include "surface/surface.h"

/* Carries coordinates down the levels by the rule "linear all": a new vertex
 * of an edge has the mean of its ends, that of a face the mean of its corners,
 * in each face by itself. So no smoothing is involved, and every program that
 * subdivides the cage by that rule has the same coordinates.
 *
 *   cage_uvs  [cage corner_count * 2]
 *   leaf_uvs  [leaf corner_count * 2], out
 *
 * MEMORY. */
otx_status otx_fvar_linear(
    otx_run *run, const otx_surface *surface, const float *cage_uvs,
    float *leaf_uvs);

#endif

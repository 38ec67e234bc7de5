/* recursive.h -- flattening down the subdivision hierarchy [Soler02, sec. 3.2].
 *
 * The corners of a subdivision patch are laid out as its control polygon;
 * every vertex that is born below is placed relative to its parents, down to
 * the leaves. Nothing is solved for, and an edge is placed by its two ends
 * alone, so the two sides of an edge agree whatever lies beyond: no cracks.
 * Faithful while the patch is nearly flat, which the flatness test sees to.
 * See docs/notes/flatten.md. */
#ifndef OTX_FLATTEN_RECURSIVE_H
#define OTX_FLATTEN_RECURSIVE_H

#include "flatten/chart.h"

/* The chart of the patch below `face` of `level`, as otx_chart_build makes it
 * of any set of leaves, with these differences. The collar is made of the
 * patches across the face's edges, each flattened alone and laid against the
 * common edge. `reach` is measured by position values: 0 on the common edge, 1
 * (times the size of the patch in texels) at the other corners of the
 * neighbour. `distortion` is 1 + E_flat, with E_flat = |r - 1| and r the ratio
 * of the area on the surface to the area in the plane.
 *
 * A leaf vertex may have several chart vertices, one for each patch that it
 * borders on away from a common edge.
 *
 * MEMORY, without a finding. */
otx_status otx_recursive_build(
    const otx_chart_request *request, int32_t level, int32_t face,
    otx_chart_space *space, otx_arena *scratch, otx_arena *arena,
    otx_chart *out);

#endif

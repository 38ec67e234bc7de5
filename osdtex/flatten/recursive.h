/* recursive.h -- flattening down the hierarchy of clusters [Soler02, sec. 3.2].
 *
 * The control vertices of a cluster, corners of a subdivision patch, are laid
 * out as its control polygon;
 * every vertex that is born below is placed relative to its parents, down to
 * the leaves. Nothing is solved for, and an edge is placed by its two ends
 * alone, so the two sides of an edge agree whatever lies beyond: no cracks.
 * Faithful while the patch is nearly flat, which the flatness test sees to.
 * See docs/notes/flatten.md. */
#ifndef OTX_FLATTEN_RECURSIVE_H
#define OTX_FLATTEN_RECURSIVE_H

#include "cluster/controls.h"
#include "flatten/chart.h"

/* The chart of a cluster, one face of any level or a region, as otx_chart_build
 * makes it of any set of leaves, with these differences. The collar is made of
 * the clusters of the same level across its sides, each flattened alone and
 * laid against the common side. `reach` is measured by position values: 0 on
 * the common side, 1 (times the size of the cluster in texels) at the other
 * control vertices of the neighbour. `distortion` is 1 + E_flat, with E_flat =
 * |r - 1| and r the ratio of the area on the surface to the area in the plane;
 * INFINITY, and the chart empty, where a region has fewer than three control
 * vertices.
 *
 * A leaf vertex may have several chart vertices, one for each cluster that it
 * borders on away from a common side.
 *
 *   controls  of the tree that regions are from; NULL: of single faces alone
 *
 * MEMORY, without a finding. */
otx_status otx_recursive_build(
    const otx_chart_request *request, const otx_controls *controls,
    const otx_cluster *cluster, otx_chart_space *space, otx_arena *scratch,
    otx_arena *arena, otx_chart *out);

#endif

/* region.h -- the vertices below a region, parents first [Soler02, sec. 3.2].
 *
 * What descent.h is to a face: a region's control vertices are given; those of
 * the clusters that it is divided in lie on its sides or inside it, theirs on
 * their sides or inside them, and so on to single faces and the leaves. */
#ifndef OTX_FLATTEN_REGION_H
#define OTX_FLATTEN_REGION_H

#include "cluster/controls.h"
#include "flatten/descent.h"

/* Visits every vertex below a node that is no control vertex of it, once each
 * down to single faces, and then as otx_descent_walk does.
 *
 *   slot     [leaf vert_count] numbers of the vertices below the node
 *   count    of those
 *   visitor  edge: of vertices on sides of regions, too
 *   inside   of a vertex inside a region, with the region's control vertices
 *            in order
 *
 * MEMORY, without a finding. */
otx_status otx_region_walk(
    const otx_controls *controls, int32_t node, const int32_t *slot,
    int32_t count, const otx_descent *visitor,
    void (*inside)(void *, int32_t, const int32_t *, int32_t),
    otx_arena *scratch);

#endif

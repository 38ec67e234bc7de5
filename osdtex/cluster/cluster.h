/* cluster.h -- face clusters: connected sets of faces of one level.
 *
 * Two hierarchies meet here [Soler02, sec. 3.1]. Below a face of the cage the
 * clusters are the subdivision patches themselves; above it, and on plain
 * meshes, they are grown: seeds spread over the region, every face joins the
 * nearest, and seeds move to the middle of what they got until the borders are
 * regular. Splitting a cluster of several faces grows smaller ones inside it;
 * splitting a single face gives its children. */
#ifndef OTX_CLUSTER_CLUSTER_H
#define OTX_CLUSTER_CLUSTER_H

#include "cluster/dual.h"

typedef struct otx_cluster
{
    int32_t level; /* that the faces belong to */
    int32_t face_count;
    const int32_t *faces; /* ascending */
    double area;          /* scene units squared */
} otx_cluster;

typedef struct otx_cluster_list
{
    int32_t count;
    otx_cluster *clusters;
} otx_cluster_list;

/* Grows clusters of about `target_area` inside `region` (faces of
 * dual->level). Every face of the region that is not a hole lands in exactly
 * one cluster; every cluster is connected and, unless it is a single face, has
 * the topology of a disc. At least `minimum` clusters where the region has
 * that many faces.
 *
 *   bend  how much borders prefer bends, see otx_dual_step
 *
 * In run->arena. MEMORY. */
otx_status otx_cluster_grow(
    otx_run *run, const otx_dual *dual, const otx_cluster *region,
    double target_area, int32_t minimum, double bend, otx_cluster_list *out);

/* One cluster for each face of `level` that is not a hole. */
otx_status
otx_cluster_faces(otx_run *run, const otx_dual *dual, otx_cluster_list *out);

/* The children of a cluster of one face, at the next level; an empty list at
 * the last level. */
otx_status otx_cluster_children(
    otx_run *run, const otx_surface *surface, const otx_cluster *cluster,
    otx_cluster_list *out);

/* The leaf faces of a cluster, ascending, in `arena`; NULL when memory is out.
 */
int32_t *otx_cluster_leaves(
    otx_arena *arena, const otx_surface *surface, const otx_cluster *cluster,
    int32_t *count);

/* Whether a set of faces is a topological disc: connected through edges, no
 * pinched vertex, Euler characteristic 1.
 *
 *   member  [face_count] of the level, equal to `id` for the faces of the set
 */
bool otx_cluster_is_disc(
    otx_arena *scratch, const otx_level *level, const int32_t *faces,
    int32_t face_count, const int32_t *member, int32_t id);

#endif

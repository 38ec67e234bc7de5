/* cluster.h -- face clusters: connected sets of faces of one level.
 *
 * Two hierarchies meet here [Soler02, sec. 3.1]. Below a face of the cage the
 * clusters are the subdivision patches themselves; above it, and on plain
 * meshes, they are grown: seeds spread over the region, every face joins the
 * nearest, and seeds move to the middle of what they got until the borders are
 * regular. Splitting a cluster of several faces grows smaller ones inside it;
 * splitting a single face gives its children. tree.h keeps both as one. */
#ifndef OTX_CLUSTER_CLUSTER_H
#define OTX_CLUSTER_CLUSTER_H

#include "cluster/dual.h"

typedef struct otx_cluster
{
    int32_t level; /* that the faces belong to */
    int32_t face_count;
    const int32_t *faces; /* ascending, but for those of divided regions */
    double area;          /* scene units squared */
    int32_t node; /* in the tree that it is from (tree.h); -1 of a face below */
} otx_cluster;

typedef struct otx_cluster_list
{
    int32_t count;
    otx_cluster *clusters;
} otx_cluster_list;

/* What growth works with: made once, as it was found after each use. A growth
 * then costs what its region does, not what the level does. */
typedef struct otx_cluster_space
{
    int32_t *owner, *member; /* [level face_count] */
    double *distance;        /* [level face_count] */
} otx_cluster_space;

/* In run->arena. MEMORY. */
otx_status otx_cluster_space_create(
    otx_run *run, const otx_level *level, otx_cluster_space *out);

typedef struct otx_growing
{
    const otx_dual *dual;
    double bend; /* how much borders prefer bends, see otx_dual_step */
    otx_cluster_space *space; /* of dual->level */
} otx_growing;

/* Grows clusters of about `target_area` inside `region` (faces of
 * how->dual->level). Every face of the region that is not a hole lands in
 * exactly one cluster; every cluster is connected and, unless it is a single
 * face, has the topology of a disc. At least `minimum` clusters where the
 * region has that many faces. Takes about n log n for n faces of the region.
 *
 * In run->arena. MEMORY, CANCELLED. */
otx_status otx_cluster_grow(
    otx_run *run, const otx_growing *how, const otx_cluster *region,
    double target_area, int32_t minimum, otx_cluster_list *out);

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

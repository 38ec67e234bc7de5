/* controls.h -- borders of regions, and the control vertices on them
 * [Soler02, sec. 3.1].
 *
 * A control vertex of a level of the hierarchy is a vertex that at least three
 * clusters of the level share, what lies beyond the surface being one. Between
 * two of them a region has one neighbour: a side. Control vertices of a level
 * are control vertices of all later ones. Where a side bows out more than its
 * ends are apart can tell, the vertex farthest out becomes one as well, for
 * both who share the side; so every region has at least three, and they do not
 * lie on a line. Of a single face all corners are control vertices. */
#ifndef OTX_CLUSTER_CONTROLS_H
#define OTX_CLUSTER_CONTROLS_H

#include "cluster/tree.h"

/* Of a tree that is grown all the way. */
typedef struct otx_controls
{
    const otx_cluster_tree *tree;
    int32_t *vert_level; /* [base vert_count] of the hierarchy, from which on a
                          * vertex is a control vertex; INT32_MAX: never one of
                          * a region */
    int32_t *face_node;  /* [base face_count] the single face in the tree; -1
                          * not covered */
} otx_controls;

/* A closed border, counter-clockwise seen from outside. */
typedef struct otx_outline
{
    int32_t count;
    int32_t *verts;   /* [count] */
    int32_t *outside; /* [count] face beyond the edge from vertex i to i + 1; -1
                       * none */
    int32_t control_count;
    int32_t *controls; /* [control_count] indices into verts, ascending */
} otx_outline;

/* Divides all regions down to single faces, and finds control vertices. In
 * run->arena. MEMORY, CANCELLED. */
otx_status
otx_controls_find(otx_run *run, otx_cluster_tree *tree, otx_controls *out);

/* The border of a node that is a disc, with the control vertices of `level`.
 * Begins at a control vertex where there is one.
 *
 * In `arena`. MEMORY, without a finding. */
otx_status otx_outline_trace(
    const otx_controls *controls, int32_t node, int32_t level, otx_arena *arena,
    otx_outline *out);

/* The cluster of a level that has a face: a node of that level, or a single
 * face that stands for itself; -1 where the face is not covered. */
int32_t
otx_controls_cluster(const otx_controls *controls, int32_t face, int32_t level);

#endif

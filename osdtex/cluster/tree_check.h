/* tree_check.h -- what holds of the hierarchy of clusters at any time. */
#ifndef OTX_CLUSTER_TREE_CHECK_H
#define OTX_CLUSTER_TREE_CHECK_H

#include "cluster/tree.h"

/* NULL when the hierarchy is sound, else what is not, for assert():
 *
 * - a node's children have it as parent, are of a later level, share its faces
 *   out among them, range by range, and have its area;
 * - regions are above face_level;
 * - faces ascend in what is not divided; none is a hole, none comes twice;
 * - every region, but for the whole, is a disc.
 *
 * Takes n log n of the faces of all regions. In builds with assertions alone.
 */
const char *
otx_cluster_tree_check(const otx_cluster_tree *tree, otx_arena *scratch);

#endif

/* forest_check.h -- what holds of the hierarchy of clusters at any time.
 *
 * Builds with assertions check it after each time that it grew. */
#ifndef OTX_PATCH_FOREST_CHECK_H
#define OTX_PATCH_FOREST_CHECK_H

#include "patch/mosaic.h"

/* NULL when the hierarchy is sound, else what is not, for assert():
 *
 * - that of cluster/tree_check.h;
 * - leaves of a cluster ascend, and none is a hole;
 * - the clusters that are not retired share all their leaves out among them,
 *   and each leaf knows its own;
 * - a cluster that became a patch and the patch know one another. */
const char *otx_forest_check(const otx_mosaic *m);

#endif

/* forest_check.c -- what holds of the hierarchy of clusters at any time. */
#include "patch/forest_check.h"

#include "cluster/tree_check.h"

static const char *
check_node(const otx_mosaic *m, int32_t index)
{
    const otx_level *leaf = m->job.leaves.level;
    const otx_node *node = &m->forest.nodes[index];

    if (node->leaf_count < 1)
        return "a cluster has no leaves";
    if (node->patch >= 0 && m->forest.patch_node[node->patch] != index)
        return "a patch does not know its cluster";
    for (int32_t i = 0; i < node->leaf_count; ++i)
    {
        const int32_t f = node->leaves[i];

        if (i > 0 && node->leaves[i - 1] >= f)
            return "leaves do not ascend";
        if (f < 0 || f >= leaf->face_count || leaf->face_hole[f])
            return "a leaf is a hole, or none";
        if (!node->retired && m->forest.leaf_node[f] != index)
            return "a leaf is of another cluster";
    }
    return NULL;
}

const char *
otx_forest_check(const otx_mosaic *m)
{
    const otx_forest *forest = &m->forest;
    const char *unsound =
        otx_cluster_tree_check(&forest->tree, m->job.run->scratch);
    int64_t in_clusters = 0, owned = 0;

    if (unsound)
        return unsound;
    for (int32_t i = 0; i < forest->count; ++i)
    {
        const char *wrong = check_node(m, i);

        if (wrong)
            return wrong;
        in_clusters +=
            forest->nodes[i].retired ? 0 : forest->nodes[i].leaf_count;
    }
    for (int32_t f = 0; f < m->job.leaves.level->face_count; ++f)
        owned += forest->leaf_node[f] >= 0;
    return in_clusters == owned ? NULL : "leaves are not shared out";
}

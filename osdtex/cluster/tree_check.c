/* tree_check.c -- node by node, then face by face. */
#include "cluster/tree_check.h"

#include <math.h>

static const char *
check_children(const otx_cluster_tree *tree, int32_t index)
{
    const otx_cluster_node *n = &tree->nodes[index];
    int32_t at = n->first;
    double area = 0.0;

    for (int32_t i = 0; i < n->child_count; ++i)
    {
        const otx_cluster_node *c = &tree->nodes[n->first_child + i];

        if (c->parent != index)
            return "a child has another parent";
        if (c->level <= n->level)
            return "a child is of no later level than its parent";
        if (c->first != at)
            return "faces of children are not ranges of the parent's";
        at = c->end;
        area += c->area;
    }
    if (n->child_count > 0 && at != n->end)
        return "children do not have all faces of their parent";
    if (n->child_count > 0 && fabs(area - n->area) > 1e-9 * n->area)
        return "children do not have the area of their parent";
    return NULL;
}

static const char *
check_level(const otx_cluster_tree *tree, int32_t index)
{
    const otx_cluster_node *n = &tree->nodes[index];

    if (n->end <= n->first)
        return "a cluster has no faces";
    if (n->level > tree->face_level ||
        (n->level == tree->face_level && n->end - n->first > 1))
        return "a region is no higher than single faces";
    for (int32_t i = n->first + 1; n->child_count == 0 && i < n->end; ++i)
        if (tree->faces[i - 1] >= tree->faces[i])
            return "faces do not ascend";
    return NULL;
}

static const char *
check_disc(
    const otx_cluster_tree *tree, int32_t index, int32_t *member,
    otx_arena *scratch)
{
    const otx_cluster c = otx_cluster_tree_node(tree, index);

    for (int32_t i = 0; i < c.face_count; ++i)
        member[c.faces[i]] = index;
    if (index == 0 || c.face_count == 1 ||
        otx_cluster_is_disc(
            scratch, tree->how.dual->level, c.faces, c.face_count, member,
            index))
        return NULL;
    return "a region is no disc";
}

static const char *
check_faces(const otx_cluster_tree *tree, int32_t *seen)
{
    const otx_level *level = tree->how.dual->level;

    for (int32_t i = 0; i < tree->face_count; ++i)
    {
        const int32_t f = tree->faces[i];

        if (f < 0 || f >= level->face_count || level->face_hole[f])
            return "a face is a hole, or none";
        if (seen[f] == -2)
            return "a face comes twice";
        if (tree->place[f] != i)
            return "a face is not where it is said to be";
        seen[f] = -2;
    }
    return NULL;
}

const char *
otx_cluster_tree_check(const otx_cluster_tree *tree, otx_arena *scratch)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    int32_t *marks =
        OTX_ZNEW(scratch, int32_t, tree->how.dual->level->face_count);
    const char *wrong = marks ? check_faces(tree, marks) : NULL;

    for (int32_t i = 0; marks && !wrong && i < tree->count; ++i)
    {
        wrong = i == 0 && tree->face_count == 0 ? NULL : check_level(tree, i);
        if (!wrong)
            wrong = check_children(tree, i);
        if (!wrong)
            wrong = check_disc(tree, i, marks, scratch);
    }
    otx_arena_release(scratch, mark);
    return wrong;
}

/* tree.c -- nodes, their ranges of faces, and children when asked for. */
#include "cluster/tree.h"

#include <string.h>

static otx_status
append(otx_run *run, otx_cluster_tree *tree, otx_cluster_node node)
{
    if (tree->count == tree->capacity)
    {
        const int32_t capacity = tree->capacity ? 2 * tree->capacity : 64;
        otx_cluster_node *nodes =
            OTX_NEW(run->arena, otx_cluster_node, capacity);

        OTX_TRY(otx_run_ok(run));
        if (tree->count > 0)
            memcpy(nodes, tree->nodes, (size_t)tree->count * sizeof *nodes);
        tree->nodes = nodes;
        tree->capacity = capacity;
    }
    tree->nodes[tree->count++] = node;
    return OSDTEX_OK;
}

/* Hangs clusters below a node, and their faces from `at` on. */
static otx_status
hang(
    otx_run *run, otx_cluster_tree *tree, int32_t parent, int32_t level,
    double target, const otx_cluster_list *list, int32_t at)
{
    for (int32_t i = 0; i < list->count; ++i)
    {
        const otx_cluster *c = &list->clusters[i];

        memmove(
            tree->faces + at, c->faces,
            (size_t)c->face_count * sizeof *tree->faces);
        OTX_TRY(append(
            run, tree,
            (otx_cluster_node){
                .level = level,
                .parent = parent,
                .first = at,
                .end = at + c->face_count,
                .area = c->area,
                .target = target,
            }));
        for (int32_t k = 0; k < c->face_count; ++k)
            tree->place[tree->faces[at + k]] = at + k;
        at += c->face_count;
        if (c->face_count > 1 && tree->face_level <= level)
            tree->face_level = level + 1;
    }
    tree->nodes[parent].child_count += list->count;
    return OSDTEX_OK;
}

/* Each face of a cluster by itself, but for holes. */
static otx_status
list_faces(
    otx_run *run, const otx_dual *dual, const otx_cluster *cluster,
    otx_cluster_list *out)
{
    const int32_t n = cluster->face_count;

    *out = (otx_cluster_list){0, OTX_NEW(run->arena, otx_cluster, n)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < n; ++i)
    {
        const int32_t *face = &cluster->faces[i];

        if (!dual->level->face_hole[*face])
            out->clusters[out->count++] =
                (otx_cluster){cluster->level, 1, face, dual->areas[*face], -1};
    }
    return OSDTEX_OK;
}

static int32_t
faces_of(const otx_cluster_list *list)
{
    int32_t sum = 0;

    for (int32_t i = 0; i < list->count; ++i)
        sum += list->clusters[i].face_count;
    return sum;
}

static otx_status
grow_part(
    otx_run *run, const otx_cluster_tree *tree, const otx_cluster_part *part,
    otx_cluster_list *out)
{
    *out = (otx_cluster_list){0};
    if (part->region.face_count == 0)
        return OSDTEX_OK;
    if (part->target > 0.0)
        return otx_cluster_grow(
            run, &tree->how, &part->region, part->target, 1, out);
    return list_faces(run, tree->how.dual, &part->region, out);
}

otx_status
otx_cluster_tree_create(
    otx_run *run, const otx_surface *surface, const otx_dual *dual, double bend,
    const otx_cluster_part *parts, int32_t count, otx_cluster_tree *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_cluster_list *lists = OTX_NEW(run->scratch, otx_cluster_list, count);
    int32_t at = 0;

    OTX_TRY(otx_run_ok(run));
    *out = (otx_cluster_tree){.surface = surface, .base = dual->level_index};
    OTX_TRY(otx_cluster_space_create(run, dual->level, &out->space));
    out->how = (otx_growing){dual, bend, &out->space};
    for (int32_t k = 0; k < count; ++k)
    {
        OTX_TRY(grow_part(run, out, &parts[k], &lists[k]));
        out->face_count += faces_of(&lists[k]);
    }
    out->face_level = 1;
    out->faces = OTX_NEW(run->arena, int32_t, out->face_count);
    out->place = OTX_NEW(run->arena, int32_t, dual->level->face_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < dual->level->face_count; ++f)
        out->place[f] = -1;
    OTX_TRY(append(
        run, out,
        (otx_cluster_node){
            .parent = -1, .first_child = 1, .end = out->face_count}));
    for (int32_t k = 0; k < count; ++k)
    {
        OTX_TRY(hang(run, out, 0, 1, parts[k].target, &lists[k], at));
        at += faces_of(&lists[k]);
    }
    for (int32_t i = 1; i < out->count; ++i)
        out->nodes[0].area += out->nodes[i].area;
    out->nodes[0].target = out->nodes[0].area;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_cluster
otx_cluster_tree_node(const otx_cluster_tree *tree, int32_t node)
{
    const otx_cluster_node *n = &tree->nodes[node];

    return (otx_cluster){
        tree->base, n->end - n->first, tree->faces + n->first, n->area, node};
}

otx_status
otx_cluster_tree_grow(otx_run *run, otx_cluster_tree *tree, int32_t node)
{
    const otx_cluster whole = otx_cluster_tree_node(tree, node);
    const otx_cluster_node *n = &tree->nodes[node];
    const int32_t level = n->level + 1, first = n->first;
    const double target = 0.5 * n->target;
    otx_cluster_list list;

    if (n->child_count > 0)
        return OSDTEX_OK;
    OTX_TRY(otx_cluster_grow(run, &tree->how, &whole, target, 2, &list));
    tree->nodes[node].first_child = tree->count;
    return hang(run, tree, node, level, target, &list, first);
}

otx_status
otx_cluster_tree_list(
    otx_run *run, const otx_cluster_tree *tree, int32_t node,
    otx_cluster_list *out)
{
    const otx_cluster_node *n = &tree->nodes[node];

    *out =
        (otx_cluster_list){0, OTX_NEW(run->arena, otx_cluster, n->child_count)};
    OTX_TRY(otx_run_ok(run));
    for (; out->count < n->child_count; ++out->count)
        out->clusters[out->count] =
            otx_cluster_tree_node(tree, n->first_child + out->count);
    return OSDTEX_OK;
}

otx_status
otx_cluster_tree_children(
    otx_run *run, otx_cluster_tree *tree, const otx_cluster *cluster,
    otx_cluster_list *out)
{
    if (cluster->face_count == 1)
        return otx_cluster_children(run, tree->surface, cluster, out);
    OTX_TRY(otx_cluster_tree_grow(run, tree, cluster->node));
    return otx_cluster_tree_list(run, tree, cluster->node, out);
}

int32_t
otx_cluster_tree_level(const otx_cluster_tree *tree, const otx_cluster *cluster)
{
    return cluster->face_count == 1
               ? tree->face_level + cluster->level - tree->base
               : tree->nodes[cluster->node].level;
}

int32_t
otx_cluster_tree_levels(const otx_cluster_tree *tree)
{
    return tree->face_level + tree->surface->level_count - tree->base;
}

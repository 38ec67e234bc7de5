/* tree.h -- the one hierarchy of clusters of a run [Soler02, sec. 3.1].
 *
 *     level 0       the whole surface
 *     level 1       regions, as large as was asked for
 *     level 2 ...   regions of half the area each time
 *     face_level    single faces of the level that regions are unions of: of
 *                   the cage, or subdivision patches
 *     and on        subdivision patches, each level's faces, down to the leaves
 *
 * Regions are nodes that are stored. Their faces stand in one permutation, so
 * that the faces of a node, of its children, and of theirs are ranges. What a
 * region is divided in depends on the region alone; it is grown when it is
 * first asked for, and kept, since most are never looked into. Below single
 * faces nothing is stored: the refiner's levels have the patches nested as
 * ranges already (surface/level.h), and are the hierarchy. */
#ifndef OTX_CLUSTER_TREE_H
#define OTX_CLUSTER_TREE_H

#include "cluster/cluster.h"

/* The whole surface, a region, or a single face that a region was divided
 * into. */
typedef struct otx_cluster_node
{
    int32_t level;  /* of the hierarchy; of a single face one more than that of
                     * the region that it is from */
    int32_t parent; /* -1 of the whole */
    int32_t first_child; /* children have consecutive numbers */
    int32_t child_count; /* 0: single faces, and what was not looked into */
    int32_t first, end;  /* its faces: otx_cluster_tree.faces[first, end) */
    double area;         /* scene units squared */
    double target;       /* that the areas of its level are to have */
} otx_cluster_node;

typedef struct otx_cluster_tree
{
    const otx_surface *surface;
    otx_growing how;
    otx_cluster_space space;
    int32_t base;       /* level of the surface whose faces regions are of */
    int32_t face_level; /* of the hierarchy: single faces of `base`, one more
                         * than that of the deepest region so far */
    int32_t count, capacity;
    otx_cluster_node *nodes; /* [count]; 0 the whole */
    int32_t *faces;          /* ascending within what has no children */
    int32_t face_count;      /* that are covered: no holes */
    int32_t *place; /* [base face_count] where in faces; -1 not covered */
} otx_cluster_tree;

/* A part of the surface whose regions are to have a size of their own. */
typedef struct otx_cluster_part
{
    otx_cluster region; /* faces of the level of the dual */
    double target;      /* area of its regions; 0: each face by itself */
} otx_cluster_part;

/* Makes the whole, of all parts together, and its regions, part by part.
 *
 *   dual   of the level whose faces regions are unions of; borrowed
 *   parts  [count] without common faces
 *
 * In run->arena. MEMORY, CANCELLED. */
otx_status otx_cluster_tree_create(
    otx_run *run, const otx_surface *surface, const otx_dual *dual, double bend,
    const otx_cluster_part *parts, int32_t count, otx_cluster_tree *out);

/* A node as a cluster. Its faces move when its children are grown; the set of
 * them stays. */
otx_cluster otx_cluster_tree_node(const otx_cluster_tree *tree, int32_t node);

/* Divides a region, if it is not divided yet. MEMORY, CANCELLED. */
otx_status
otx_cluster_tree_grow(otx_run *run, otx_cluster_tree *tree, int32_t node);

/* The children that a node has, as clusters. In run->arena. MEMORY. */
otx_status otx_cluster_tree_list(
    otx_run *run, const otx_cluster_tree *tree, int32_t node,
    otx_cluster_list *out);

/* What a cluster is divided in: the children of a node, grown when need be;
 * below, subdivision patches. An empty list of a leaf. In run->arena. MEMORY,
 * CANCELLED. */
otx_status otx_cluster_tree_children(
    otx_run *run, otx_cluster_tree *tree, const otx_cluster *cluster,
    otx_cluster_list *out);

/* Level of the hierarchy that a cluster is of, so far as it has been grown. */
int32_t otx_cluster_tree_level(
    const otx_cluster_tree *tree, const otx_cluster *cluster);

/* Levels of the hierarchy, from the whole to the leaves. */
int32_t otx_cluster_tree_levels(const otx_cluster_tree *tree);

#endif

/* forest.h -- clusters on their way to becoming patches.
 *
 * Roots are the regions of the hierarchy of clusters (cluster/tree.h); one that
 * is not flat, or fits nowhere, is retired and its children there have its
 * leaves. A leaf is of one cluster that is not retired. */
#ifndef OTX_PATCH_FOREST_H
#define OTX_PATCH_FOREST_H

#include "cluster/controls.h"
#include "flatten/chart.h"
#include "match/match.h"
#include "patch/mosaic_job.h"

/* A cluster on its way to becoming a patch. */
typedef struct otx_node
{
    otx_cluster cluster;
    int32_t supply;  /* that it takes from */
    int32_t depth;   /* 0 for the clusters that the run starts with */
    int32_t *leaves; /* [leaf_count] ascending */
    int32_t leaf_count;
    double border;    /* length of its outline inside the surface, texels */
    double textured;  /* of that, beside textured faces */
    int32_t patch;    /* -1 until fitted */
    bool retired;     /* split: its children have its leaves */
    int32_t turn;     /* the last in which it or a neighbour was fitted */
    otx_arena *arena; /* of the chart; NULL until flattened */
    otx_chart chart;
    otx_match placed; /* where the chart lies in the exemplar */
} otx_node;

typedef struct otx_forest
{
    otx_node *nodes;
    int32_t count, capacity;
    int32_t *leaf_node;  /* [leaf face_count] the node that has it now, -1 on
                          * holes */
    int32_t *patch_node; /* [leaf face_count] by patch; -1 of a given one */
    otx_dual dual; /* of the level that regions are grown from; not made where
                    * it is the leaves' */
    otx_cluster_tree tree;
    otx_controls controls;   /* of recursive flattening; else not made */
    otx_chart_space *spaces; /* [threads] */
    int32_t turn_count;      /* so far, see turn.h */
} otx_forest;

/* Clusters to start with, charts, splitting. */
otx_status otx_forest_start(otx_mosaic *m);
/* Flattens the nodes [first, end), in parallel. */
otx_status otx_forest_flatten(otx_mosaic *m, int32_t first, int32_t end);
/* Whether the node is small and flat enough to be mapped as one patch. */
bool otx_forest_is_flat(const otx_mosaic *m, const otx_node *node);
/* Size of a node, and the widths around it that depend on it, texels. */
double otx_forest_size(const otx_mosaic *m, const otx_node *node);
/* Of the mask at full weight. */
double otx_forest_band(const otx_mosaic *m, const otx_node *node);
/* Of what the chart covers and the cut may take over; the band without cut. */
double otx_forest_collar(const otx_mosaic *m, const otx_node *node);
/* Length of a leaf edge, texels. */
double otx_forest_edge_length(const otx_mosaic *m, int32_t edge);
/* Frees all charts. */
void otx_forest_free(otx_mosaic *m);
/* The same when the run's arena dies before that. False when memory is out. */
bool otx_forest_defer(otx_mosaic *m);
/* False when the node is a single leaf face. */
bool otx_forest_can_split(const otx_mosaic *m, const otx_node *node);
/* Patches that were made of clusters of a level of the hierarchy. */
int32_t otx_forest_patches(const otx_mosaic *m, int32_t level);
/* Retires a node and appends its children, unflattened. */
otx_status otx_forest_split(otx_mosaic *m, int32_t node);

/* Flattens the nodes from `first` on, splits what is not flat, and goes on with
 * the children, until all are. */
otx_status otx_forest_settle(otx_mosaic *m, int32_t first);

#endif

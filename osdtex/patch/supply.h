/* supply.h -- the exemplars of a run, each with what it needs.
 *
 * A patch comes from one exemplar, the one that all of its leaves are asked
 * for, and is fitted to what its neighbours show of theirs. */
#ifndef OTX_PATCH_SUPPLY_H
#define OTX_PATCH_SUPPLY_H

#include "match/match.h"
#include "patch/cover.h"
#include "patch/forest.h"

enum
{
    OTX_USAGE_CELLS = 16 /* a side */
};

/* An exemplar, and what is made for it. */
typedef struct otx_supply
{
    const otx_exemplar *exemplar;
    otx_patch_settings settings; /* resolved for it */
    otx_matcher *matcher;
    const otx_guide *guide; /* that its patches follow; NULL none */
    float *usage;           /* see otx_match_query */
    double area;            /* of the leaves that are asked for it */
} otx_supply;

typedef struct otx_supplies
{
    otx_supply items[OTX_EXEMPLARS_MAX]; /* [job->exemplar_count] */
    double edge_unit;  /* by which edges are weighed in the match; 0 not */
    double *away;      /* of several: [leaf face_count] texels from where the
                        * demand ends, INFINITY beyond `transition` */
    double transition; /* texels from there within which seams may run */
} otx_supplies;

/* The exemplars of a run, each with what it needs. */
otx_status otx_supply_prepare(otx_mosaic *m);
/* Cell of `usage` that a place in the exemplar, in texels, falls in. */
int32_t otx_supply_cell(const otx_supply *supply, otx_vec2 at);
/* Index of the one that a leaf face is asked for. */
int32_t otx_supply_wanted(const otx_mosaic_job *job, int32_t face);
const otx_supply *otx_supply_of(const otx_mosaic *m, const otx_node *node);
/* Whether all leaves of a node are asked for the one that it takes from. */
bool otx_supply_is_pure(const otx_mosaic *m, const otx_node *node);
/* Whether a node reaches into the band around where the demand ends. */
bool otx_supply_meets(const otx_mosaic *m, const otx_node *node);
/* What it costs in the cut that a node shows a leaf face; negative when it may
 * not. */
float otx_supply_cost(const otx_mosaic *m, const otx_node *node, int32_t face);
/* out[supply_count]: what asks for each, in faces of `level`, or of the leaf
 * level where faces of that are divided. */
otx_status otx_supply_regions(otx_mosaic *m, int32_t level, otx_cluster *out);

#endif

/* match_maps.h -- comparing more of a material than its colour.
 *
 * Two places may have one colour and lie at other heights. Each map that counts
 * is a channel beside the colours, in units of how much it varies; of all of
 * them `match` keeps the three directions in which places differ most, so that
 * whatever compares three channels compares them unchanged. */
#ifndef OTX_EXEMPLAR_MATCH_MAPS_H
#define OTX_EXEMPLAR_MATCH_MAPS_H

#include "exemplar/exemplar.h"

/* What counts, and how much: a map of weight 2 tells two random places apart
 * twice as far as one of weight 1. All 0: the colour alone. */
typedef struct otx_match_weights
{
    double color;
    double maps[OTX_COMPANION_COUNT];
} otx_match_weights;

/* Mixes the maps of `e` into its `match`, in run->arena, and measures it anew:
 * random texels stay as far apart as they were. Normals count by how steep they
 * are, which is the same however a patch is turned. Says how much of what there
 * is to tell the three channels keep. Nothing where there is no `match`.
 *
 * ARGUMENT (a weight that is negative or not finite, a map that `e` lacks),
 * LIMIT, MEMORY. */
otx_status otx_match_maps_mix(
    otx_run *run, const otx_match_weights *weights, otx_exemplar *e);

#endif

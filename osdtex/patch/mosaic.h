/* mosaic.h -- a surface on its way to being covered by patches.
 *
 * [Soler02] Soler, Cani, Angelidis: Hierarchical Pattern Mapping. SIGGRAPH.
 *
 * The surface is covered by patches, coarse to fine. A patch starts as a
 * cluster; it is flattened with its collar, looked up in the exemplar so that
 * it continues what its neighbours show, and given UVs; a cluster that is not
 * flat or fits nowhere is split. See docs/notes/hierarchical.md.
 *
 * What is here is kept by five nouns, each with a header that says who may
 * change it. Which stage is for what:
 *
 *     forest.c         clusters to start with, charts, splitting
 *     turn.c           which clusters are fitted next
 *     mask_build.c     what their neighbours show; band.c cuts it
 *     angles.c         how they may be turned; follow.c by a guide
 *     placing.c        where they may lie; continuation.c, first.c: exactly
 *     spare.c          what neighbours could show instead of them
 *     fit.c            looks them up, makes patches of them; bend.c bends them
 *     stitch.c         the cut between patches, and what is relaxed after it
 *     straighten.c, unfold.c   set right what came out reversed */
#ifndef OTX_PATCH_MOSAIC_H
#define OTX_PATCH_MOSAIC_H

#include "patch/cover.h"
#include "patch/forest.h"
#include "patch/mosaic_job.h"
#include "patch/spare.h"
#include "patch/supply.h"

/* What is reported at the end. */
typedef struct otx_patch_tally
{
    int32_t fits;                 /* searches made */
    int32_t splits;               /* clusters given to their children */
    double fit_error;             /* of accepted fits; their mean, once
                                   * all are made */
    double cut_before, cut_after; /* seam energy; 0 when not cut */
    double relax_before, relax_after;
} otx_patch_tally;

struct otx_mosaic
{
    otx_mosaic_job job;
    otx_cover cover;
    otx_supplies supplies;
    otx_forest forest;
    otx_spares spares;
    otx_patch_tally tally;
};

/* Begins: completes the job (leaves, settings) and makes all that is made
 * once. The charts are freed with run->arena at the latest.
 *
 *   guides  [job->exemplar_count] that patches follow; NULL, or one without
 *           directions: none
 *
 * MEMORY, CANCELLED. */
otx_status otx_mosaic_begin(otx_mosaic *m, const otx_guide *guides);

/* The mapping, once patches are stitched: repaired, and with the guide of the
 * first exemplar. Adds the figures. MEMORY. */
otx_status otx_mosaic_finish(otx_mosaic *m, otx_mapping *out);

#endif

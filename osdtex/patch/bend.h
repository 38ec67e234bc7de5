/* bend.h -- relaxation of a patch as it is placed. */
#ifndef OTX_PATCH_BEND_H
#define OTX_PATCH_BEND_H

#include "patch/mosaic.h"

/* Relaxes the placements of an unfitted node and bends its chart by
 * the best one.
 *
 *   count  of placed, at least 1
 *   space, scratch  of the thread
 *   best   with the error that is left along the border; may be &placed[0]
 *
 * MEMORY, without a finding. */
otx_status otx_bend_relax(
    const otx_mosaic *m, int32_t node, const otx_match *placed, int32_t count,
    otx_chart_space *space, otx_arena *scratch, otx_match *best);

#endif

/* fit.h -- looks clusters up in the exemplar, and makes patches of them. */
#ifndef OTX_PATCH_FIT_H
#define OTX_PATCH_FIT_H

#include "patch/mosaic.h"

/* Where a node is to be put. */
typedef struct otx_fit
{
    int32_t node;
    bool found;    /* false: it fits nowhere */
    bool searched; /* it had something to match */
    otx_match placed;
} otx_fit;

/* Looks nodes up in the exemplar, each as if it were alone. With
 * relax=loop their charts are bent; else only `fits` changes.
 *
 *   fits   [count] the nodes in, what was found out
 *   count  >= 1 */
otx_status otx_fit_find(const otx_mosaic *m, otx_fit *fits, int32_t count);
/* Makes a patch of a node. False when the error is above tau and the node can
 * be split, or when it fits nowhere. */
bool otx_fit_commit(otx_mosaic *m, const otx_fit *fit);

#endif

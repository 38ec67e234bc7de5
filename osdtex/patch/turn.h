/* turn.h -- which clusters are fitted next, and which at the same time. */
#ifndef OTX_PATCH_TURN_H
#define OTX_PATCH_TURN_H

#include "base/pqueue.h"
#include "patch/fit.h"

enum
{
    OTX_TURN_NODES = 16 /* fitted at the same time, at most */
};

/* Takes nodes from the queue that may be fitted at the same time.
 *
 *   key    of a node in the queue, the least first
 *   fits   [OTX_TURN_NODES] the nodes
 *   count  0 when the queue is empty */
double otx_turn_key(const otx_mosaic *m, int32_t node);
otx_status
otx_turn_next(otx_mosaic *m, otx_pqueue *queue, otx_fit *fits, int32_t *count);

/* Puts the nodes [first, end) that are not retired into the queue. */
void otx_turn_push(
    const otx_mosaic *m, otx_pqueue *queue, int32_t first, int32_t end);

/* Tells the neighbours of a new patch that more of their border is textured,
 * and puts them into the queue again. */
void otx_turn_wake(otx_mosaic *m, otx_pqueue *queue, int32_t index);

#endif

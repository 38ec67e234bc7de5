/* cut_memo.h -- costs of edges that were looked up before.
 *
 * A move compares what its patch shows with what the faces around it show, and
 * in later sweeps mostly finds what an earlier one found. Each face that a
 * patch offers remembers, for each of its edges, the patch on the other side
 * that it was compared with last, and the cost. */
#ifndef OTX_RELAX_CUT_MEMO_H
#define OTX_RELAX_CUT_MEMO_H

#include "relax/cut_cost.h"

typedef struct otx_cut_memo
{
    const otx_cut_cost *cost;
    int64_t *first;    /* [offer_count] into entries */
    uint64_t *entries; /* by corner of what is offered */
} otx_cut_memo;

/* In `arena`; `cost` is borrowed. MEMORY, without a finding. */
otx_status otx_cut_memo_create(
    otx_arena *arena, const otx_cut_cost *cost, int32_t offer_count,
    otx_cut_memo *out);

/* otx_cut_cost_edge, remembered by the patch that shows the first (side 0) or
 * second face of the edge. Threads may ask for different edges. */
int64_t otx_cut_memo_edge(
    const otx_cut_memo *memo, int32_t edge, const otx_cut_view views[2],
    int side);

#endif

/* cut_order.h -- which expansion moves must wait for which.
 *
 * A move reads the labels of the faces that its patch offers and of their
 * neighbours, and sets those of the former. Two moves of which neither reads
 * what the other sets may run at the same time, with the result of one after
 * the other. */
#ifndef OTX_RELAX_CUT_ORDER_H
#define OTX_RELAX_CUT_ORDER_H

#include "relax/cut.h"

/* The moves of a sweep by place: as many as can wait for the same ones stand
 * together. */
typedef struct otx_cut_order
{
    int32_t *offers;       /* [offer_count] the patch at each place */
    otx_pool_order places; /* that a place waits for: patches of lower number
                            * that it touches */
} otx_cut_order;

/* In `arena`, which is not run->scratch. MEMORY. */
otx_status otx_cut_order_build(
    otx_run *run, otx_arena *arena, const otx_level *leaf,
    const otx_offer *offers, int32_t offer_count, otx_cut_order *out);

#endif

/* subsample.h -- a few of many masks, between which equally much changes. */
#ifndef OTX_STACK_SUBSAMPLE_H
#define OTX_STACK_SUBSAMPLE_H

#include "base/run.h"

/* Masks as bits. */
typedef struct otx_subsample
{
    int32_t count;
    int64_t texels;
    int64_t words;  /* of a mask */
    uint64_t *bits; /* [count * words] */
} otx_subsample;

/* In run->scratch. LIMIT where that is more than memory can be, MEMORY. */
otx_status otx_subsample_create(
    otx_run *run, int32_t count, int64_t texels, otx_subsample *out);

void
otx_subsample_put(otx_subsample *sequence, int32_t index, const uint8_t *mask);
void
otx_subsample_get(const otx_subsample *sequence, int32_t index, uint8_t *mask);

/* Chooses `count` masks, the first and the last among them, for which the sum
 * of the fourth powers of what changes from one to the next is least. By
 * dynamic programming over all pairs.
 *
 *   picks  [count] ascending
 *
 * ARGUMENT where there are fewer masks than that, MEMORY, CANCELLED. */
otx_status otx_subsample_pick(
    otx_run *run, const otx_subsample *sequence, int32_t count, int32_t *picks);

#endif

/* csr.h -- many lists, one behind the other in one array.
 *
 * List k is items [first[k], first[k + 1]), as in compressed sparse rows. The
 * offsets are counted two places on: filling moves each start to its end, which
 * then is the start of the next.
 *
 *     int32_t *first = OTX_ZNEW(arena, int32_t, (int64_t)lists + 2);
 *
 *     for each item
 *         otx_csr_count(first, list, 1);
 *     otx_csr_sum(first, lists);
 *     for each item
 *         items[otx_csr_place(first, list)] = item;
 *
 * After the sum, first[lists + 1] items are to come. Items of a list keep the
 * order in which they are placed. `wide` offsets are for more than 2^31 - 1
 * items. */
#ifndef OTX_BASE_CSR_H
#define OTX_BASE_CSR_H

#include <stdint.h>

static inline void
otx_csr_count(int32_t *first, int32_t list, int32_t items)
{
    first[(int64_t)list + 2] += items;
}

static inline void
otx_csr_sum(int32_t *first, int64_t lists)
{
    for (int64_t k = 2; k < lists + 2; ++k)
        first[k] += first[k - 1];
}

/* Where the next item of a list goes. */
static inline int32_t
otx_csr_place(int32_t *first, int32_t list)
{
    return first[(int64_t)list + 1]++;
}

static inline void
otx_csr_wide_count(int64_t *first, int64_t list, int64_t items)
{
    first[list + 2] += items;
}

static inline void
otx_csr_wide_sum(int64_t *first, int64_t lists)
{
    for (int64_t k = 2; k < lists + 2; ++k)
        first[k] += first[k - 1];
}

static inline int64_t
otx_csr_wide_place(int64_t *first, int64_t list)
{
    return first[list + 1]++;
}

#endif

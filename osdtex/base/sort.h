/* sort.h -- numbers in ascending order. */
#ifndef OTX_BASE_SORT_H
#define OTX_BASE_SORT_H

#include <stdlib.h>

static inline int
otx_sort_by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;

    return (p > q) - (p < q);
}

static inline void
otx_sort_doubles(double *values, size_t count)
{
    qsort(values, count, sizeof *values, otx_sort_by_value);
}

#endif

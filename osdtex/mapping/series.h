/* series.h -- weighted values, averaged and ranked. */
#ifndef OTX_MAPPING_SERIES_H
#define OTX_MAPPING_SERIES_H

#include "base/status.h"

typedef struct otx_series_item
{
    double value, weight;
} otx_series_item;

/* Values to be averaged and ranked. */
typedef struct otx_series
{
    int32_t count;
    otx_series_item *items; /* the caller's, with room for all */
} otx_series;

static inline void
otx_series_add(otx_series *s, double value, double weight)
{
    s->items[s->count++] = (otx_series_item){value, weight};
}

/* 0 without weight. */
double otx_series_mean(const otx_series *s);

/* Least value that `share` of the weight does not exceed; 0 of none. Sorts. */
double otx_series_quantile(otx_series *s, double share);

#endif

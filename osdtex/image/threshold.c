/* threshold.c -- a histogram and its sums. */
#include "image/threshold.h"

#include <math.h>
#include <stdbool.h>

enum
{
    BINS = 256
};

typedef struct histogram
{
    double low, high;
    double shares[BINS];
    double mean, variance; /* in bins */
} histogram;

/* False where all values are one. */
static bool
fill(const float *values, int64_t count, histogram *h)
{
    double squares = 0.0;

    *h = (histogram){.low = (double)values[0], .high = (double)values[0]};
    for (int64_t i = 1; i < count; ++i)
    {
        h->low = fmin(h->low, (double)values[i]);
        h->high = fmax(h->high, (double)values[i]);
    }
    if (!(h->high > h->low))
        return false;
    for (int64_t i = 0; i < count; ++i)
    {
        const double at = ((double)values[i] - h->low) / (h->high - h->low);

        h->shares[(int32_t)((BINS - 1) * at)] += 1.0 / (double)count;
    }
    for (int32_t b = 0; b < BINS; ++b)
    {
        h->mean += b * h->shares[b];
        squares += (double)b * b * h->shares[b];
    }
    h->variance = squares - h->mean * h->mean;
    return h->variance > 0.0;
}

otx_threshold
otx_threshold_find(const float *values, int64_t count)
{
    double mass = 0.0, below = 0.0, best = 0.0;
    int32_t cut = 0;
    histogram h;

    if (!fill(values, count, &h))
        return (otx_threshold){h.low, 0.0};
    for (int32_t b = 0; b < BINS - 1; ++b)
    {
        double apart;

        mass += h.shares[b];
        below += b * h.shares[b];
        if (!(mass > 0.0 && mass < 1.0))
            continue;
        apart = h.mean * mass - below;
        if (apart * apart / (mass * (1.0 - mass)) > best)
        {
            best = apart * apart / (mass * (1.0 - mass));
            cut = b;
        }
    }
    return (otx_threshold){
        h.low + (h.high - h.low) * (cut + 1) / (BINS - 1), best / h.variance};
}

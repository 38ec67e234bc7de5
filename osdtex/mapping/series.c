/* series.c -- weighted values, averaged and ranked. */
#include "mapping/series.h"

#include <stdlib.h>

static int
compare_weighted(const void *a, const void *b)
{
    const otx_series_item *p = a, *q = b;

    if (p->value != q->value)
        return p->value < q->value ? -1 : 1;
    return (p->weight > q->weight) - (p->weight < q->weight);
}

double
otx_series_mean(const otx_series *s)
{
    double sum = 0.0, weight = 0.0;

    for (int32_t i = 0; i < s->count; ++i)
    {
        sum += s->items[i].value * s->items[i].weight;
        weight += s->items[i].weight;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

double
otx_series_quantile(otx_series *s, double share)
{
    double total = 0.0, sum = 0.0;

    if (s->count == 0)
        return 0.0;
    qsort(s->items, (size_t)s->count, sizeof *s->items, compare_weighted);
    for (int32_t i = 0; i < s->count; ++i)
        total += s->items[i].weight;
    for (int32_t i = 0; i < s->count; ++i)
    {
        sum += s->items[i].weight;
        if (sum >= share * total)
            return s->items[i].value;
    }
    return s->items[s->count - 1].value;
}

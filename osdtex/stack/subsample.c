/* subsample.c -- bit sets and a table. */
#include "stack/subsample.h"

#include <math.h>

static const char STAGE[] = "stack";

otx_status
otx_subsample_create(
    otx_run *run, int32_t count, int64_t texels, otx_subsample *out)
{
    const int64_t words = (texels + 63) / 64;

    *out = (otx_subsample){count, texels, words, NULL};
    if (words > INT64_MAX / 8 / (count > 0 ? count : 1))
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "%d masks of %lld texels are too many", count, (long long)texels);
    out->bits = OTX_ZNEW(run->scratch, uint64_t, count * words);
    return otx_run_ok(run);
}

void
otx_subsample_put(otx_subsample *sequence, int32_t index, const uint8_t *mask)
{
    uint64_t *bits = sequence->bits + index * sequence->words;

    for (int64_t w = 0; w < sequence->words; ++w)
        bits[w] = 0;
    for (int64_t i = 0; i < sequence->texels; ++i)
        bits[i / 64] |= (uint64_t)(mask[i] != 0) << (i % 64);
}

void
otx_subsample_get(const otx_subsample *sequence, int32_t index, uint8_t *mask)
{
    const uint64_t *bits = sequence->bits + index * sequence->words;

    for (int64_t i = 0; i < sequence->texels; ++i)
        mask[i] = bits[i / 64] >> (i % 64) & 1;
}

/* How many texels differ. */
static double
difference(const otx_subsample *s, int32_t a, int32_t b)
{
    const uint64_t *p = s->bits + a * s->words, *q = s->bits + b * s->words;
    int64_t count = 0;

    for (int64_t w = 0; w < s->words; ++w)
        count += __builtin_popcountll(p[w] ^ q[w]);
    return (double)count;
}

/* Costs of a step from a to b, for all a < b. */
typedef struct table
{
    const otx_subsample *sequence;
    double *costs; /* [count * count] */
} table;

static otx_status
fill_row(void *context, int64_t a, otx_worker *worker)
{
    const table *t = context;
    const int32_t count = t->sequence->count;

    for (int32_t b = (int32_t)a + 1; b < count; ++b)
    {
        const double d = difference(t->sequence, (int32_t)a, b);

        t->costs[a * count + b] = d * d * d * d;
    }
    return otx_worker_look(worker);
}

static otx_status
find_costs(otx_run *run, const otx_subsample *sequence, double **out)
{
    const int64_t count = sequence->count;
    table t = {sequence, OTX_NEW(run->scratch, double, count *count)};

    OTX_TRY(otx_run_ok(run));
    *out = t.costs;
    return otx_loop_result(
        run, STAGE, otx_pool_for(run->pool, count, fill_row, &t));
}

otx_status
otx_subsample_pick(
    otx_run *run, const otx_subsample *sequence, int32_t count, int32_t *picks)
{
    const int32_t n = sequence->count;
    double *costs, *best;
    int32_t *back;

    if (n < count || count < 2)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "%d slices cannot be picked of %d steps", count, n);
    OTX_TRY(find_costs(run, sequence, &costs));
    best = OTX_NEW(run->scratch, double, (int64_t)count *n);
    back = OTX_ZNEW(run->scratch, int32_t, (int64_t)count * n);
    OTX_TRY(otx_run_ok(run));
    for (int32_t b = 0; b < n; ++b)
        best[b] = b == 0 ? 0.0 : (double)INFINITY;
    for (int32_t m = 1; m < count; ++m)
        for (int32_t b = 0; b < n; ++b)
        {
            double *to = &best[(int64_t)m * n + b];

            *to = (double)INFINITY;
            for (int32_t a = 0; a < b; ++a)
            {
                const double cost =
                    best[(int64_t)(m - 1) * n + a] + costs[(int64_t)a * n + b];

                if (cost < *to)
                {
                    *to = cost;
                    back[(int64_t)m * n + b] = a;
                }
            }
        }
    picks[count - 1] = n - 1;
    for (int32_t m = count - 1; m > 0; --m)
        picks[m - 1] = back[(int64_t)m * n + picks[m]];
    return OSDTEX_OK;
}

/* slice_figures.c -- slices against their keys and their neighbours. */
#include "stack/slice_figures.h"

#include "base/sort.h"
#include "image/mask_distance.h"

#include <math.h>
#include <string.h>

enum
{
    CHANNELS = 3,
    BINS = 512,
    STILL = 8 /* texels from what changes */
};

/* Half a unit of Lab. */
static const double BIN = 0.5;

typedef struct work
{
    otx_run *run;
    const otx_stack *stack;
    const otx_stack_key *keys;
    const otx_exemplar *labs;
    int64_t texels;
    double steps[OTX_MORPH_STEPS_MAX]; /* of a stretch */
    int64_t flips[OTX_MORPH_STEPS_MAX];
} work;

/* ---- a slice and its keys -------------------------------------------------
 */

static double
overlap(const otx_stack_slice *slice, const uint8_t *key, int side, int64_t n)
{
    int64_t both = 0, any = 0;

    for (int64_t i = 0; i < n; ++i)
    {
        const bool is = key[slice->texels[side][i]], wanted = slice->mask[i];

        both += is && wanted;
        any += is || wanted;
    }
    return any > 0 ? (double)both / (double)any : 1.0;
}

/* How far values have to be moved to become others: the area between the sums
 * of their histograms. */
static double
move(const int64_t *a, const int64_t *b)
{
    int64_t in_a = 0, in_b = 0, sum_a = 0, sum_b = 0;
    double area = 0.0;

    for (int i = 0; i < BINS; ++i)
    {
        in_a += a[i];
        in_b += b[i];
    }
    for (int i = 0; i < BINS && in_a > 0 && in_b > 0; ++i)
    {
        sum_a += a[i];
        sum_b += b[i];
        area +=
            fabs((double)sum_a / (double)in_a - (double)sum_b / (double)in_b);
    }
    return BIN * area;
}

static int
bin_of(const otx_image *lab, int64_t texel, int channel)
{
    const double v = (double)lab->pixels[texel * lab->channels + channel];

    return (int)fmin(fmax(v / BIN + BINS / 2, 0.0), BINS - 1.0);
}

/* Inside and outside the mask apart, by their areas: the mask says how much
 * there is of each. */
static double
displacement(
    const otx_stack_slice *slice, const otx_stack_key *key, int side,
    int64_t texels)
{
    const otx_image *lab = &key->exemplar->lab;
    double squares[2] = {0.0, 0.0};
    int64_t inside = 0;

    for (int c = 0; c < CHANNELS; ++c)
    {
        int64_t is[2][BINS] = {{0}}, was[2][BINS] = {{0}};

        inside = 0;
        for (int64_t i = 0; i < texels; ++i)
        {
            inside += slice->mask[i];
            ++is[slice->mask[i]][bin_of(lab, slice->texels[side][i], c)];
            ++was[key->mask[i]][bin_of(lab, i, c)];
        }
        for (int k = 0; k < 2; ++k)
            squares[k] += pow(move(is[k], was[k]), 2.0);
    }

    const double share = (double)inside / (double)texels;

    return share * sqrt(squares[1]) + (1.0 - share) * sqrt(squares[0]);
}

static void
judge_slice(const work *w, int32_t index, otx_slice_figures *out)
{
    const otx_stack_slice *slice = &w->stack->slices[index];
    const otx_exemplar *a = w->keys[slice->keys[0]].exemplar;
    const otx_exemplar *b = w->keys[slice->keys[1]].exemplar;
    const double t = slice->weight;
    const double sigma = (1.0 - t) * a->lab_sigma + t * b->lab_sigma;
    const double step = (1.0 - t) * a->lab_step + t * b->lab_step;

    for (int side = 0; side < 2; ++side)
    {
        const otx_stack_key *key = &w->keys[slice->keys[side]];

        if (!slice->texels[side])
            continue;
        out->lookup =
            fmin(out->lookup, overlap(slice, key->mask, side, w->texels));
        out->colours =
            fmax(out->colours, displacement(slice, key, side, w->texels));
    }
    if (sigma > 0.0 && step > 0.0)
    {
        const double contrast = w->labs[index].lab_sigma / sigma;

        out->contrast_least = fmin(out->contrast_least, contrast);
        out->contrast_most = fmax(out->contrast_most, contrast);
        out->sharpness = fmin(out->sharpness, w->labs[index].lab_step / step);
    }
}

/* ---- from slice to slice --------------------------------------------------
 */

static double
distance(const otx_image *a, const otx_image *b, int64_t texel)
{
    const float *p = a->pixels + texel * a->channels;
    const float *q = b->pixels + texel * b->channels;
    double sum = 0.0;

    for (int c = 0; c < CHANNELS; ++c)
        sum += ((double)p[c] - (double)q[c]) * ((double)p[c] - (double)q[c]);
    return sqrt(sum);
}

/* Mean distance where no mask changes nearby; 0 where that is nowhere. */
static otx_status
measure_still(
    const work *w, int32_t index, const double *distances, int64_t flips,
    double *out)
{
    const uint8_t *is = w->stack->slices[index].mask;
    const uint8_t *next = w->stack->slices[index + 1].mask;
    uint8_t *stays = OTX_NEW(w->run->scratch, uint8_t, w->texels);
    float *away = OTX_ZNEW(w->run->scratch, float, w->texels);
    double sum = 0.0;
    int64_t count = 0;

    OTX_TRY(otx_run_ok(w->run));
    for (int64_t i = 0; i < w->texels; ++i)
        stays[i] = is[i] == next[i];
    if (flips > 0 && flips < w->texels)
        OTX_TRY(otx_mask_distance(
            w->run, stays, w->stack->width, w->stack->height, away));
    for (int64_t i = 0; i < w->texels; ++i)
        if (flips == 0 || away[i] > STILL)
        {
            sum += distances[i];
            ++count;
        }
    *out = count > 0 ? sum / (double)count : 0.0;
    return OSDTEX_OK;
}

/* From slice `index` to the next, which is step m of its stretch. */
static otx_status
judge_step(work *w, int32_t index, int32_t m, otx_slice_figures *out)
{
    const otx_arena_mark mark = otx_arena_here(w->run->scratch);
    const uint8_t *is = w->stack->slices[index].mask;
    const uint8_t *next = w->stack->slices[index + 1].mask;
    double *distances = OTX_NEW(w->run->scratch, double, w->texels);
    double still, sum = 0.0;

    OTX_TRY(otx_run_ok(w->run));
    w->flips[m] = 0;
    for (int64_t i = 0; i < w->texels; ++i)
    {
        distances[i] =
            distance(&w->labs[index].lab, &w->labs[index + 1].lab, i);
        sum += distances[i];
        w->flips[m] += is[i] != next[i];
    }
    w->steps[m] = sum / (double)w->texels;
    OTX_TRY(measure_still(w, index, distances, w->flips[m], &still));
    out->still = fmax(out->still, still);
    otx_arena_release(w->run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
judge_stretch(work *w, int32_t first, int32_t steps, otx_slice_figures *out)
{
    double mean = 0.0, median;

    for (int32_t m = 0; m < steps; ++m)
    {
        OTX_TRY(judge_step(w, first + m, m, out));
        mean += (double)w->flips[m] / steps;
    }
    for (int32_t m = 0; m < steps && mean > 0.0; ++m)
    {
        out->flips_least = fmin(out->flips_least, (double)w->flips[m] / mean);
        out->flips_most = fmax(out->flips_most, (double)w->flips[m] / mean);
    }
    otx_sort_doubles(w->steps, (size_t)steps);
    median = 0.5 * (w->steps[steps / 2] + w->steps[(steps - 1) / 2]);
    if (median > 0.0)
        out->step = fmax(out->step, w->steps[steps - 1] / median);
    return OSDTEX_OK;
}

otx_status
otx_slice_figures_take(
    otx_run *run, const otx_stack *stack, const otx_stack_key *keys,
    const otx_exemplar *labs, otx_slice_figures *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    work *w = OTX_NEW(run->scratch, work, 1);
    const int32_t stretches = stack->slices[stack->count - 1].keys[0] + 1;
    const int32_t steps = (stack->count - 1) / stretches;

    *out = (otx_slice_figures){
        .lookup = 1.0,
        .contrast_least = 1.0,
        .contrast_most = 1.0,
        .sharpness = 1.0,
        .flips_least = 1.0,
        .flips_most = 1.0,
        .step = 1.0};
    OTX_TRY(otx_run_ok(run));
    *w = (work){
        .run = run,
        .stack = stack,
        .keys = keys,
        .labs = labs,
        .texels = (int64_t)stack->width * stack->height};
    for (int32_t i = 0; i < stack->count; ++i)
        judge_slice(w, i, out);
    for (int32_t k = 0; k < stretches; ++k)
        OTX_TRY(judge_stretch(w, k * steps, steps, out));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* tileable.c -- does a picture continue across its own border?
 *
 * Two tests, either of which says yes.
 *
 * Steps: the texels on both sides of the border differ no more than
 * neighbours inside do. At several sizes, since grain can hide a border
 * between a light and a dark side.
 *
 * Likeness: the border looks like some place inside. A lattice whose strands
 * end on the border fails the first test -- the step there is six times the
 * mean -- and is told by this one: the same edge stands one period further in.
 * The strip around the border must be as like its best match as strips inside
 * are like theirs, else a lattice cut half-way through a period would pass. */
#include "exemplar/tileable.h"

#include <math.h>
#include <string.h>

enum
{
    LEVELS_MAX = 4,       /* sizes at which steps are compared */
    LEVEL_MIN_SIDE = 64,  /* below it a few columns decide by chance */
    STRIP_MAX_SIDE = 192, /* strips are compared at this size */
    STRIP_MIN_SIDE = 32,
    PROBE_COUNT = 5 /* strips inside whose likeness sets the standard */
};

/* Set on the photographs listed in docs/notes/colour.md: those that tile have
 * ratios up to 1.47, the others from 1.64 (text), and likenesses of .61 to
 * 1.00 against up to .41. */
static const double step_ratio_max = 1.6;
static const double likeness_min = 0.5;
static const double likeness_slack = 0.15;
static const double largest_ratio_max = 1.25;

typedef struct steps
{
    double border, inner, largest;
} steps;

/* RMS step from each column to the next, the last to the first. */
static otx_status
measure_steps(otx_run *run, const otx_image *image, steps *out)
{
    const int32_t width = image->width;
    double *sum = OTX_ZNEW(run->scratch, double, width);
    double inner = 0.0;
    double largest = 0.0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < image->height; ++y)
    {
        const float *row = otx_image_at(image, 0, y);

        for (int32_t x = 0; x + 1 < width; ++x)
            sum[x] += otx_image_distance_sq(row + 3 * x, row + 3 * (x + 1));
        sum[width - 1] += otx_image_distance_sq(row + 3 * (width - 1), row);
    }
    for (int32_t x = 0; x + 1 < width; ++x)
    {
        inner += sum[x];
        largest = fmax(largest, sum[x]);
    }
    out->border = sqrt(sum[width - 1] / image->height);
    out->inner = sqrt(inner / ((double)(width - 1) * image->height));
    out->largest = sqrt(largest / image->height);
    return OSDTEX_OK;
}

static otx_status
halve(otx_run *run, otx_image *image)
{
    const otx_image from = *image;

    return otx_image_halve(run, run->scratch, &from, image);
}

/* The first test; `*first` are the steps at full size. */
static otx_status
test_steps(otx_run *run, const otx_image *image, steps *first, bool *pass)
{
    otx_image level = *image;

    OTX_TRY(measure_steps(run, image, first));
    *pass = first->border <= step_ratio_max * first->inner;
    for (int i = 1; i < LEVELS_MAX && *pass; ++i)
    {
        steps s;

        if (level.width < 2 * LEVEL_MIN_SIDE || level.height < 2)
            break;
        OTX_TRY(halve(run, &level));
        OTX_TRY(measure_steps(run, &level, &s));
        *pass = s.border <= step_ratio_max * s.inner;
    }
    return OSDTEX_OK;
}

/* Sums over the texels of one column: of each channel, and of all squares. */
typedef struct column
{
    double sum[3];
    double sum_sq;
} column;

typedef struct strips
{
    const otx_image *image;
    const column *columns;
    int32_t half; /* a strip is 2 half columns wide */
} strips;

static otx_status
sum_columns(otx_run *run, const otx_image *image, column **out)
{
    column *columns = OTX_ZNEW(run->scratch, column, image->width);

    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < image->height; ++y)
    {
        const float *row = otx_image_at(image, 0, y);

        for (int32_t x = 0; x < image->width; ++x)
            for (int k = 0; k < 3; ++k)
            {
                const double v = (double)row[3 * x + k];
                columns[x].sum[k] += v;
                columns[x].sum_sq += v * v;
            }
    }
    *out = columns;
    return OSDTEX_OK;
}

/* Variance of the strip centred before column `at`, over all channels. */
static double
strip_variance(const strips *s, int32_t at)
{
    const int32_t width = s->image->width;
    const double count = 2.0 * s->half * s->image->height;
    double mean[3] = {0.0, 0.0, 0.0};
    double square = 0.0;

    for (int32_t i = at - s->half; i < at + s->half; ++i)
    {
        const column *c = &s->columns[otx_image_wrap(i, width)];

        for (int k = 0; k < 3; ++k)
            mean[k] += c->sum[k] / count;
        square += c->sum_sq / count;
    }
    return square - mean[0] * mean[0] - mean[1] * mean[1] - mean[2] * mean[2];
}

/* 1 - E |a - b|^2 / (var a + var b): 1 for equal strips, 0 for unrelated
 * ones. */
static double
likeness(const strips *s, int32_t a, int32_t b)
{
    const int32_t width = s->image->width;
    const double count = 2.0 * s->half * s->image->height;
    const double variance = strip_variance(s, a) + strip_variance(s, b);
    double sum = 0.0;

    if (!(variance > 1e-9))
        return 0.0;
    for (int32_t y = 0; y < s->image->height; ++y)
    {
        const float *row = otx_image_at(s->image, 0, y);

        for (int32_t i = -s->half; i < s->half; ++i)
            sum += otx_image_distance_sq(
                row + 3 * otx_image_wrap(a + i, width),
                row + 3 * otx_image_wrap(b + i, width));
    }
    return 1.0 - sum / count / variance;
}

/* Likeness of the strip at `at` with the most alike one that lies inside the
 * picture and more than half a strip away. */
static double
best_likeness(const strips *s, int32_t at)
{
    double best = -1.0;

    for (int32_t x = s->half; x + s->half <= s->image->width; ++x)
        if (x - at >= s->half || at - x >= s->half)
            best = fmax(best, likeness(s, at, x));
    return best;
}

/* Median over strips spread evenly inside: what this picture can reach. */
static double
usual_likeness(const strips *s)
{
    const int32_t room = s->image->width - 2 * s->half;
    double found[PROBE_COUNT];

    for (int32_t i = 0; i < PROBE_COUNT; ++i)
    {
        double value =
            best_likeness(s, s->half + (i + 1) * room / (PROBE_COUNT + 1));

        for (int32_t k = 0; k < i; ++k)
            if (found[k] > value)
            {
                const double swap = found[k];
                found[k] = value;
                value = swap;
            }
        found[i] = value;
    }
    return found[PROBE_COUNT / 2];
}

/* The second test. */
static otx_status
test_likeness(otx_run *run, const otx_image *image, bool *pass)
{
    otx_image level = *image;
    column *columns = NULL;
    strips s = {0};

    *pass = false;
    while (level.width > STRIP_MAX_SIDE || level.height > STRIP_MAX_SIDE)
        OTX_TRY(halve(run, &level));
    if (level.width < STRIP_MIN_SIDE)
        return OSDTEX_OK;
    OTX_TRY(sum_columns(run, &level, &columns));
    s = (strips){&level, columns, level.width / 8};

    const double border = best_likeness(&s, 0);

    *pass =
        border >= likeness_min && border >= usual_likeness(&s) - likeness_slack;
    return OSDTEX_OK;
}

/* A copy with rows and columns swapped, so that there is one axis to test. */
static otx_status
transpose(otx_run *run, const otx_image *image, otx_image *out)
{
    OTX_TRY(otx_image_create(
        run, run->scratch, image->height, image->width, 3, out));
    for (int32_t y = 0; y < out->height; ++y)
        for (int32_t x = 0; x < out->width; ++x)
            memcpy(
                otx_image_at(out, x, y), otx_image_at(image, y, x),
                3 * sizeof(float));
    return OSDTEX_OK;
}

static otx_status
test_axis(otx_run *run, const otx_image *image, int32_t axis, otx_tileable *out)
{
    otx_image turned = *image;
    steps s;

    if (axis == 1)
        OTX_TRY(transpose(run, image, &turned));
    OTX_TRY(test_steps(run, &turned, &s, &out->tiles));
    out->border = s.border;
    out->inner = s.inner;
    if (!out->tiles && s.border <= largest_ratio_max * s.largest)
        return test_likeness(run, &turned, &out->tiles);
    return OSDTEX_OK;
}

otx_status
otx_tileable_test(
    otx_run *run, const otx_image *image, int32_t axis, otx_tileable *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    *out = (otx_tileable){0};

    const otx_status status = test_axis(run, image, axis, out);

    otx_arena_release(run->scratch, mark);
    return status;
}

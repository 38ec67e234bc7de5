/* morph.c -- many small steps, of which a few are kept. */
#include "stack/morph.h"

#include "image/mask_distance.h"
#include "image/view.h"
#include "stack/feature_mask.h"
#include "stack/subsample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    STEPS_PER_SLICE = 16,
    REDISTANCE = 8, /* steps */
    CRUMB = 16,     /* texels */
    SLICES_MAX = 64
};

#define STEP 0.25 /* texels that features may travel at once */

static const char STAGE[] = "stack";

/* The fields of a morph at work. */
typedef struct work
{
    otx_run *run;
    const otx_morph_options *options;
    int32_t width, height, steps;
    const uint8_t *from, *to;
    const float *first, *last; /* signed distances of both */
    double far_in, far_out;    /* the largest of the last, both positive */
    float *phi, *next;
    float *mixed; /* for levels of equal area */
    float *order;
    double share; /* step / steps */
} work;

static double
dt_of(const work *w)
{
    return w->far_out / w->steps;
}

/* ---- a step ---------------------------------------------------------------
 */

static float
at(const work *w, const float *field, int32_t x, int32_t y)
{
    return field
        [(ptrdiff_t)otx_image_wrap(y, w->height) * w->width +
         otx_image_wrap(x, w->width)];
}

/* Between texels, whose middles are at whole numbers. */
static float
between(const work *w, float *field, double x, double y)
{
    const otx_image image = {w->width, w->height, 1, field};
    float value;

    otx_view_value(
        otx_view_of(&image, true, true), (otx_vec2){x + 0.5, y + 0.5}, &value);
    return value;
}

/* Features outside of the target move along its distances' slope. */
static float
carried(const work *w, int32_t x, int32_t y)
{
    double gx =
        0.5 * (double)(at(w, w->last, x + 1, y) - at(w, w->last, x - 1, y));
    double gy =
        0.5 * (double)(at(w, w->last, x, y + 1) - at(w, w->last, x, y - 1));
    const double length = hypot(gx, gy);
    const double by = dt_of(w) / (length > 1.0 ? length : 1.0);

    return between(w, w->phi, x - by * gx, y - by * gy);
}

/* Inside of it they grow. */
static float
grown(const work *w, int32_t x, int32_t y)
{
    const float here = at(w, w->phi, x, y);
    float most = here;

    for (int32_t j = -1; j <= 1; ++j)
        for (int32_t i = -1; i <= 1; ++i)
        {
            const double length = i && j ? 1.4142135623730951 : 1.0;
            const float f = w->options->whole_steps
                                ? 1.0f
                                : (float)fmin(dt_of(w) / length, 1.0);

            if (i || j)
                most = fmaxf(
                    most, here + f * (at(w, w->phi, x + i, y + j) - here));
        }
    return most;
}

/* Whether the sweep, which comes in from the farthest texels, is here. */
static bool
is_swept(const work *w, ptrdiff_t i)
{
    const float d = w->options->sweep_by_first ? w->first[i] : w->last[i];
    const double sup = d > 0.0f ? w->far_in : w->far_out;

    return fabs((double)d) > (1.0 - w->share) * sup;
}

static otx_status
step_row(void *context, int64_t y, otx_worker *worker)
{
    const work *w = context;
    const bool sweep = w->options->kind == OTX_MORPH_ADVECT;

    (void)worker;
    for (int32_t x = 0; x < w->width; ++x)
    {
        const ptrdiff_t i = (ptrdiff_t)y * w->width + x;

        if (sweep && is_swept(w, i))
            w->next[i] = w->last[i];
        else
            w->next[i] = w->last[i] > 0.0f ? grown(w, x, (int32_t)y)
                                           : carried(w, x, (int32_t)y);
    }
    return OSDTEX_OK;
}

static otx_status
step(work *w)
{
    float *other = w->phi;

    OTX_TRY(otx_loop_result(
        w->run, STAGE, otx_pool_for(w->run->pool, w->height, step_row, w)));
    w->phi = w->next;
    w->next = other;
    return OSDTEX_OK;
}

/* ---- levels of equal area --------------------------------------------------
 */

static int
compare_floats(const void *a, const void *b)
{
    const float p = *(const float *)a, q = *(const float *)b;

    return (p < q) - (p > q);
}

/* The texels of a blend that are highest, as many as lie between the ends. */
static void
cut_evenly(work *w, const float *adv, uint8_t *out)
{
    const int64_t texels = (int64_t)w->width * w->height;
    const double t = w->share;
    const double share = (1.0 - t) * otx_feature_mask_share(w->from, texels) +
                         t * otx_feature_mask_share(w->to, texels);
    int64_t in = (int64_t)(share * (double)texels);

    for (int64_t i = 0; i < texels; ++i)
        w->mixed[i] =
            (float)((1.0 - t) * (double)adv[i] + t * (double)w->last[i]);
    memcpy(w->order, w->mixed, (size_t)texels * sizeof *w->order);
    qsort(w->order, (size_t)texels, sizeof *w->order, compare_floats);
    in = in < 1 ? 1 : in >= texels ? texels - 1 : in;
    for (int64_t i = 0; i < texels; ++i)
        out[i] = w->mixed[i] > w->order[in];
}

/* Distances anew, where there are two sides. */
static otx_status
redistance(work *w, uint8_t *mask)
{
    const int64_t texels = (int64_t)w->width * w->height;
    double share;

    for (int64_t i = 0; i < texels; ++i)
        mask[i] = w->phi[i] > 0.0f;
    share = otx_feature_mask_share(mask, texels);
    return share > 0.0 && share < 1.0
               ? otx_mask_distance(w->run, mask, w->width, w->height, w->phi)
               : OSDTEX_OK;
}

/* ---- all steps -------------------------------------------------------------
 */

static otx_status
step_mask(work *w, int32_t n, uint8_t *out)
{
    const int64_t texels = (int64_t)w->width * w->height;

    w->share = (double)n / w->steps;
    if (n == 0 || n == w->steps)
    {
        memcpy(out, n == 0 ? w->from : w->to, (size_t)texels);
        return OSDTEX_OK;
    }
    switch (w->options->kind)
    {
    case OTX_MORPH_LINEAR:
        cut_evenly(w, w->first, out);
        return OSDTEX_OK;
    case OTX_MORPH_RELAX:
        if (n % REDISTANCE == 0)
            OTX_TRY(redistance(w, out));
        OTX_TRY(step(w));
        cut_evenly(w, w->phi, out);
        return OSDTEX_OK;
    default:
        OTX_TRY(step(w));
        for (int64_t i = 0; i < texels; ++i)
            out[i] = w->phi[i] > 0.0f;
        return OSDTEX_OK;
    }
}

static otx_status
take_steps(work *w, otx_subsample *sequence)
{
    const int64_t texels = (int64_t)w->width * w->height;
    uint8_t *mask = OTX_NEW(w->run->scratch, uint8_t, texels);

    OTX_TRY(otx_run_ok(w->run));
    memcpy(w->phi, w->first, (size_t)texels * sizeof *w->phi);
    for (int32_t n = 0; n <= w->steps; ++n)
    {
        OTX_TRY(otx_pulse(w->run));
        OTX_TRY(step_mask(w, n, mask));
        otx_subsample_put(sequence, n, mask);
    }
    return OSDTEX_OK;
}

static otx_status
keep_slices(
    work *w, const otx_subsample *sequence, const int32_t *picks,
    otx_morph *out)
{
    const int64_t texels = (int64_t)w->width * w->height;
    const int32_t slices = w->options->slices;

    out->slices = slices;
    out->steps = w->steps;
    out->kind = w->options->kind;
    out->masks = OTX_NEW(w->run->arena, uint8_t *, slices);
    OTX_TRY(otx_run_ok(w->run));
    for (int32_t m = 0; m < slices; ++m)
    {
        int32_t crumbs = 0;

        out->masks[m] = OTX_NEW(w->run->arena, uint8_t, texels);
        OTX_TRY(otx_run_ok(w->run));
        otx_subsample_get(sequence, picks[m], out->masks[m]);
        if (m == 0 || m == slices - 1)
            continue;
        OTX_TRY(otx_feature_mask_crumbs(
            w->run, out->masks[m], w->width, w->height, CRUMB, &crumbs));
        OTX_TRY(otx_feature_mask_clean(
            w->run, out->masks[m], w->width, w->height, w->options->clean));
        out->crumbs += crumbs;
    }
    return OSDTEX_OK;
}

static void
count_flips(const work *w, otx_morph *out)
{
    const int64_t texels = (int64_t)w->width * w->height;

    out->flips_most = 0;
    out->flips_mean = 0.0;
    for (int32_t m = 0; m + 1 < out->slices; ++m)
    {
        int64_t flips = 0;

        for (int64_t i = 0; i < texels; ++i)
            flips += out->masks[m][i] != out->masks[m + 1][i];
        out->flips_mean += (double)flips / (out->slices - 1);
        if (flips > out->flips_most)
            out->flips_most = flips;
    }
}

static otx_status
make_one(const work *from, otx_morph_kind kind, otx_morph *out)
{
    otx_morph_options options = *from->options;
    work w = *from;
    int32_t *picks = OTX_NEW(w.run->scratch, int32_t, options.slices);
    otx_subsample sequence;

    OTX_TRY(otx_run_ok(w.run));
    options.kind = kind;
    w.options = &options;
    OTX_TRY(otx_subsample_create(
        w.run, w.steps + 1, (int64_t)w.width * w.height, &sequence));
    OTX_TRY(take_steps(&w, &sequence));
    OTX_TRY(otx_subsample_pick(w.run, &sequence, options.slices, picks));
    OTX_TRY(keep_slices(&w, &sequence, picks, out));
    count_flips(&w, out);
    return OSDTEX_OK;
}

/* ---- set up ----------------------------------------------------------------
 */

static otx_status
check(
    otx_run *run, const uint8_t *mask, int64_t texels, const char *which,
    int32_t slices)
{
    const double share = otx_feature_mask_share(mask, texels);

    if (slices < 2 || slices > SLICES_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a stack has 2 to %d slices, not %d", SLICES_MAX, slices);
    if (share > 0.0 && share < 1.0)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, OTX_NOWHERE,
        "the feature mask of the %s picture is %s; give {masks} that show "
        "what is to change",
        which, share > 0.0 ? "full" : "empty");
}

static otx_status
set_up(otx_run *run, work *w)
{
    const int64_t texels = (int64_t)w->width * w->height;
    float *first = OTX_NEW(run->scratch, float, texels);
    float *last = OTX_NEW(run->scratch, float, texels);
    int32_t steps = STEPS_PER_SLICE * (w->options->slices - 1);

    w->phi = OTX_NEW(run->scratch, float, texels);
    w->next = OTX_NEW(run->scratch, float, texels);
    w->mixed = OTX_NEW(run->scratch, float, texels);
    w->order = OTX_NEW(run->scratch, float, texels);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_mask_distance(run, w->from, w->width, w->height, first));
    OTX_TRY(otx_mask_distance(run, w->to, w->width, w->height, last));
    for (int64_t i = 0; i < texels; ++i)
    {
        w->far_in = fmax(w->far_in, (double)last[i]);
        w->far_out = fmax(w->far_out, -(double)last[i]);
    }
    w->first = first;
    w->last = last;
    if (steps < w->far_out / STEP)
        steps = (int32_t)ceil(w->far_out / STEP);
    w->steps = steps < OTX_MORPH_STEPS_MAX ? steps : OTX_MORPH_STEPS_MAX;
    return OSDTEX_OK;
}

otx_status
otx_morph_make(
    otx_run *run, const uint8_t *from, const uint8_t *to, int32_t width,
    int32_t height, const otx_morph_options *options, otx_morph *out)
{
    const int64_t texels = (int64_t)width * height;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    work w = {
        .run = run,
        .options = options,
        .width = width,
        .height = height,
        .from = from,
        .to = to};

    *out = (otx_morph){0};
    OTX_TRY(check(run, from, texels, "first", options->slices));
    OTX_TRY(check(run, to, texels, "last", options->slices));
    OTX_TRY(set_up(run, &w));
    if (options->kind != OTX_MORPH_AUTO)
        OTX_TRY(make_one(&w, options->kind, out));
    else
    {
        otx_morph linear = {0}, advected = {0};

        OTX_TRY(make_one(&w, OTX_MORPH_LINEAR, &linear));
        OTX_TRY(make_one(&w, OTX_MORPH_ADVECT, &advected));
        *out = linear.crumbs <= advected.crumbs ? linear : advected;
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

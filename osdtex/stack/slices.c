/* slices.c -- from slice to slice. */
#include "stack/slices.h"

#include "synth/synth.h"

#include <math.h>
#include <string.h>

enum
{
    COARSEST = 32, /* texels of a side */
    MEND = 3,      /* texels that a match may be moved by */
    FEATURES = 8   /* of a texel: Lab, edges, the mask */
};

/* How far from all others before it a slice that varies takes its texels, of
 * the shorter side: 24 of 256. */
#define APART 0.09375

/* Which way is up is no matter of chance. */
#define HELD 0.01

/* What begins with a slice that is nearly right needs half the rounds. */
#define EFFORT 0.5

static const char STAGE[] = "stack";

typedef struct work
{
    otx_run *run;
    const otx_slices_input *input;
    int32_t width, height;
    int64_t texels;
    double unit; /* of the mask's channel */
    otx_pattern pattern;
    float *guide;  /* [texels * 4] */
    float *anchor; /* [texels * FEATURES] */
    float *share;
    otx_synth_match *hints, *matches;
} work;

static double
deviation(const otx_image *lab)
{
    const int64_t texels = (int64_t)lab->width * lab->height;
    double variance = 0.0;

    for (int32_t c = 0; c < 3; ++c)
    {
        double sum = 0.0, squares = 0.0;

        for (int64_t i = 0; i < texels; ++i)
        {
            const double v = (double)lab->pixels[i * lab->channels + c];

            sum += v;
            squares += v * v;
        }
        sum /= (double)texels;
        variance += squares / (double)texels - sum * sum;
    }
    return sqrt(fmax(variance, 0.0));
}

static int32_t
level_count(const work *w)
{
    const int32_t side = w->width < w->height ? w->width : w->height;
    int32_t levels = 1;

    while (levels < OTX_PATTERN_LEVELS && side >> levels >= COARSEST)
        ++levels;
    return levels;
}

static otx_status
build_pattern(work *w)
{
    const uint8_t *mask = w->input->masks[0];
    otx_image guide;

    OTX_TRY(otx_image_create(
        w->run, w->run->scratch, w->width, w->height, 1, &guide));
    for (int64_t i = 0; i < w->texels; ++i)
        guide.pixels[i] = mask[i] ? (float)w->unit : 0.0f;
    return otx_pattern_build(
        w->run, w->run->scratch,
        &(otx_pattern_input){
            .lab = w->input->lab,
            .guide = &guide,
            .wrap_x = true,
            .wrap_y = true,
            .levels = level_count(w)},
        &w->pattern);
}

static otx_synth_match
middle_of(const work *w, int32_t texel)
{
    return (otx_synth_match){
        (float)(texel % w->width) + 0.5f, (float)(texel / w->width) + 0.5f,
        1.0f, 0.0f};
}

static int32_t
texel_at(const work *w, otx_synth_match m)
{
    const int32_t x = otx_image_wrap((int32_t)floorf(m.x), w->width);
    const int32_t y = otx_image_wrap((int32_t)floorf(m.y), w->height);

    return y * w->width + x;
}

/* ---- the last step --------------------------------------------------------
 */

/* Whether a texel of the picture is what the mask of a slice asks for. */
static bool
is_right(const work *w, int32_t texel, uint8_t wanted)
{
    return (w->input->masks[0][texel] != 0) == (wanted != 0);
}

static int32_t
wrapped(const work *w, int32_t x, int32_t y)
{
    return otx_image_wrap(y, w->height) * w->width +
           otx_image_wrap(x, w->width);
}

/* The nearest texel that is right: of those that go on from a texel beside this
 * one, else of those around its own. -1: there is none. */
static int32_t
find_right(const work *w, const int32_t *from, int32_t texel, uint8_t wanted)
{
    const int32_t x = texel % w->width, y = texel / w->width;
    int32_t best = -1, least = INT32_MAX;

    for (int32_t dy = -MEND; dy <= MEND; ++dy)
        for (int32_t dx = -MEND; dx <= MEND; ++dx)
        {
            const int32_t beside = from[wrapped(w, x + dx, y + dy)];
            const int32_t on =
                wrapped(w, beside % w->width - dx, beside / w->width - dy);
            const int32_t around = wrapped(
                w, from[texel] % w->width + dx, from[texel] / w->width + dy);
            const int32_t far = 2 * (dx * dx + dy * dy);

            if (far < least && is_right(w, on, wanted))
            {
                least = far;
                best = on;
            }
            if (far + 1 < least && is_right(w, around, wanted))
            {
                least = far + 1;
                best = around;
            }
        }
    return best;
}

/* What lies on the other side of the mask moves over by a texel or a few:
 * joints are no wider. */
static otx_status
mend_mask(const work *w, const uint8_t *mask, int32_t *texels)
{
    const otx_arena_mark mark = otx_arena_here(w->run->scratch);
    int32_t *from = OTX_NEW(w->run->scratch, int32_t, w->texels);

    OTX_TRY(otx_run_ok(w->run));
    memcpy(from, texels, (size_t)w->texels * sizeof *from);
    for (int32_t i = 0; i < w->texels; ++i)
    {
        int32_t found = -1;

        if (!is_right(w, from[i], mask[i]))
            found = find_right(w, from, i, mask[i]);
        if (found >= 0)
            texels[i] = found;
    }
    otx_arena_release(w->run->scratch, mark);
    return OSDTEX_OK;
}

/* ---- from slice to slice --------------------------------------------------
 */

/* Features of the slice before, where the mask stays as it was. */
static void
draw_to(work *w, const int32_t *before, const uint8_t *was, const uint8_t *is)
{
    const otx_pattern_level *fine = &w->pattern.levels[0];

    for (int64_t i = 0; i < w->texels; ++i)
    {
        const int32_t x = before[i] % w->width, y = before[i] / w->width;
        const otx_quad *value =
            fine->values + ((ptrdiff_t)(y + OTX_PATTERN_RIM) * fine->stride +
                            x + OTX_PATTERN_RIM) *
                               w->pattern.quads;

        memcpy(w->anchor + FEATURES * i, value, 2 * sizeof *value);
        w->share[i] = was[i] == is[i] ? (float)w->input->anchor : 0.0f;
        w->guide[4 * i] = is[i] ? (float)w->unit : 0.0f;
        w->hints[i] = w->matches[i] = middle_of(w, before[i]);
    }
}

static otx_status
make_slice(work *w, int32_t m, const int32_t *before, int32_t *out)
{
    const otx_synth_chart chart = {
        .width = w->width,
        .height = w->height,
        .wrap_x = true,
        .wrap_y = true,
        .guide = w->guide,
        .anchor = w->anchor,
        .anchor_share = w->share,
        .hints = w->hints,
        .matches = w->matches};
    otx_synth_options options = otx_synth_mending();

    options.levels = w->pattern.level_count;
    options.turn = 0.0;
    options.effort = EFFORT;
    options.stage = "slice";
    options.seed = w->input->seed + (uint64_t)m;
    draw_to(w, before, w->input->masks[m - 1], w->input->masks[m]);
    OTX_TRY(otx_synth_run(w->run, &w->pattern, &chart, 1, &options));
    for (int64_t i = 0; i < w->texels; ++i)
        out[i] = texel_at(w, w->matches[i]);
    return mend_mask(w, w->input->masks[m], out);
}

/* From nothing, under the first mask, away from slices 0 .. m - 1. */
static otx_status
vary_slice(work *w, int32_t m, const float *field, int32_t *const *before)
{
    const int32_t side = w->width < w->height ? w->width : w->height;
    const otx_synth_chart chart = {
        .width = w->width,
        .height = w->height,
        .wrap_x = true,
        .wrap_y = true,
        .field = field,
        .guide = w->guide,
        .barred = (const int32_t *const *)before,
        .barred_count = m,
        .matches = w->matches};
    otx_synth_options options = otx_synth_making();

    options.levels = w->pattern.level_count;
    options.turn = 0.0;
    options.tolerance = HELD;
    options.apart = APART * side;
    options.stage = "slice";
    options.seed = w->input->seed + (uint64_t)m;
    OTX_TRY(otx_synth_run(w->run, &w->pattern, &chart, 1, &options));
    for (int64_t i = 0; i < w->texels; ++i)
        before[m][i] = texel_at(w, w->matches[i]);
    return mend_mask(w, w->input->masks[0], before[m]);
}

static otx_status
set_up(otx_run *run, const otx_slices_input *input, work *w)
{
    *w = (work){
        .run = run,
        .input = input,
        .width = input->lab->width,
        .height = input->lab->height};
    w->texels = (int64_t)w->width * w->height;
    w->unit = input->mask_weight * deviation(input->lab);
    w->guide = OTX_ZNEW(run->scratch, float, 4 * w->texels);
    w->anchor = OTX_NEW(run->scratch, float, FEATURES * w->texels);
    w->share = OTX_NEW(run->scratch, float, w->texels);
    w->hints = OTX_NEW(run->scratch, otx_synth_match, w->texels);
    w->matches = OTX_NEW(run->scratch, otx_synth_match, w->texels);
    OTX_TRY(otx_run_ok(run));
    return build_pattern(w);
}

otx_status
otx_slices_make(otx_run *run, const otx_slices_input *input, int32_t **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    work w;

    OTX_TRY(set_up(run, input, &w));
    for (int32_t m = 0; m < input->count; ++m)
    {
        const otx_arena_mark slice = otx_arena_here(run->scratch);

        out[m] = OTX_NEW(run->arena, int32_t, w.texels);
        OTX_TRY(otx_run_ok(run));
        for (int64_t i = 0; m == 0 && i < w.texels; ++i)
            out[m][i] = (int32_t)i;
        if (m > 0)
            OTX_TRY(make_slice(&w, m, out[m - 1], out[m]));
        otx_arena_release(run->scratch, slice);
        OTX_TRY(otx_progress(run, STAGE, (double)m / input->count));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_slices_vary(otx_run *run, const otx_slices_input *input, int32_t **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    float *field;
    work w;

    OTX_TRY(set_up(run, input, &w));
    field = OTX_ZNEW(run->scratch, float, 2 * w.texels);
    for (int32_t m = 0; m < input->count; ++m)
        out[m] = OTX_NEW(run->arena, int32_t, w.texels);
    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < w.texels; ++i)
    {
        out[0][i] = (int32_t)i;
        field[2 * i] = 1.0f;
        w.guide[4 * i] = input->masks[0][i] ? (float)w.unit : 0.0f;
    }
    for (int32_t m = 1; m < input->count; ++m)
    {
        const otx_arena_mark slice = otx_arena_here(run->scratch);

        OTX_TRY(vary_slice(&w, m, field, out));
        otx_arena_release(run->scratch, slice);
        OTX_TRY(otx_progress(run, STAGE, (double)m / input->count));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* judge.c -- whether what is seen exists in the exemplar, window by window. */
#include "synth/judge.h"

#include "base/random.h"
#include "base/sort.h"
#include "image/pyramid.h"
#include "synth/nearest.h"

#include <stdlib.h>
#include <string.h>

#define WHOLE 0.75f /* of a window that has to be there */

enum
{
    STAGE_SCATTER = 0x7ffe0000 /* of random numbers; no pass has it */
};

/* Three texels by three around each, so that the grids that two pictures were
 * reduced on make less difference; of what is there.
 *
 *   kinds  VOID is not; NULL: all is there */
static void
blur_texel(
    const otx_quad *in, const uint8_t *kinds, int32_t quads, ptrdiff_t at,
    ptrdiff_t up, otx_quad *out)
{
    float weight = 0.0f;

    for (int32_t q = 0; q < quads; ++q)
        out[q] = (otx_quad){0.0f, 0.0f, 0.0f, 0.0f};
    for (int32_t j = -1; j <= 1; ++j)
        for (int32_t i = -1; i <= 1; ++i)
        {
            const ptrdiff_t from = at + j * up + i;
            const float w = (float)((2 - abs(i)) * (2 - abs(j)));

            if (kinds && kinds[from] == OTX_SYNTH_VOID)
                continue;
            for (int32_t q = 0; q < quads; ++q)
                out[q] += in[from * quads + q] * w;
            weight += w;
        }
    for (int32_t q = 0; q < quads && weight > 0.0f; ++q)
        out[q] /= weight;
}

static otx_status
blur(
    otx_run *run, const otx_quad *in, const uint8_t *kinds, int32_t quads,
    int32_t width, int32_t height, otx_quad **out)
{
    *out = OTX_NEW(run->scratch, otx_quad, (int64_t)width * height * quads);
    if (!*out)
        return otx_fail_memory(run, "judge");
    memcpy(
        *out, in, (size_t)width * (size_t)height * (size_t)quads * sizeof *in);
    for (int32_t y = 1; y < height - 1; ++y)
        for (int32_t x = 1; x < width - 1; ++x)
        {
            const ptrdiff_t at = (ptrdiff_t)y * width + x;

            blur_texel(in, kinds, quads, at, width, *out + at * quads);
        }
    return OSDTEX_OK;
}

/* The pattern with one level blurred, in run->scratch. */
static otx_status
blur_pattern(
    otx_run *run, const otx_pattern *pattern, int32_t level, otx_pattern *out)
{
    otx_pattern_level *l = &out->levels[level];
    otx_quad *values;

    *out = *pattern;
    OTX_TRY(blur(
        run, l->values, NULL, pattern->quads, l->stride,
        l->height + 2 * OTX_PATTERN_RIM, &values));
    l->values = values;
    return OSDTEX_OK;
}

static int32_t
level_of(const otx_pattern *pattern, const otx_judge_options *options)
{
    const int32_t most = pattern->level_count - 1;

    return options->level < most ? options->level : most;
}

static otx_status
search(
    otx_run *run, otx_canvas *const *canvas, const otx_synth_chart *chart,
    const otx_judge_options *options, float apart)
{
    const otx_pattern *p = (*canvas)->pattern;
    otx_nearest_pass pass = {
        .seed = options->seed,
        .stirred = true,
        .reach = p->width > p->height ? p->width : p->height,
        .turn = OTX_PI,
        .tolerance = OTX_PI,
        .apart = apart};

    for (int32_t i = 0; i < options->passes; ++i)
    {
        pass.refresh = i == 0;
        pass.number = (uint32_t)i;
        OTX_TRY(otx_nearest_search(run, canvas, chart, 1, &pass));
    }
    return OSDTEX_OK;
}

static otx_status
canvas_of(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart,
    const otx_judge_options *options, otx_canvas_stack *stack, otx_canvas **out)
{
    const int32_t level = level_of(pattern, options);
    otx_synth_options o = otx_synth_mending();

    o.radius = o.coarse_radius = options->radius;
    OTX_TRY(otx_canvas_build(run, pattern, chart, &o, level + 1, stack));
    *out = &stack->levels[level];
    otx_canvas_seek_own(*out);
    return blur(
        run, (*out)->colors, (*out)->kinds, pattern->quads, (*out)->stride,
        (*out)->height + 2 * OTX_CANVAS_RIM, &(*out)->colors);
}

static otx_status
judge_chart(
    otx_run *run, const otx_pattern *pattern, const otx_pattern *blurred,
    const otx_synth_chart *chart, const otx_judge_options *options,
    otx_judged *out)
{
    const int32_t side = 2 * options->radius + 1;
    otx_canvas_stack stack;
    otx_canvas *c;

    OTX_TRY(canvas_of(run, pattern, chart, options, &stack, &c));
    c->pattern = blurred;
    OTX_TRY(search(run, &c, chart, options, 0.0f));
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            out->distances[(int64_t)y * c->width + x] =
                c->uses[at] == OTX_CANVAS_SEEK &&
                        c->masses[at] >= WHOLE * (float)(side * side)
                    ? sqrtf(c->costs[at])
                    : -1.0f;
        }
    return OSDTEX_OK;
}

otx_status
otx_judge_windows(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *charts,
    int32_t count, const otx_judge_options *options, otx_judged *out)
{
    const int32_t level = level_of(pattern, options);
    otx_pattern blurred;

    for (int32_t k = 0; k < count; ++k)
    {
        const int32_t w = charts[k].width, h = charts[k].height;

        out[k] = (otx_judged){0};
        if (w == 0)
            continue;
        out[k].width = otx_pyramid_side(w, level);
        out[k].height = otx_pyramid_side(h, level);
        out[k].step_x = (float)w / (float)out[k].width;
        out[k].step_y = (float)h / (float)out[k].height;
        out[k].distances =
            OTX_NEW(run->scratch, float, (int64_t)out[k].width *out[k].height);
    }
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(blur_pattern(run, pattern, level, &blurred));
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);

        if (charts[k].width > 0)
            OTX_TRY(judge_chart(
                run, pattern, &blurred, &charts[k], options, &out[k]));
        otx_arena_release(run->scratch, mark);
        OTX_TRY(otx_progress(run, "judge", (k + 1.0) / count));
    }
    return OSDTEX_OK;
}

/* Matches by chance, none of them near its own place. */
static void
scatter(const otx_canvas *c, float apart, uint64_t seed, otx_synth_match *out)
{
    const otx_pattern *p = c->pattern;

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            otx_synth_match m = otx_nearest_random(
                p, NULL, 0.0,
                otx_random_bits(seed, STAGE_SCATTER, (uint64_t)at));

            if (otx_nearest_is_near(c, x, y, m, apart))
            {
                m.x += m.x < 0.5f * (float)p->width ? apart : -apart;
                m.y += m.y < 0.5f * (float)p->height ? apart : -apart;
            }
            out[at] = m;
        }
}

static otx_status
judge_itself(
    otx_run *run, const otx_pattern *pattern, float apart,
    const otx_judge_options *options, double quantile, double *mean,
    double *at_quantile)
{
    const int64_t texels = (int64_t)pattern->width * pattern->height;
    otx_synth_match *matches = OTX_NEW(run->scratch, otx_synth_match, texels);
    const otx_synth_chart chart = {
        .width = pattern->width, .height = pattern->height, .matches = matches};
    otx_canvas_stack stack;
    otx_pattern blurred;
    otx_canvas *c;
    double *values;
    size_t n = 0;

    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < texels; ++i)
        matches[i] = (otx_synth_match){
            (float)(i % pattern->width) + 0.5f,
            (float)(i / pattern->width) + 0.5f, 1.0f, 0.0f};
    OTX_TRY(canvas_of(run, pattern, &chart, options, &stack, &c));
    OTX_TRY(blur_pattern(run, pattern, c->level, &blurred));
    c->pattern = &blurred;
    scatter(c, apart, options->seed, c->matches);
    OTX_TRY(search(run, &c, &chart, options, apart));
    values = OTX_NEW(run->scratch, double, (int64_t)c->width * c->height);
    OTX_TRY(otx_run_ok(run));
    *mean = 0.0;
    for (int32_t y = c->radius; y < c->height - c->radius; ++y)
        for (int32_t x = c->radius; x < c->width - c->radius; ++x)
        {
            values[n] = sqrt(c->costs[otx_canvas_index(c, x, y)]);
            *mean += values[n++];
        }
    *mean = n > 0 ? *mean / (double)n : 0.0;
    otx_sort_doubles(values, n);
    *at_quantile = n > 0 ? values[(size_t)(quantile * (double)(n - 1))] : 0.0;
    return OSDTEX_OK;
}

otx_status
otx_judge_itself(
    otx_run *run, const otx_pattern *pattern, double apart,
    const otx_judge_options *options, double quantile, double *mean,
    double *at_quantile)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_status status = judge_itself(
        run, pattern, (float)apart, options, quantile, mean, at_quantile);

    otx_arena_release(run->scratch, mark);
    return status;
}

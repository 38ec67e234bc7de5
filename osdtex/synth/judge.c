/* judge.c -- whether what is seen exists in the exemplar, window by window. */
#include "synth/judge.h"

#include "base/random.h"
#include "base/sort.h"
#include "image/pyramid.h"
#include "synth/nearest.h"

#define WHOLE 0.75f /* of a window that has to be there */

enum
{
    STAGE_SCATTER = 0x7ffe0000 /* of random numbers; no pass has it */
};

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
    const int32_t most = pattern->level_count - 1;
    const int32_t level = options->level < most ? options->level : most;
    otx_synth_options o = otx_synth_mending();

    o.radius = o.coarse_radius = options->radius;
    OTX_TRY(otx_canvas_build(run, pattern, chart, &o, level + 1, stack));
    *out = &stack->levels[level];
    otx_canvas_seek_own(*out);
    return OSDTEX_OK;
}

static otx_status
judge_chart(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart,
    const otx_judge_options *options, otx_judged *out)
{
    const int32_t side = 2 * options->radius + 1;
    otx_canvas_stack stack;
    otx_canvas *c;

    OTX_TRY(canvas_of(run, pattern, chart, options, &stack, &c));
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
    const int32_t most = pattern->level_count - 1;
    const int32_t level = options->level < most ? options->level : most;

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
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);

        if (charts[k].width > 0)
            OTX_TRY(judge_chart(run, pattern, &charts[k], options, &out[k]));
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
    otx_canvas *c;
    double *values;
    size_t n = 0;

    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < texels; ++i)
        matches[i] = (otx_synth_match){
            (float)(i % pattern->width) + 0.5f,
            (float)(i / pattern->width) + 0.5f, 1.0f, 0.0f};
    OTX_TRY(canvas_of(run, pattern, &chart, options, &stack, &c));
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

/* canvases.h -- a pattern of noise, and charts at work on it. */
#ifndef OTX_TESTS_CANVASES_H
#define OTX_TESTS_CANVASES_H

#include "support.h"

#include "base/random.h"
#include "synth/canvas.h"

enum
{
    PATTERN_SIDE = 64
};

/* Smooth waves that repeat nowhere under noise; on a torus where it wraps. */
static inline otx_pattern *
make_pattern(otx_run *run, int32_t levels, bool wrap)
{
    otx_pattern *pattern = OTX_ZNEW(run->arena, otx_pattern, 1);
    otx_image lab;

    assert_int_equal(
        otx_image_create(run, run->arena, PATTERN_SIDE, PATTERN_SIDE, 3, &lab),
        OSDTEX_OK);
    for (int32_t i = 0; i < PATTERN_SIDE * PATTERN_SIDE; ++i)
        for (int c = 0; c < 3; ++c)
            lab.pixels[3 * i + c] =
                (float)(40.0 + 20.0 * sin(0.11 * (i % PATTERN_SIDE) * (c + 1)) + 15.0 * cos(0.17 * (i / PATTERN_SIDE)) + 10.0 * otx_random_unit(3, (uint32_t)c, (uint64_t)i));
    assert_int_equal(
        otx_pattern_build(
            run, run->arena,
            &(otx_pattern_input){
                .lab = &lab,
                .wrap_x = wrap,
                .wrap_y = wrap,
                .edge = 0.7,
                .levels = levels},
            pattern),
        OSDTEX_OK);
    return pattern;
}

/* The match that shows the pattern as it is at texel (x, y) of a chart. */
static inline otx_synth_match
plain_match(double x, double y)
{
    return (otx_synth_match){(float)(x + 0.5), (float)(y + 0.5), 1.0f, 0.0f};
}

/* Matches of a chart that show the pattern as it is. */
static inline otx_synth_match *
plain_matches(otx_run *run, int32_t width, int32_t height)
{
    otx_synth_match *matches =
        OTX_NEW(run->arena, otx_synth_match, (int64_t)width * height);

    for (int32_t i = 0; i < width * height; ++i)
        matches[i] = plain_match(i % width, i / width);
    return matches;
}

/* Kinds by chance, so many of 16 each; the rest is FREE. */
static inline uint8_t *
random_kinds(
    otx_run *run, int32_t count, uint32_t voids, uint32_t frozen,
    uint32_t collar)
{
    uint8_t *kinds = OTX_NEW(run->arena, uint8_t, count);

    for (int32_t i = 0; i < count; ++i)
    {
        const uint32_t die =
            (uint32_t)(otx_random_bits(11, 4, (uint64_t)i) % 16);

        kinds[i] = die < voids                     ? OTX_SYNTH_VOID
                   : die < voids + frozen          ? OTX_SYNTH_FROZEN
                   : die < voids + frozen + collar ? OTX_SYNTH_COLLAR
                                                   : OTX_SYNTH_FREE;
    }
    return kinds;
}

/* Canvases of all levels, matches as they are given. */
static inline otx_canvas_stack *
make_canvases(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart,
    int32_t levels)
{
    otx_canvas_stack *stack = OTX_ZNEW(run->arena, otx_canvas_stack, 1);
    const otx_synth_options options = otx_synth_mending();

    assert_int_equal(
        otx_canvas_build(run, pattern, chart, &options, levels, stack),
        OSDTEX_OK);
    return stack;
}

#endif

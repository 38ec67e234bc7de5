/* test_start.c -- what the coarsest level begins with: what was given, or what
 * of several starts came out best. */
#include "unit/synth/canvases.h"

#include "synth/start.h"
#include "synth/window_cost.h"

enum
{
    SIDE = 40,
    COUNT = SIDE * SIDE
};

typedef struct scene
{
    otx_synth_chart chart;
    otx_synth_options options;
    otx_canvas_stack *stack;
    otx_canvas *canvases[1];
    otx_collar collars[1];
    otx_occurrence usage;
    otx_maker maker;
} scene;

/* A copy of the pattern with a hole that is to be made, lost or not. */
static scene *
make_scene(otx_run *run, bool given, int32_t starts)
{
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    const otx_pattern *pattern = make_pattern(run, 1, false);
    otx_synth_match *matches = plain_matches(run, SIDE, SIDE);
    uint8_t *kinds = OTX_NEW(run->arena, uint8_t, COUNT);

    for (int32_t i = 0; i < COUNT; ++i)
    {
        const bool hole = abs(i % SIDE - 20) < 8 && abs(i / SIDE - 20) < 8;

        kinds[i] = hole ? OTX_SYNTH_FREE : OTX_SYNTH_FROZEN;
        if (hole)
            matches[i] = plain_match(8, 50);
    }
    s->chart = (otx_synth_chart){
        .width = SIDE, .height = SIDE, .kinds = kinds, .matches = matches};
    s->options = otx_synth_mending();
    s->options.given = given;
    s->options.starts = starts;
    s->options.seed = 3;
    s->stack = OTX_ZNEW(run->arena, otx_canvas_stack, 1);
    assert_int_equal(
        otx_canvas_build(run, pattern, &s->chart, &s->options, 1, s->stack),
        OSDTEX_OK);
    s->canvases[0] = &s->stack->levels[0];
    s->maker = (otx_maker){
        .run = run,
        .pattern = pattern,
        .charts = &s->chart,
        .count = 1,
        .options = &s->options,
        .level_count = 1,
        .stacks = s->stack,
        .finest = s->canvases,
        .canvases = s->canvases,
        .collars = s->collars,
        .usage = &s->usage,
        .all = 1e9};
    return s;
}

static void
start(scene *s)
{
    assert_int_equal(otx_start_make(&s->maker, 0), OSDTEX_OK);
}

static otx_synth_match
match_at(const scene *s, int32_t x, int32_t y)
{
    return s->canvases[0]->matches[otx_canvas_index(s->canvases[0], x, y)];
}

static void
what_is_given_is_left(void **state)
{
    scene *s = make_scene(*state, true, 1);

    start(s);
    assert_float_equal(match_at(s, 20, 20).x, 8.5, 0.0);
    assert_float_equal(match_at(s, 3, 4).x, 3.5, 0.0);
}

/* What is frozen keeps its matches, the rest has others, all on the pattern. */
static void
one_start_is_by_chance(void **state)
{
    scene *s = make_scene(*state, false, 1);
    int32_t other = 0;

    start(s);
    for (int32_t i = 0; i < COUNT; ++i)
    {
        const otx_synth_match m = match_at(s, i % SIDE, i / SIDE);

        assert_true(m.x >= 0.0f && m.x <= PATTERN_SIDE);
        assert_true(m.y >= 0.0f && m.y <= PATTERN_SIDE);
        if (s->chart.kinds[i] == OTX_SYNTH_FROZEN)
            assert_float_equal(m.x, (i % SIDE) + 0.5, 0.0);
        else
            other += m.x != 8.5f;
    }
    assert_true(other > 200);
}

/* Mean distance of the windows that have a part in the hole. */
static double
distance(const scene *s)
{
    const otx_canvas *c = s->canvases[0];
    double sum = 0.0, count = 0.0;

    for (int32_t i = 0; i < COUNT; ++i)
    {
        const ptrdiff_t at = otx_canvas_index(c, i % SIDE, i / SIDE);

        if (c->uses[at] != OTX_CANVAS_SEEK)
            continue;
        sum += otx_window_cost(
            c, at, otx_window_frame_of(c, at, c->matches[at]), INFINITY);
        count += 1.0;
    }
    return sum / count;
}

/* More starts can only come out better, and then nothing of them is left but
 * the best one: weights are whole again. */
static void
the_best_of_several_is_kept(void **state)
{
    scene *chance = make_scene(*state, false, 1);
    scene *few = make_scene(*state, false, 2);
    scene *many = make_scene(*state, false, 6);

    start(chance);
    start(few);
    start(many);
    assert_true(distance(few) < 0.5 * distance(chance));
    assert_true(distance(many) <= 1.01 * distance(few));
    for (int32_t i = 0; i < COUNT; ++i)
        assert_float_equal(
            many->canvases[0]->weights[otx_canvas_index(
                many->canvases[0], i % SIDE, i / SIDE)],
            1.0, 0.0);
}

/* The given one is among them: where it is right it wins. */
static void
what_is_given_is_one_of_several(void **state)
{
    scene *s = make_scene(*state, true, 3);

    for (int32_t i = 0; i < COUNT; ++i)
        s->canvases[0]
            ->matches[otx_canvas_index(s->canvases[0], i % SIDE, i / SIDE)] =
            plain_match(i % SIDE, i / SIDE);
    for (int32_t i = 0; i < COUNT; ++i)
    {
        const ptrdiff_t at =
            otx_canvas_index(s->canvases[0], i % SIDE, i / SIDE);

        otx_pattern_at(
            &s->maker.pattern->levels[0], 1, (float)(i % SIDE) + 0.5f,
            (float)(i / SIDE) + 0.5f, &s->canvases[0]->colors[at]);
    }
    start(s);
    for (int32_t i = 0; i < COUNT; ++i)
    {
        assert_float_equal(
            match_at(s, i % SIDE, i / SIDE).x, (i % SIDE) + 0.5, 1e-3);
        assert_float_equal(
            match_at(s, i % SIDE, i / SIDE).y, (i / SIDE) + 0.5, 1e-3);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_is_given_is_left),
        test_with_run(one_start_is_by_chance),
        test_with_run(the_best_of_several_is_kept),
        test_with_run(what_is_given_is_one_of_several),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

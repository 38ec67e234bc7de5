/* test_nearest.c -- passes of the search: no window is worse off, what one has
 * found its neighbours find, and whatever is held to is kept. */
#include "unit/synth/canvases.h"

#include "synth/nearest.h"
#include "synth/window_cost.h"

enum
{
    SIDE = 48,
    COUNT = SIDE * SIDE
};

typedef struct scene
{
    otx_run *run;
    const otx_pattern *pattern;
    otx_synth_chart chart;
    otx_canvas *canvas;
} scene;

/* A copy of the pattern whose matches are lost: colours are right, and where
 * they are from is by chance. */
static scene
make_scene(otx_run *run, const float *field, double tolerance)
{
    scene s = {.run = run, .pattern = make_pattern(run, 1, false)};

    s.chart = (otx_synth_chart){
        .width = SIDE,
        .height = SIDE,
        .field = field,
        .matches = plain_matches(run, SIDE, SIDE)};
    s.canvas = make_canvases(run, s.pattern, &s.chart, 1)->levels;
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(s.canvas, x, y);

            s.canvas->matches[at] = otx_nearest_random(
                s.pattern, field ? field + 2 * (y * SIDE + x) : NULL, tolerance,
                otx_random_bits(2, 1, (uint64_t)at));
        }
    return s;
}

static float
cost_at(const otx_canvas *c, ptrdiff_t at)
{
    return otx_window_cost(
        c, at, otx_window_frame_of(c, at, c->matches[at]), INFINITY);
}

static void
search(scene *s, const otx_nearest_pass *pass)
{
    assert_int_equal(
        otx_nearest_search(s->run, &s->canvas, &s->chart, 1, pass), OSDTEX_OK);
}

static otx_nearest_pass
pass_number(uint32_t number)
{
    return (otx_nearest_pass){
        .seed = 1,
        .number = number,
        .refresh = number == 0,
        .stirred = true,
        .reach = PATTERN_SIDE,
        .turn = OTX_PI,
        .tolerance = OTX_PI};
}

static void
no_window_is_worse_off(void **state)
{
    scene s = make_scene(*state, NULL, OTX_PI);
    float *before = OTX_NEW(s.run->arena, float, COUNT);
    double sum = 0.0, first = 0.0;

    for (int32_t i = 0; i < COUNT; ++i)
        first +=
            cost_at(s.canvas, otx_canvas_index(s.canvas, i % SIDE, i / SIDE));
    for (uint32_t n = 0; n < 4; ++n)
    {
        const otx_nearest_pass pass = pass_number(n);

        for (int32_t i = 0; i < COUNT; ++i)
            before[i] = cost_at(
                s.canvas, otx_canvas_index(s.canvas, i % SIDE, i / SIDE));
        search(&s, &pass);
        sum = 0.0;
        for (int32_t i = 0; i < COUNT; ++i)
        {
            const ptrdiff_t at = otx_canvas_index(s.canvas, i % SIDE, i / SIDE);
            const float cost = cost_at(s.canvas, at);

            /* What is said of a match is its cost. */
            assert_float_equal(s.canvas->costs[at], cost, 1e-3f * cost + 1e-4f);
            /* A tie with a neighbour may take a hundredth more, three times. */
            assert_true(cost <= 1.04f * before[i] + 1e-4f);
            sum += cost;
        }
    }
    assert_true(sum < 0.2 * first);
}

/* One texel knows where it is from. Rows of a strip hear of it in one pass,
 * those of the other strips in a pass each. */
static void
what_one_has_found_its_neighbours_find(void **state)
{
    scene s = make_scene(*state, NULL, OTX_PI);
    otx_nearest_pass pass = pass_number(0);

    pass.reach = 0.0;
    s.canvas->matches[otx_canvas_index(s.canvas, 6, 6)] = plain_match(6, 6);
    for (int32_t strip = 0; strip < SIDE / OTX_CANVAS_STRIP; ++strip)
    {
        pass.number = (uint32_t)(2 * strip); /* rightwards and up */
        pass.refresh = strip == 0;
        search(&s, &pass);
        for (int32_t y = 6; y < (strip + 1) * OTX_CANVAS_STRIP; ++y)
            for (int32_t x = 6; x < SIDE; ++x)
            {
                const otx_synth_match m =
                    s.canvas->matches[otx_canvas_index(s.canvas, x, y)];

                assert_float_equal(m.x, x + 0.5, 1e-3);
                assert_float_equal(m.y, y + 0.5, 1e-3);
                assert_float_equal(m.c, 1.0, 1e-5);
            }
    }
}

static void
angles_keep_to_a_field(void **state)
{
    otx_run *run = *state;
    const double tolerance = 0.1;
    float *field = OTX_NEW(run->arena, float, 2 * COUNT);
    scene s;

    for (int32_t i = 0; i < COUNT; ++i)
    {
        field[2 * i] = (float)cos(0.05 * (i % SIDE));
        field[2 * i + 1] = (float)sin(0.05 * (i % SIDE));
    }
    s = make_scene(run, field, tolerance);
    for (uint32_t n = 0; n < 3; ++n)
    {
        otx_nearest_pass pass = pass_number(n);

        pass.tolerance = tolerance;
        search(&s, &pass);
    }
    for (int32_t i = 0; i < COUNT; ++i)
    {
        const otx_synth_match m =
            s.canvas->matches[otx_canvas_index(s.canvas, i % SIDE, i / SIDE)];

        assert_true(
            m.c * field[2 * i] + m.s * field[2 * i + 1] >=
            cos(tolerance) - 1e-5);
    }
}

/* Windows lie on a pattern that does not tile with all that they have. */
static void
no_window_leaves_the_pattern(void **state)
{
    scene s = make_scene(*state, NULL, OTX_PI);

    for (uint32_t n = 0; n < 3; ++n)
    {
        const otx_nearest_pass pass = pass_number(n);

        search(&s, &pass);
    }
    for (int32_t i = 0; i < COUNT; ++i)
    {
        const ptrdiff_t at = otx_canvas_index(s.canvas, i % SIDE, i / SIDE);

        if (s.canvas->moved[at])
            assert_true(otx_window_is_inside(
                s.canvas,
                otx_window_frame_of(s.canvas, at, s.canvas->matches[at])));
    }
}

/* Where a copy of the pattern begins as it is, a hint that leads elsewhere is
 * taken only if what there is has been taken far more often. */
static void
what_is_overused_costs_more(void **state)
{
    static const int32_t OWN[] = {1, 100000, 100000}, OTHER[] = {1, 1, 100000};
    scene s = make_scene(*state, NULL, OTX_PI);
    otx_occurrence usage = {.weight = 1.0f};
    otx_nearest_pass pass = pass_number(0);
    otx_synth_match *hints = OTX_NEW(s.run->arena, otx_synth_match, COUNT);
    const otx_synth_match own = plain_match(20, 20),
                          other = plain_match(44, 40);

    for (int32_t i = 0; i < COUNT; ++i)
        hints[i] = other;
    s.chart.hints = hints;
    pass.hint = true;
    pass.reach = 0.0;
    pass.usage = &usage;
    for (int i = 0; i < 3; ++i)
    {
        usage.counts[otx_occurrence_cell(s.pattern, own)] = OWN[i];
        usage.counts[otx_occurrence_cell(s.pattern, other)] = OTHER[i];
        for (int32_t y = 0; y < SIDE; ++y)
            for (int32_t x = 0; x < SIDE; ++x)
                s.canvas->matches[otx_canvas_index(s.canvas, x, y)] =
                    plain_match(x, y);
        search(&s, &pass);
        assert_float_equal(
            s.canvas->matches[otx_canvas_index(s.canvas, 20, 20)].x,
            i == 1 ? other.x : own.x, 1e-4);
    }
}

static void
places_by_chance_are_everywhere(void **state)
{
    const otx_pattern *pattern = make_pattern(*state, 1, false);
    const float field[2] = {0.6f, 0.8f};
    int32_t seen[16] = {0};

    for (uint64_t i = 0; i < 4096; ++i)
    {
        const uint64_t bits = otx_random_bits(9, 9, i);
        const otx_synth_match m = otx_nearest_random(pattern, NULL, 0.0, bits);
        const otx_synth_match held =
            otx_nearest_random(pattern, field, 0.2, bits);

        assert_true(m.x >= 0.0f && m.x < PATTERN_SIDE);
        assert_true(m.y >= 0.0f && m.y < PATTERN_SIDE);
        assert_float_equal(m.c * m.c + m.s * m.s, 1.0, 1e-5);
        assert_true(held.c * field[0] + held.s * field[1] >= cos(0.2) - 1e-5);
        ++seen
            [(m.x > PATTERN_SIDE / 2) + 2 * (m.y > PATTERN_SIDE / 2) +
             4 * (m.c > 0.0f) + 8 * (m.s > 0.0f)];
    }
    for (int k = 0; k < 16; ++k)
        assert_true(seen[k] > 180 && seen[k] < 340);
}

static void
matches_do_not_depend_on_threads(void **state)
{
    scene first = make_scene(*state, NULL, OTX_PI);

    for (uint32_t n = 0; n < 2; ++n)
    {
        const otx_nearest_pass pass = pass_number(n);

        search(&first, &pass);
    }
    for (int32_t threads = 1; threads <= 8; threads += 7)
    {
        otx_run *run = test_run_create_with(NULL, threads);
        scene s = make_scene(run, NULL, OTX_PI);

        for (uint32_t n = 0; n < 2; ++n)
        {
            const otx_nearest_pass pass = pass_number(n);

            search(&s, &pass);
        }
        assert_memory_equal(
            s.canvas->matches, first.canvas->matches,
            (size_t)s.canvas->stride * SIDE * sizeof *s.canvas->matches);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(no_window_is_worse_off),
        test_with_run(what_one_has_found_its_neighbours_find),
        test_with_run(angles_keep_to_a_field),
        test_with_run(no_window_leaves_the_pattern),
        test_with_run(what_is_overused_costs_more),
        test_with_run(places_by_chance_are_everywhere),
        test_with_run(matches_do_not_depend_on_threads),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_canvas.c -- levels of a chart, against what their header says of them,
 * texel by texel. */
#include "unit/synth/canvases.h"

enum
{
    WIDTH = 40,
    HEIGHT = 32,
    COUNT = WIDTH * HEIGHT
};

static otx_synth_chart
make_chart(otx_run *run)
{
    return (otx_synth_chart){
        .width = WIDTH,
        .height = HEIGHT,
        .kinds = random_kinds(run, COUNT, 4, 5, 3),
        .matches = plain_matches(run, WIDTH, HEIGHT)};
}

/* The four texels under one. */
static void
below(const otx_canvas *fine, int32_t x, int32_t y, ptrdiff_t out[4])
{
    for (int i = 0; i < 4; ++i)
        out[i] = otx_canvas_index(fine, 2 * x + i % 2, 2 * y + i / 2);
}

static bool
has(const otx_canvas *c, const ptrdiff_t at[4], otx_synth_kind kind)
{
    return c->kinds[at[0]] == kind || c->kinds[at[1]] == kind ||
           c->kinds[at[2]] == kind || c->kinds[at[3]] == kind;
}

static void
a_level_has_what_matters_most_of_the_one_below(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    const otx_canvas *level =
        make_canvases(run, make_pattern(run, 3, false), &chart, 3)->levels;

    for (int32_t l = 1; l < 3; ++l)
        for (int32_t y = 0; y < level[l].height; ++y)
            for (int32_t x = 0; x < level[l].width; ++x)
            {
                const otx_canvas *fine = &level[l - 1];
                ptrdiff_t at[4];

                below(fine, x, y, at);
                assert_int_equal(
                    level[l].kinds[otx_canvas_index(&level[l], x, y)],
                    has(fine, at, OTX_SYNTH_FREE)     ? OTX_SYNTH_FREE
                    : has(fine, at, OTX_SYNTH_COLLAR) ? OTX_SYNTH_COLLAR
                    : has(fine, at, OTX_SYNTH_FROZEN) ? OTX_SYNTH_FROZEN
                                                      : OTX_SYNTH_VOID);
            }
}

static void
colours_are_means_of_what_is_there(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    const otx_canvas *level =
        make_canvases(run, make_pattern(run, 2, false), &chart, 2)->levels;

    for (int32_t y = 0; y < level[1].height; ++y)
        for (int32_t x = 0; x < level[1].width; ++x)
        {
            const otx_quad found =
                level[1].colors[otx_canvas_index(&level[1], x, y)];
            ptrdiff_t at[4];
            double sum[4] = {0.0}, count = 0.0;

            below(&level[0], x, y, at);
            for (int i = 0; i < 4; ++i)
                if (level[0].kinds[at[i]] != OTX_SYNTH_VOID)
                {
                    for (int k = 0; k < 4; ++k)
                        sum[k] += level[0].colors[at[i]][k];
                    count += 1.0;
                }
            for (int k = 0; k < 4; ++k)
                assert_float_equal(
                    found[k], count > 0.0 ? sum[k] / count : 0.0, 1e-3);
        }
}

/* A plane that shows the pattern as it is does so at every level, and children
 * that go on where their parents lead show it again. */
static void
a_plane_stays_one_up_and_down(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    otx_canvas *level =
        make_canvases(run, make_pattern(run, 3, false), &chart, 3)->levels;

    for (int32_t l = 2; l > 0; --l)
    {
        otx_canvas *fine = &level[l - 1];

        for (int32_t i = 0; i < fine->stride * fine->height; ++i)
            if (fine->kinds[i] != OTX_SYNTH_FROZEN)
                fine->matches[i] = (otx_synth_match){7.0f, 7.0f, 0.0f, 1.0f};
        otx_canvas_descend(&level[l], fine);
        for (int32_t y = 0; y < fine->height; ++y)
            for (int32_t x = 0; x < fine->width; ++x)
            {
                const ptrdiff_t at = otx_canvas_index(fine, x, y);
                const otx_synth_match m = fine->matches[at];

                if (fine->kinds[at] == OTX_SYNTH_VOID)
                    continue;
                assert_float_equal(m.x, (x + 0.5) * fine->step_x, 1e-3);
                assert_float_equal(m.y, (y + 0.5) * fine->step_y, 1e-3);
                assert_float_equal(m.c, 1.0, 1e-6);
            }
    }
}

/* Whether the window of a texel has one that `is` says yes to. */
typedef bool test_of(const otx_canvas *c, ptrdiff_t at);

static bool
is_free(const otx_canvas *c, ptrdiff_t at)
{
    return c->kinds[at] == OTX_SYNTH_FREE;
}

static bool
is_sought(const otx_canvas *c, ptrdiff_t at)
{
    return c->uses[at] == OTX_CANVAS_SEEK;
}

static bool
is_voted(const otx_canvas *c, ptrdiff_t at)
{
    return c->votes[at] != 0;
}

static bool
window_has(const otx_canvas *c, ptrdiff_t at, test_of *is)
{
    for (int32_t j = -c->radius; j <= c->radius; ++j)
        for (int32_t i = -c->radius; i <= c->radius; ++i)
            if (is(c, at + (ptrdiff_t)j * c->stride + i))
                return true;
    return false;
}

static void
check_uses(const otx_canvas *c, ptrdiff_t at)
{
    const uint8_t kind = c->kinds[at];
    const bool own = kind == OTX_SYNTH_FREE || kind == OTX_SYNTH_FROZEN;
    const bool made = kind == OTX_SYNTH_FREE || kind == OTX_SYNTH_COLLAR;

    assert_int_equal(
        c->uses[at] == OTX_CANVAS_SEEK, own && window_has(c, at, is_free));
    assert_int_equal(c->votes[at], made && window_has(c, at, is_sought));
    assert_int_equal(
        c->uses[at] == OTX_CANVAS_READ,
        kind == OTX_SYNTH_COLLAR && window_has(c, at, is_voted));
}

/* A hole in the middle, so that there is much that no window has to do with. */
static void
windows_are_used_for_what_reaches_the_hole(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    uint8_t *kinds = random_kinds(run, COUNT, 3, 7, 6);
    const otx_canvas *c;
    int32_t idle = 0;

    for (int32_t i = 0; i < COUNT; ++i)
        if (abs(i % WIDTH - 20) < 4 && abs(i / WIDTH - 16) < 3)
            kinds[i] = OTX_SYNTH_FREE;
    chart.kinds = kinds;
    c = make_canvases(run, make_pattern(run, 1, false), &chart, 1)->levels;
    for (int32_t y = 0; y < HEIGHT; ++y)
        for (int32_t x = 0; x < WIDTH; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            double mass = 0.0;

            check_uses(c, at);
            idle += c->uses[at] == OTX_CANVAS_NONE;
            for (int32_t j = -c->radius; j <= c->radius; ++j)
                for (int32_t i = -c->radius; i <= c->radius; ++i)
                    mass += c->kinds[at + (ptrdiff_t)j * c->stride + i] !=
                            OTX_SYNTH_VOID;
            assert_float_equal(c->masses[at], mass, 1e-4);
        }
    assert_true(idle > COUNT / 8);
}

static void
a_hole_weighs_as_told(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    otx_canvas *c =
        make_canvases(run, make_pattern(run, 1, false), &chart, 1)->levels;

    otx_canvas_weigh(c, 0.25f);
    for (int32_t y = 0; y < HEIGHT; ++y)
        for (int32_t x = 0; x < WIDTH; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            assert_float_equal(
                c->weights[at],
                is_free(c, at)                   ? 0.25
                : c->kinds[at] == OTX_SYNTH_VOID ? 0.0
                                                 : 1.0,
                0.0);
        }
}

static void
check_torus(otx_run *run, int32_t width, int32_t height)
{
    otx_synth_chart chart = make_chart(run);
    const otx_canvas *c;

    chart.width = width;
    chart.height = height;
    chart.wrap_x = chart.wrap_y = true;
    c = make_canvases(run, make_pattern(run, 1, false), &chart, 1)->levels;
    for (int32_t y = -OTX_CANVAS_RIM; y < height + OTX_CANVAS_RIM; ++y)
        for (int32_t x = -OTX_CANVAS_RIM; x < width + OTX_CANVAS_RIM; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            const ptrdiff_t from = otx_canvas_index(
                c, (x + 8 * width) % width, (y + 8 * height) % height);

            assert_int_equal(c->kinds[at], c->kinds[from]);
            assert_int_equal(c->uses[at], c->uses[from]);
            assert_float_equal(c->masses[at], c->masses[from], 0.0);
            assert_memory_equal(
                &c->colors[at], &c->colors[from], sizeof *c->colors);
            assert_memory_equal(
                &c->matches[at], &c->matches[from], sizeof *c->matches);
        }
}

static void
rims_of_a_torus_are_its_other_side(void **state)
{
    check_torus(*state, WIDTH, HEIGHT);
    /* Narrower than its rim. */
    check_torus(*state, 3, 20);
    check_torus(*state, 1, 1);
}

static void
strips_have_every_row_once(void **state)
{
    otx_run *run = *state;
    const int32_t heights[] = {HEIGHT, 1, OTX_CANVAS_STRIP + 1};
    otx_canvas canvases[3] = {{0}}, *list[3];
    const int32_t *chart_of, *first;
    int32_t seen[3] = {0};
    int64_t strips;

    for (int k = 0; k < 3; ++k)
    {
        canvases[k].height = heights[k];
        list[k] = &canvases[k];
    }
    assert_int_equal(
        otx_canvas_cut(run, list, 3, &chart_of, &first, &strips), OSDTEX_OK);
    for (int64_t i = 0; i < strips; ++i)
    {
        const int32_t k = chart_of[i];

        assert_int_equal(first[i], seen[k]);
        seen[k] += OTX_CANVAS_STRIP;
    }
    for (int k = 0; k < 3; ++k)
        assert_true(
            seen[k] >= heights[k] && seen[k] < heights[k] + OTX_CANVAS_STRIP);
}

/* One texel that is not drawn to the anchor frees all windows that have it. */
static void
a_window_is_drawn_by_its_least_share(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    float *share = OTX_NEW(run->arena, float, COUNT);
    const otx_canvas *c;

    for (int32_t i = 0; i < COUNT; ++i)
        share[i] = i == 10 * WIDTH + 20 ? 0.125f : 0.75f;
    chart.kinds = NULL;
    chart.anchor = OTX_ZNEW(run->arena, float, 4 * COUNT);
    chart.anchor_share = share;
    c = make_canvases(run, make_pattern(run, 1, false), &chart, 1)->levels;
    for (int32_t y = 0; y < HEIGHT; ++y)
        for (int32_t x = 0; x < WIDTH; ++x)
            assert_float_equal(
                c->anchor_share[otx_canvas_index(c, x, y)],
                abs(x - 20) <= c->radius && abs(y - 10) <= c->radius ? 0.125
                                                                     : 0.75,
                0.0);
}

/* Steps are as long on the surface at every level, and never beyond what a
 * window can be looked up with. */
static void
metrics_are_kept_in_bounds(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    float *metric = OTX_NEW(run->arena, float, 3 * COUNT);
    const otx_canvas *level;

    for (int32_t i = 0; i < COUNT; ++i)
    {
        metric[3 * i] = i % WIDTH < 20 ? 1.5f : 9.0f;
        metric[3 * i + 1] = i % WIDTH < 20 ? 0.25f : -3.0f;
        metric[3 * i + 2] = i % WIDTH < 20 ? 0.75f : 0.01f;
    }
    chart.kinds = NULL;
    chart.metric = metric;
    level = make_canvases(run, make_pattern(run, 2, false), &chart, 2)->levels;
    for (int32_t l = 0; l < 2; ++l)
        for (int32_t x = 0; x < level[l].width; ++x)
        {
            const otx_canvas *c = &level[l];
            const otx_vec2 right =
                otx_canvas_onto(c, otx_canvas_index(c, x, 3), 1.0f, 0.0f);
            const otx_vec2 up =
                otx_canvas_onto(c, otx_canvas_index(c, x, 3), 0.0f, 1.0f);
            const bool left = x < 20 >> l;

            assert_float_equal(right.x, (left ? 1.5 : 2.0) * (1 << l), 1e-4);
            assert_float_equal(right.y, (left ? 0.25 : -0.5) * (1 << l), 1e-4);
            assert_float_equal(up.y, (left ? 0.75 : 0.5) * (1 << l), 1e-4);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(a_level_has_what_matters_most_of_the_one_below),
        test_with_run(colours_are_means_of_what_is_there),
        test_with_run(a_plane_stays_one_up_and_down),
        test_with_run(windows_are_used_for_what_reaches_the_hole),
        test_with_run(a_hole_weighs_as_told),
        test_with_run(rims_of_a_torus_are_its_other_side),
        test_with_run(strips_have_every_row_once),
        test_with_run(a_window_is_drawn_by_its_least_share),
        test_with_run(metrics_are_kept_in_bounds),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

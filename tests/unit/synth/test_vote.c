/* test_vote.c -- what windows agree on, against a mean summed vote by vote in
 * double. */
#include "unit/synth/canvases.h"

#include "base/sort.h"
#include "synth/vote.h"
#include "synth/window_cost.h"

enum
{
    SIDE = 40,
    COUNT = SIDE * SIDE
};

static otx_synth_chart
make_chart(otx_run *run)
{
    return (otx_synth_chart){
        .width = SIDE,
        .height = SIDE,
        .kinds = random_kinds(run, COUNT, 2, 4, 0),
        .matches = plain_matches(run, SIDE, SIDE)};
}

static otx_canvas *
make_canvas(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart)
{
    return make_canvases(run, pattern, chart, 1)->levels;
}

/* Costs by chance, and what windows are trusted with. */
static void
trust_by_chance(otx_run *run, otx_canvas *c)
{
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
            c->costs[otx_canvas_index(c, x, y)] =
                (float)(100.0 * otx_random_unit(6, 2, (uint64_t)(y * SIDE + x)));
    assert_int_equal(otx_vote_trust(run, &c, 1, false), OSDTEX_OK);
}

static void
what_all_agree_on_is_kept(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    const otx_pattern *pattern = make_pattern(run, 1, false);
    otx_canvas *c = make_canvas(run, pattern, &chart);

    trust_by_chance(run, c);
    for (int round = 0; round < 2; ++round)
    {
        assert_int_equal(otx_vote_cast(run, &c, 1), OSDTEX_OK);
        for (int32_t y = 0; y < SIDE; ++y)
            for (int32_t x = 0; x < SIDE; ++x)
            {
                const ptrdiff_t at = otx_canvas_index(c, x, y);
                otx_quad shown;

                if (!c->votes[at])
                    continue;
                otx_pattern_at(
                    &pattern->levels[0], 1, (float)x + 0.5f, (float)y + 0.5f,
                    &shown);
                for (int k = 0; k < 4; ++k)
                    assert_float_equal(c->colors[at][k], shown[k], 1e-3);
                assert_int_equal(c->changed[at], 0);
            }
    }
}

/* [Wexler07, eq. 6], a vote after another. */
static void
slow(const otx_canvas *c, int32_t x, int32_t y, double out[4])
{
    double sum[4] = {0.0}, weight = 0.0;

    for (int32_t j = -c->radius; j <= c->radius; ++j)
        for (int32_t i = -c->radius; i <= c->radius; ++i)
        {
            const ptrdiff_t at = otx_canvas_index(c, x + i, y + j);
            const otx_synth_match m = c->matches[at];
            const double vote = exp(-(i * i + j * j) / 8.0) * c->trust[at];
            otx_quad shown;

            if (c->uses[at] == OTX_CANVAS_NONE || ((i + j) & 1))
                continue;
            otx_pattern_at(
                &c->pattern->levels[0], 1, m.x - m.c * i + m.s * j,
                m.y - m.s * i - m.c * j, &shown);
            for (int k = 0; k < 4; ++k)
                sum[k] += vote * shown[k];
            weight += vote;
        }
    for (int k = 0; k < 4; ++k)
        out[k] = sum[k] / weight;
}

static void
votes_are_counted_as_published(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    otx_canvas *c = make_canvas(run, make_pattern(run, 1, true), &chart);
    otx_quad *before = OTX_NEW(run->arena, otx_quad, c->stride * (SIDE + 8));

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const uint64_t bits =
                otx_random_bits(6, 3, (uint64_t)(y * SIDE + x));
            const double angle = (double)(bits >> 20 & 1023);

            c->matches[otx_canvas_index(c, x, y)] = (otx_synth_match){
                (float)(bits & 63), (float)(bits >> 8 & 63), (float)cos(angle),
                (float)sin(angle)};
        }
    trust_by_chance(run, c);
    memcpy(before, c->colors, (size_t)c->stride * (SIDE + 8) * sizeof *before);
    assert_int_equal(otx_vote_cast(run, &c, 1), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            double wanted[4];

            if (!c->votes[at])
            {
                assert_memory_equal(
                    &c->colors[at], &before[at], sizeof *before);
                continue;
            }
            slow(c, x, y, wanted);
            for (int k = 0; k < 4; ++k)
                assert_float_equal(c->colors[at][k], wanted[k], 2e-2);
        }
}

/* At the 75th percentile of the costs a window has e to the minus a half. */
static void
trust_falls_with_the_cost(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    otx_canvas *c;
    double costs[COUNT], scale;

    chart.kinds = NULL;
    c = make_canvas(run, make_pattern(run, 1, false), &chart);
    trust_by_chance(run, c);
    for (int32_t i = 0; i < COUNT; ++i)
        costs[i] = c->costs[otx_canvas_index(c, i % SIDE, i / SIDE)];
    otx_sort_doubles(costs, COUNT);
    scale = costs[3 * COUNT / 4];
    for (int32_t y = c->radius; y < SIDE - c->radius; ++y)
        for (int32_t x = c->radius; x < SIDE - c->radius; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            assert_float_equal(
                c->trust[at], exp(-0.5 * c->costs[at] / scale), 1e-3);
        }
    /* A corner's window has four rows and columns of seven. */
    assert_int_equal(otx_vote_trust(run, &c, 1, true), OSDTEX_OK);
    assert_float_equal(c->trust[otx_canvas_index(c, 20, 20)], 1.0, 1e-6);
    assert_float_equal(c->trust[otx_canvas_index(c, 0, 0)], 16.0 / 49.0, 1e-6);
}

static void
what_is_bad_has_some_say(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    otx_canvas *c = make_canvas(run, make_pattern(run, 1, false), &chart);

    for (int32_t i = 0; i < c->stride * (SIDE + 8); ++i)
        c->costs[i] = i % 100 ? 0.0f : 1e30f;
    assert_int_equal(otx_vote_trust(run, &c, 1, false), OSDTEX_OK);
    for (int32_t i = 0; i < c->stride * (SIDE + 8); ++i)
        if (c->uses[i] == OTX_CANVAS_SEEK)
            assert_true(c->trust[i] > 0.0f && c->trust[i] <= 1.0f);
}

static void
anchors_draw_by_their_share(void **state)
{
    otx_run *run = *state;
    otx_synth_chart chart = make_chart(run);
    float *anchor = OTX_NEW(run->arena, float, 4 * COUNT);
    float *share = OTX_NEW(run->arena, float, COUNT);
    const otx_pattern *pattern = make_pattern(run, 1, false);
    otx_canvas *c;

    for (int32_t i = 0; i < 4 * COUNT; ++i)
        anchor[i] = 17.0f;
    for (int32_t i = 0; i < COUNT; ++i)
        share[i] = i % SIDE < SIDE / 2 ? 1.0f : 0.0f;
    chart.kinds = NULL;
    chart.anchor = anchor;
    chart.anchor_share = share;
    c = make_canvas(run, pattern, &chart);
    trust_by_chance(run, c);
    assert_int_equal(otx_vote_cast(run, &c, 1), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
    {
        const ptrdiff_t drawn = otx_canvas_index(c, 4, y);
        otx_quad shown;

        otx_pattern_at(&pattern->levels[0], 1, 34.5f, (float)y + 0.5f, &shown);
        assert_float_equal(c->colors[drawn][0], 17.0, 1e-4);
        assert_int_equal(c->changed[drawn], 1);
        assert_float_equal(
            c->colors[otx_canvas_index(c, 34, y)][0], shown[0], 1e-3);
    }
}

/* Lightness of FREE texels in order. */
static void
gather(const otx_canvas *c, double *out, size_t *count)
{
    *count = 0;
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
            if (c->kinds[otx_canvas_index(c, x, y)] == OTX_SYNTH_FREE)
                out[(*count)++] = c->colors[otx_canvas_index(c, x, y)][0];
}

/* Flat colours are drawn to all the lights and darks of the pattern, none past
 * another. */
static void
lightness_is_drawn_to_the_pattern(void **state)
{
    otx_run *run = *state;
    const otx_synth_chart chart = make_chart(run);
    const otx_pattern *pattern = make_pattern(run, 1, false);
    const otx_pattern_level *level = &pattern->levels[0];
    otx_canvas *c = make_canvas(run, pattern, &chart);
    double before[COUNT], after[COUNT], wanted[PATTERN_SIDE * PATTERN_SIDE];
    size_t count, n = 0;

    for (int32_t i = 0; i < c->stride * (SIDE + 8); ++i)
        c->colors[i][0] = 50.0f + (float)otx_random_unit(6, 4, (uint64_t)i);
    gather(c, before, &count);
    assert_int_equal(otx_vote_match_histogram(run, &c, 1, 0.0), OSDTEX_OK);
    gather(c, after, &count);
    assert_memory_equal(before, after, count * sizeof *after);
    assert_int_equal(otx_vote_match_histogram(run, &c, 1, 1.0), OSDTEX_OK);
    gather(c, after, &count);
    for (size_t i = 0; i + 1 < count; ++i)
        assert_true(
            before[i] == before[i + 1] ||
            (after[i] <= after[i + 1]) == (before[i] <= before[i + 1]));
    for (int32_t y = 0; y < level->height; ++y)
        for (int32_t x = 0; x < level->width; ++x)
            wanted[n++] =
                level->values
                    [(ptrdiff_t)(y + OTX_PATTERN_RIM) * level->stride + x +
                     OTX_PATTERN_RIM][0];
    otx_sort_doubles(wanted, n);
    otx_sort_doubles(after, count);
    for (size_t i = 1; i < 20; ++i)
        assert_float_equal(
            after[i * count / 20], wanted[i * n / 20],
            0.02 * (wanted[n - 1] - wanted[0]));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_all_agree_on_is_kept),
        test_with_run(votes_are_counted_as_published),
        test_with_run(trust_falls_with_the_cost),
        test_with_run(what_is_bad_has_some_say),
        test_with_run(anchors_draw_by_their_share),
        test_with_run(lightness_is_drawn_to_the_pattern),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

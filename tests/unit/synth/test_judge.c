/* test_judge.c -- what is in the exemplar is found there, what is not is not.
 */
#include "unit/synth/canvases.h"

#include "synth/judge.h"

enum
{
    SIDE = 96
};

static const otx_judge_options OPTIONS = {1, 3, 8, 7};

static otx_synth_chart
make_chart(otx_run *run, uint8_t kind)
{
    uint8_t *kinds = OTX_NEW(run->arena, uint8_t, SIDE * SIDE);

    memset(kinds, kind, SIDE * SIDE);
    return (otx_synth_chart){
        .width = SIDE,
        .height = SIDE,
        .kinds = kinds,
        .matches = plain_matches(run, SIDE, SIDE)};
}

/* Beside the rim, what is blurred there has nothing beyond. */
static double
mean_of(const otx_judged *j, int32_t *count)
{
    double sum = 0.0;

    *count = 0;
    for (int32_t i = 0; i < j->width * j->height; ++i)
        if (j->distances[i] >= 0.0f && i % j->width >= 4 &&
            i % j->width < j->width - 4 && i / j->width >= 4 &&
            i / j->width < j->height - 4)
        {
            sum += j->distances[i];
            ++*count;
        }
    return *count > 0 ? sum / *count : 0.0;
}

/* The pattern wraps: the chart shows it one and a half times. */
static void
copies_are_found(void **state)
{
    otx_run *run = *state;
    const otx_pattern *pattern = make_pattern(run, 3, true);
    const otx_synth_chart chart = make_chart(run, OTX_SYNTH_FREE);
    otx_judged judged;
    int32_t count;

    assert_int_equal(
        otx_judge_windows(run, pattern, &chart, 1, &OPTIONS, &judged),
        OSDTEX_OK);
    assert_int_equal(judged.width, SIDE / 2);
    assert_true(mean_of(&judged, &count) < 1e-3);
    assert_int_equal(count, 40 * 40);
}

static void
only_what_is_owned_is_judged(void **state)
{
    otx_run *run = *state;
    const otx_pattern *pattern = make_pattern(run, 3, true);
    const otx_synth_chart chart = make_chart(run, OTX_SYNTH_FROZEN);
    otx_judged judged;
    int32_t count;

    assert_int_equal(
        otx_judge_windows(run, pattern, &chart, 1, &OPTIONS, &judged),
        OSDTEX_OK);
    mean_of(&judged, &count);
    assert_int_equal(count, 0);
}

/* A cut down the middle is seen at the cut, and nowhere else. */
static void
a_cut_is_seen_where_it_is(void **state)
{
    otx_run *run = *state;
    const otx_pattern *pattern = make_pattern(run, 3, true);
    const otx_synth_chart chart = make_chart(run, OTX_SYNTH_FREE);
    otx_judged judged;

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        if (i % SIDE >= SIDE / 2)
            chart.matches[i].y += 23.0f;
    assert_int_equal(
        otx_judge_windows(run, pattern, &chart, 1, &OPTIONS, &judged),
        OSDTEX_OK);
    for (int32_t y = 4; y < judged.height - 4; ++y)
    {
        assert_true(
            judged.distances[y * judged.width + judged.width / 2] > 1.0f);
        assert_true(judged.distances[y * judged.width + 8] < 1e-2f);
    }
}

/* Of noise nothing is found elsewhere; of what repeats, all is. */
static void
itself_is_not_counted(void **state)
{
    otx_run *run = *state;
    const otx_pattern *noise = make_pattern(run, 3, true);
    otx_pattern waves;
    otx_image lab;
    double of_noise, of_waves, p90;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &lab), OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
            lab.pixels[3 * i + c] =
                (float)(50.0 + 20.0 * sin(OTX_PI / 12.0 * (i % SIDE + c)) * cos(OTX_PI / 12.0 * (i / SIDE)));
    assert_int_equal(
        otx_pattern_build(
            run, run->arena,
            &(otx_pattern_input){
                .lab = &lab,
                .wrap_x = true,
                .wrap_y = true,
                .edge = 0.7,
                .levels = 3},
            &waves),
        OSDTEX_OK);
    assert_int_equal(
        otx_judge_itself(run, noise, 12.0, &OPTIONS, 0.9, &of_noise, &p90),
        OSDTEX_OK);
    assert_true(of_noise > 1.0);
    assert_true(p90 >= of_noise);
    assert_int_equal(
        otx_judge_itself(run, &waves, 12.0, &OPTIONS, 0.9, &of_waves, &p90),
        OSDTEX_OK);
    assert_true(of_waves < 0.2 * of_noise);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            copies_are_found, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            only_what_is_owned_is_judged, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            a_cut_is_seen_where_it_is, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            itself_is_not_counted, test_run_setup, test_run_teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_polish.c -- samples fall on texels with the colours they have there. */
#include "scene.h"

#include "match/polish.h"

static const otx_matcher_range ANYWHERE = {
    {-INFINITY, -INFINITY}, {INFINITY, INFINITY}};

static void
samples_are_spread_over_the_mask(void **state)
{
    otx_run *run = test_run_create();
    otx_polish_picks all, few;
    scene_mask scene;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 5.0, 0.3, (otx_vec2){7.0, 8.0});
    assert_int_equal(
        otx_polish_pick_samples(run->arena, &scene.mask, 100000, &all),
        OSDTEX_OK);
    assert_int_equal(all.count, 500); /* 20 cells of 25 texels */
    assert_int_equal(
        otx_polish_pick_samples(run->arena, &scene.mask, 40, &few), OSDTEX_OK);
    assert_int_equal(few.count, 40);
    for (int32_t i = 0; i < few.count; ++i)
    {
        const otx_vec2 source = otx_vec2_add(
            otx_vec2_mul(otx_vec2_polar(0.3), few.list[i].flat),
            (otx_vec2){7.0, 8.0});

        assert_true(fabs(source.x - few.list[i].source.x) < 1e-9);
        assert_true(fabs(source.y - few.list[i].source.y) < 1e-9);
        /* Distinct, and one in every run of 12 or 13. */
        for (int32_t k = 0; k < i; ++k)
            assert_true(
                few.list[k].flat.x != few.list[i].flat.x ||
                few.list[k].flat.y != few.list[i].flat.y);
    }
    test_run_destroy(run);
}

/* A cut-out has no error where it was cut, whatever the angle: the samples
 * were moved to texel centres and read their colours there. */
static void
the_window_finds_the_cut_out_without_error(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 70, 64);
    otx_matcher *matcher = scene_matcher(run, &image, true);

    (void)state;
    for (int k = 0; k < 12; ++k)
    {
        const double angle = 0.2 + 0.5 * k;
        const otx_vec2 shift = {60.0, 50.0};
        otx_match match = {.angle = angle, .shift = {62.0, 49.0}};
        otx_polish_picks picks;
        scene_mask scene;

        scene_mask_make(&scene, (otx_vec2){3.0, 2.0}, 4.0, angle, shift);
        assert_int_equal(
            otx_polish_pick_samples(run->arena, &scene.mask, 200, &picks),
            OSDTEX_OK);
        assert_int_equal(
            otx_polish_window(
                run->scratch, matcher, &picks, 200, &ANYWHERE, 0, 2, &match),
            OSDTEX_OK);
        assert_true(match.shift.x == shift.x && match.shift.y == shift.y);
        assert_true(match.error < 1e-10);
    }
    test_run_destroy(run);
}

static void
the_window_keeps_to_the_range(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 64, 64);
    otx_matcher *matcher = scene_matcher(run, &image, false);
    const otx_matcher_range range = {{20.5, -INFINITY}, {INFINITY, 29.0}};
    otx_match match = {.shift = {21.0, 29.0}};
    otx_polish_picks picks;
    scene_mask scene;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 4.0, 0.0, (otx_vec2){20.0, 30.0});
    assert_int_equal(
        otx_polish_pick_samples(run->arena, &scene.mask, 200, &picks),
        OSDTEX_OK);
    assert_int_equal(
        otx_polish_window(
            run->scratch, matcher, &picks, 200, &range, 0, 2, &match),
        OSDTEX_OK);
    assert_true(otx_matcher_allows(&range, match.shift));
    assert_true(match.error > 0.0 && isfinite(match.error));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_spread_over_the_mask),
        cmocka_unit_test(the_window_finds_the_cut_out_without_error),
        cmocka_unit_test(the_window_keeps_to_the_range),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

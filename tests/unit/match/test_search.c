/* test_search.c -- what is found is what a direct search would find. */
#include "scene.h"

#include "match/exhaust.h"

#include <stdlib.h>

enum
{
    ANGLES = 19
};

static void
make_angles(double angles[ANGLES], double first)
{
    for (int k = 0; k < ANGLES; ++k)
        angles[k] = first + 2.0 * OTX_PI * k / ANGLES;
}

static void
expect_shift(
    const otx_matcher *m, otx_vec2 found, otx_vec2 wanted, double tolerance)
{
    double dx = found.x - wanted.x;
    double dy = found.y - wanted.y;

    if (m->wrap_x)
        dx -= m->width * floor(dx / m->width + 0.5);
    if (m->wrap_y)
        dy -= m->height * floor(dy / m->height + 0.5);
    assert_true(fabs(dx) <= tolerance && fabs(dy) <= tolerance);
}

/* ------------------------------------------------------ planted patches */

/* Cut out where a placement of the query puts it, at whole texels. */
static void
check_planted(
    int32_t width, int32_t height, bool wrap, int32_t coarse_levels,
    bool gauss_newton, double tolerance)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, width, height);
    otx_matcher *matcher = scene_matcher(run, &image, wrap);
    double angles[ANGLES];
    otx_match_query query = otx_match_query_defaults(angles, ANGLES);
    scene_mask scene;

    make_angles(angles, 0.1);
    query.coarse_levels = coarse_levels;
    query.gauss_newton = gauss_newton;
    query.centre = (otx_vec2){12.0, 12.0};
    for (int k = 0; k < ANGLES; ++k)
    {
        const otx_vec2 shift = {
            wrap ? width - 9.0 : floor(0.5 * width),
            wrap ? 31.0 : floor(0.5 * height)};
        otx_match best[3];
        int32_t count;

        scene_mask_make(
            &scene, (otx_vec2){wrap ? 3.0 : -12.0, wrap ? 4.0 : -12.0}, 4.0,
            angles[k], shift);
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, best, 3, &count),
            OSDTEX_OK);
        assert_true(count >= 1);
        assert_true(fabs(best[0].angle - angles[k]) <= tolerance);
        expect_shift(matcher, best[0].shift, shift, 50.0 * tolerance);
        assert_true(best[0].error < 1e-3);
        for (int32_t i = 1; i < count; ++i)
            assert_true(best[i].error >= best[i - 1].error);
        /* The error returned is the exact score. */
        for (int32_t i = 0; i < count; ++i)
            assert_true(
                fabs(
                    best[i].error -
                    otx_matcher_score(matcher, &scene.mask, &best[i])) < 1e-6);
    }
    test_run_destroy(run);
}

static void
a_planted_patch_is_found_at_full_resolution(void **state)
{
    (void)state;
    check_planted(80, 80, true, 0, false, 0.0);
    check_planted(77, 91, true, 0, false, 0.0);
    check_planted(90, 83, false, 0, false, 0.0);
}

static void
a_planted_patch_is_found_coarse_to_fine(void **state)
{
    (void)state;
    check_planted(96, 80, true, 1, false, 0.0);
    check_planted(77, 91, true, 1, false, 0.0);
    check_planted(90, 83, false, 1, false, 0.0);
    check_planted(96, 80, true, 1, true, 0.002);
}

/* A crop that does not tile stands for another exemplar: what the mask shows
 * of it is found where the crop was taken. */
static void
colours_of_another_exemplar_are_matched(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 96, 80);
    const otx_vec2 from = {17.0, 6.0}, shift = {40.0, 30.0};
    otx_image crop = {60, 66, 3, OTX_NEW(run->arena, float, 60 * 66 * 3)};
    otx_matcher *matcher = scene_matcher(run, &image, true), *other;
    double angles[ANGLES];
    otx_match_query query = otx_match_query_defaults(angles, ANGLES);

    (void)state;
    for (int32_t y = 0; y < crop.height; ++y)
        memcpy(
            otx_image_at(&crop, 0, y),
            otx_image_at(&image, (int32_t)from.x, (int32_t)from.y + y),
            (size_t)crop.width * 3 * sizeof(float));
    assert_int_equal(
        otx_matcher_create_like(
            run, &crop, false, false, 1.0, 1, matcher, &other),
        OSDTEX_OK);
    make_angles(angles, 0.1);
    for (int32_t coarse = 0; coarse <= 1; ++coarse)
        for (int k = 0; k < ANGLES; ++k)
        {
            scene_mask scene;
            otx_match best;
            int32_t count;

            scene_mask_make(
                &scene, (otx_vec2){-12.0, -12.0}, 4.0, angles[k], shift);
            for (int32_t t = 0; t < scene.mask.triangle_count; ++t)
            {
                scene.triangles[t].from = other;
                for (int c = 0; c < 3; ++c)
                    scene.triangles[t].source[c] =
                        otx_vec2_sub(scene.triangles[t].source[c], from);
            }
            query.coarse_levels = coarse;
            query.gauss_newton = coarse == 1;
            assert_int_equal(
                otx_matcher_search(
                    run, matcher, &scene.mask, &query, &best, 1, &count),
                OSDTEX_OK);
            assert_int_equal(count, 1);
            assert_true(fabs(best.angle - angles[k]) <= 0.002);
            expect_shift(matcher, best.shift, shift, 0.1);
            assert_true(best.error < 1e-3);
        }
    test_run_destroy(run);
}

/* Off the lattice of texels and angles, only Gauss-Newton gets there. */
static void
gauss_newton_goes_below_the_texel(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 96, 96);
    otx_matcher *matcher = scene_matcher(run, &image, true);
    const double angles[2] = {0.4, 2.0};
    otx_match_query query = otx_match_query_defaults(angles, 2);
    const otx_vec2 shift = {40.3, 51.7};
    scene_mask scene;
    otx_match rough, best;
    int32_t count;

    (void)state;
    scene_mask_make(&scene, (otx_vec2){-12.0, -12.0}, 4.0, 0.42, shift);
    assert_int_equal(
        otx_matcher_search(
            run, matcher, &scene.mask, &query, &rough, 1, &count),
        OSDTEX_OK);
    query.gauss_newton = true;
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, &best, 1, &count),
        OSDTEX_OK);
    assert_true(best.error < 0.5 * rough.error);
    assert_true(fabs(best.angle - 0.42) < 0.005);
    expect_shift(matcher, best.shift, shift, 0.1);
    test_run_destroy(run);
}

/* --------------------------------------------------------------- bounds */

static void
check_bounds(int32_t coarse_levels, bool gauss_newton, bool overhang)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 75, 66);
    otx_matcher *matcher = scene_matcher(run, &image, false);
    const otx_vec2 cover[4] = {
        {-14.0, -14.0}, {20.0, -14.0}, {20.0, 20.0}, {-14.0, 20.0}};
    double angles[ANGLES];
    otx_match_query query = otx_match_query_defaults(angles, ANGLES);
    otx_match best[8];
    scene_mask scene;
    int32_t count;

    make_angles(angles, 0.3);
    query.coarse_levels = coarse_levels;
    query.gauss_newton = gauss_newton;
    query.cover = cover;
    query.cover_count = 4;
    query.overhang = overhang;
    scene_mask_make(
        &scene, (otx_vec2){-13.0, -13.0}, 4.0, 1.0, (otx_vec2){37.0, 33.0});
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, best, 8, &count),
        OSDTEX_OK);
    assert_int_equal(count, 8);
    for (int32_t i = 0; i < count; ++i)
        for (int c = 0; c < 4; ++c)
        {
            const otx_vec2 p = otx_vec2_add(
                otx_vec2_mul(otx_vec2_polar(best[i].angle), cover[c]),
                best[i].shift);

            assert_true(p.x >= 0.5 - 1e-9 && p.x <= 74.5 + 1e-9);
            assert_true(p.y >= 0.5 - 1e-9 && p.y <= 65.5 + 1e-9);
        }
    test_run_destroy(run);
}

static void
matches_stay_inside_what_does_not_tile(void **state)
{
    (void)state;
    for (int overhang = 0; overhang < 2; ++overhang)
    {
        check_bounds(0, false, overhang);
        check_bounds(1, false, overhang);
        check_bounds(1, true, overhang);
    }
}

static void
what_does_not_fit_gives_no_match(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 40, 40);
    otx_matcher *matcher = scene_matcher(run, &image, false);
    const double angle = 0.2;
    otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_match best;
    scene_mask scene;
    int32_t count = -1;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 9.0, 0.0, (otx_vec2){0.0, 0.0});
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, &best, 1, &count),
        OSDTEX_OK);
    assert_int_equal(count, 0);
    test_run_destroy(run);
}

/* A mask may reach over the rim where the patch does not. */
static void
what_reaches_over_the_rim_is_a_match(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 64, 64);
    otx_matcher *matcher = scene_matcher(run, &image, false);
    const double angle = 0.0;
    otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_match best;
    scene_mask scene;
    int32_t count;

    (void)state;
    /* 18 texels wide, of which 6 lie beyond the left rim. */
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 3.0, 0.0, (otx_vec2){-6.0, 20.0});
    for (int32_t level = 0; level < 2; ++level)
    {
        query.coarse_levels = level;
        query.overhang = false;
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, &best, 1, &count),
            OSDTEX_OK);
        assert_true(count == 0 || best.shift.x >= 0.0);
        query.overhang = true;
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, &best, 1, &count),
            OSDTEX_OK);
        assert_int_equal(count, 1);
        assert_true(best.shift.x == -6.0 && best.shift.y == 20.0);
    }
    test_run_destroy(run);
}

static void
one_triangle_is_enough(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 64, 64);
    otx_matcher *matcher = scene_matcher(run, &image, true);
    const double angles[2] = {0.0, 1.0};
    const otx_match_query query = otx_match_query_defaults(angles, 2);
    const otx_mask_triangle triangle = {
        .flat = {{0, 0}, {9, 0}, {0, 9}},
        .source = {{20, 58}, {29, 58}, {20, 67}},
        .weight = {1, 1, 1}};
    const otx_mask mask = {&triangle, 1};
    otx_match best;
    int32_t count;

    (void)state;
    assert_int_equal(
        otx_matcher_search(run, matcher, &mask, &query, &best, 1, &count),
        OSDTEX_OK);
    assert_int_equal(count, 1);
    assert_true(best.error < 1e-5);
    expect_shift(matcher, best.shift, (otx_vec2){20.0, 58.0}, 0.0);
    test_run_destroy(run);
}

/* A penalty where the planted patch lies drives the match elsewhere. */
static void
usage_moves_the_match(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 64, 64);
    otx_matcher *matcher = scene_matcher(run, &image, true);
    const double angle = 0.0;
    otx_match_query query = otx_match_query_defaults(&angle, 1);
    float usage[16] = {0};
    scene_mask scene;
    otx_match best[2];
    int32_t count;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 3.0, 0.01, (otx_vec2){20.0, 20.0});
    query.centre = (otx_vec2){9.0, 9.0}; /* lands at (29, 29): cell (1, 1) */
    for (int32_t level = 0; level < 2; ++level)
    {
        query.coarse_levels = level;
        query.usage = NULL;
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, best, 2, &count),
            OSDTEX_OK);
        expect_shift(matcher, best[0].shift, (otx_vec2){20.0, 20.0}, 0.0);
        usage[5] = 1.0f;
        query.usage = usage;
        query.usage_width = 4;
        query.usage_height = 4;
        query.usage_weight = 1e6;
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, best, 2, &count),
            OSDTEX_OK);
        assert_int_equal(count, 2);
        for (int32_t i = 0; i < 2; ++i)
        {
            const double x = best[i].shift.x + 9.0;
            const double y = best[i].shift.y + 9.0;

            assert_false(x >= 16.0 && x < 32.0 && y >= 16.0 && y < 32.0);
        }
    }
    test_run_destroy(run);
}

/* --------------------------------------------------------- determinism */

static void
search_with_threads(int32_t threads, otx_match best[6], int32_t *count)
{
    otx_run *run = test_run_create_with(NULL, threads < 1 ? 1 : threads);
    const otx_image image = scene_exemplar(run, 90, 70);
    otx_matcher *matcher = scene_matcher(run, &image, true);
    double angles[ANGLES];
    otx_match_query query = otx_match_query_defaults(angles, ANGLES);
    scene_mask scene;

    make_angles(angles, 0.77);
    query.gauss_newton = true;
    scene_mask_make(
        &scene, (otx_vec2){2.0, 3.0}, 4.0, 0.05, (otx_vec2){11.0, 12.0});
    memset(best, 0, 6 * sizeof *best);
    if (threads == 0)
        assert_int_equal(
            otx_matcher_search_within(
                &(otx_worker){.scratch = run->scratch}, matcher, &scene.mask,
                &query, best, 6, count),
            OSDTEX_OK);
    else
        assert_int_equal(
            otx_matcher_search(
                run, matcher, &scene.mask, &query, best, 6, count),
            OSDTEX_OK);
    test_run_destroy(run);
}

static void
threads_do_not_change_a_bit(void **state)
{
    const int32_t threads[] = {0, 2, 8};
    otx_match one[6], other[6];
    int32_t count_one, count_other;

    (void)state;
    search_with_threads(1, one, &count_one);
    assert_true(count_one > 1);
    for (int i = 0; i < 3; ++i)
    {
        search_with_threads(threads[i], other, &count_other);
        assert_int_equal(count_other, count_one);
        assert_memory_equal(one, other, sizeof one);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_planted_patch_is_found_at_full_resolution),
        cmocka_unit_test(a_planted_patch_is_found_coarse_to_fine),
        cmocka_unit_test(colours_of_another_exemplar_are_matched),
        cmocka_unit_test(gauss_newton_goes_below_the_texel),
        cmocka_unit_test(matches_stay_inside_what_does_not_tile),
        cmocka_unit_test(what_does_not_fit_gives_no_match),
        cmocka_unit_test(what_reaches_over_the_rim_is_a_match),
        cmocka_unit_test(one_triangle_is_enough),
        cmocka_unit_test(usage_moves_the_match),
        cmocka_unit_test(threads_do_not_change_a_bit),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

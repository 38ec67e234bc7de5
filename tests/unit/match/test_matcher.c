/* test_matcher.c -- what is prepared once for all searches. */
#include "scene.h"

#include "match/exhaust.h"

#include <stdlib.h>

/* ---------------------------------------------------------- corner cases */

static void
an_empty_mask_is_the_callers_mistake(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, 32, 32);
    otx_matcher *matcher = scene_matcher(run, &image, true);
    const double angle = 0.0;
    const otx_match_query query = otx_match_query_defaults(&angle, 1);
    const otx_mask empty = {NULL, 0};
    scene_mask scene;
    otx_match best;
    int32_t count;

    (void)state;
    assert_int_equal(
        otx_matcher_search(run, matcher, &empty, &query, &best, 1, &count),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "mask is empty"));
    assert_int_equal(count, 0);

    /* All weights 0: nothing to compare, and nothing wrong. */
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 3.0, 0.0, (otx_vec2){0.0, 0.0});
    for (int32_t t = 0; t < scene.mask.triangle_count; ++t)
        memset(scene.triangles[t].weight, 0, sizeof(float[3]));
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, &best, 1, &count),
        OSDTEX_OK);
    assert_int_equal(count, 0);

    scene.triangles[0].flat[0].x = NAN;
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, &best, 1, &count),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

static void
a_constant_exemplar_matches_everywhere(void **state)
{
    otx_run *run = test_run_create();
    otx_image image = scene_exemplar(run, 32, 32);
    const double angle = 0.5;
    const otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_matcher *matcher;
    scene_mask scene;
    otx_match best;
    int32_t count;

    (void)state;
    for (int i = 0; i < 32 * 32 * 3; ++i)
        image.pixels[i] = 0.25f;
    assert_int_equal(
        otx_matcher_create(run, &image, true, true, 0.0, 0, &matcher),
        OSDTEX_OK);
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 3.0, 0.0, (otx_vec2){0.0, 0.0});
    assert_int_equal(
        otx_matcher_search(run, matcher, &scene.mask, &query, &best, 1, &count),
        OSDTEX_OK);
    assert_int_equal(count, 1);
    assert_true(best.error == 0.0);
    assert_true(isfinite(best.shift.x) && isfinite(best.shift.y));
    test_run_destroy(run);
}

/* ------------------------------------------------------- out of memory */

static void
running_out_of_memory_is_a_status(void **state)
{
    test_ration b = {.left = INT64_MAX};
    const otx_allocator_hooks hooks = test_ration_hooks(&b);
    bool done = false;

    (void)state;
    for (int64_t allowed = 0; !done; ++allowed)
    {
        b.left = INT64_MAX;
        otx_run *run = test_run_create_with(&hooks, 1);
        const otx_image image = scene_exemplar(run, 64, 64);
        const double angle = 0.3;
        const otx_match_query query = otx_match_query_defaults(&angle, 1);
        otx_matcher *matcher;
        scene_mask scene;
        otx_match best;
        int32_t count;
        otx_status status;

        scene_mask_make(
            &scene, (otx_vec2){0.0, 0.0}, 4.0, 0.0, (otx_vec2){9.0, 9.0});
        b.left = allowed;
        status = otx_matcher_create(run, &image, true, true, 1.0, 0, &matcher);
        if (status == OSDTEX_OK)
            status = otx_matcher_search(
                run, matcher, &scene.mask, &query, &best, 1, &count);
        assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
        done = status == OSDTEX_OK;
        b.left = INT64_MAX;
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_mask_is_the_callers_mistake),
        cmocka_unit_test(a_constant_exemplar_matches_everywhere),
        cmocka_unit_test(running_out_of_memory_is_a_status),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

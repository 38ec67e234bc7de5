/* test_period.c -- pictures that hold whole periods. */
#include "support.h"

#include "quilt/period.h"

#include <math.h>

/* Waves that repeat by g[0] and g[1]. */
static otx_exemplar
waves(otx_run *run, int32_t width, int32_t height, const otx_vec2 g[2])
{
    const double det = otx_vec2_cross(g[0], g[1]);
    otx_exemplar e = {0};

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, 3, &e.lab), OSDTEX_OK);
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            const otx_vec2 p = {x, y};
            const double a = otx_vec2_cross(p, g[1]) / det;
            const double b = otx_vec2_cross(g[0], p) / det;
            float *texel = otx_image_at(&e.lab, x, y);

            texel[0] =
                (float)(50.0 + 20.0 * cos(2.0 * OTX_PI * a) + 20.0 * sin(2.0 * OTX_PI * b));
            texel[1] = texel[2] = 0.0f;
        }
    e.linear = e.match = e.lab;
    return e;
}

static void
test_rectangle(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec2 g[2] = {{30, 0}, {0, 22}};
    const otx_exemplar e = waves(run, 200, 150, g);
    otx_period p;

    (void)state;
    assert_true(otx_period_find(&e, g, &p));
    assert_int_equal(p.width, 180);
    assert_int_equal(p.height, 132);
    assert_in_range(p.x, 0, 20);
    assert_in_range(p.y, 0, 18);
    test_run_destroy(run);
}

/* Courses that are moved by half a brick: sums and differences of the
 * generators lie along the sides. */
static void
test_running_bond(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec2 g[2] = {{20, -16}, {20, 16}};
    const otx_exemplar e = waves(run, 150, 150, g);
    otx_period p;

    (void)state;
    assert_true(otx_period_find(&e, g, &p));
    assert_int_equal(p.width, 120);
    assert_int_equal(p.height, 128);
    test_run_destroy(run);
}

/* Generators that were measured half a texel wrong are bettered. */
static void
test_adjusts(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec2 g[2] = {{30, 0}, {0, 22}};
    const otx_vec2 wrong[2] = {{30.3, 0}, {0, 21.8}};
    const otx_exemplar e = waves(run, 200, 150, g);
    otx_period p;

    (void)state;
    assert_true(otx_period_find(&e, wrong, &p));
    assert_int_equal(p.width, 180);
    assert_int_equal(p.height, 132);
    test_run_destroy(run);
}

static void
test_keeps_what_tiles(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec2 g[2] = {{30, 0}, {0, 22}};
    otx_exemplar e = waves(run, 210, 150, g);
    otx_period p;

    (void)state;
    e.wrap_x = true;
    assert_true(otx_period_find(&e, g, &p));
    assert_int_equal(p.width, 210);
    assert_int_equal(p.height, 132);
    /* Unless it cannot. */
    e = waves(run, 225, 150, g);
    e.wrap_x = true;
    assert_true(otx_period_find(&e, g, &p));
    assert_int_equal(p.width, 210);
    test_run_destroy(run);
}

static void
test_refuses_slanting_ones(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec2 g[2] = {{37, 11}, {-13, 41}};
    const otx_exemplar e = waves(run, 150, 150, g);
    otx_period p;

    (void)state;
    assert_false(otx_period_find(&e, g, &p));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangle),
        cmocka_unit_test(test_running_bond),
        cmocka_unit_test(test_adjusts),
        cmocka_unit_test(test_keeps_what_tiles),
        cmocka_unit_test(test_refuses_slanting_ones),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_radial.c -- outlines as masks. */
#include "support.h"

#include "mapping/radial.h"

static otx_radial
circle(double radius, double feather)
{
    otx_radial r = {.feather = (float)feather};

    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
        r.radius[i] = (float)radius;
    otx_radial_bound(&r);
    return r;
}

static void
a_circle_falls_over_its_feather(void **state)
{
    const otx_radial r = circle(10.0, 2.0);

    (void)state;
    assert_float_equal(otx_radial_alpha(&r, (otx_vec2){0, 0}, 0.0), 1.0, 0);
    assert_float_equal(otx_radial_alpha(&r, (otx_vec2){0, 7.9}, 0.0), 1.0, 0);
    assert_float_equal(
        otx_radial_alpha(&r, (otx_vec2){-9.0, 0}, 0.0), 0.5, 1e-6);
    assert_float_equal(
        otx_radial_alpha(&r, (otx_vec2){0, -10.0}, 0.0), 0, 1e-6);
    assert_float_equal(otx_radial_alpha(&r, (otx_vec2){99, 99}, 0.0), 0, 0);
}

static void
a_wide_filter_keeps_the_middle_of_the_slope(void **state)
{
    const otx_radial r = circle(10.0, 2.0);

    (void)state;
    assert_float_equal(
        otx_radial_alpha(&r, (otx_vec2){9.0, 0}, 8.0), 0.5, 1e-6);
    assert_float_equal(
        otx_radial_alpha(&r, (otx_vec2){7.0, 0}, 8.0), 0.75, 1e-6);
}

static void
bounds_change_nothing(void **state)
{
    otx_radial r = circle(10.0, 2.0), wide;

    (void)state;
    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
        r.radius[i] = (float)(10.0 + 3.0 * sin(0.3 * i));
    otx_radial_bound(&r);
    assert_true(r.least < 7.1f && r.most > 12.9f);
    wide = r;
    wide.least = 0.0f;
    wide.most = 1e6f;
    for (int i = 0; i < 400; ++i)
    {
        const otx_vec2 at = {0.07 * i - 14.0, 0.11 * (i % 100) - 5.0};

        assert_float_equal(
            otx_radial_alpha(&r, at, 0.5), otx_radial_alpha(&wide, at, 0.5),
            1e-9);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_circle_falls_over_its_feather),
        cmocka_unit_test(a_wide_filter_keeps_the_middle_of_the_slope),
        cmocka_unit_test(bounds_change_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

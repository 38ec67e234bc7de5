/* test_stretch.c -- singular values of known maps. */
#include "support.h"

#include "flatten/stretch.h"

static const otx_vec3 triangle[3] = {{0, 0, 0}, {2, 0, 0}, {0, 0, -1}};

/* Stretches the triangle, laid flat, by a along x and b along y, then turns. */
static void
singular(double a, double b, double turn, double out[2])
{
    otx_vec2 q[3];

    otx_stretch_layout(triangle, q);
    for (int i = 0; i < 3; ++i)
        q[i] = otx_vec2_mul(
            otx_vec2_polar(turn), (otx_vec2){a * q[i].x, b * q[i].y});
    otx_stretch_singular(triangle, q, out);
}

static void
known_maps(void **state)
{
    double s[2];

    (void)state;
    singular(1.0, 1.0, 0.7, s);
    assert_true(fabs(s[0] - 1.0) < 1e-12 && fabs(s[1] - 1.0) < 1e-12);
    singular(0.5, 3.0, -2.0, s);
    assert_true(fabs(s[0] - 3.0) < 1e-12 && fabs(s[1] - 0.5) < 1e-12);
}

static void
flips_are_negative(void **state)
{
    double s[2];

    (void)state;
    singular(1.0, -2.0, 0.3, s);
    assert_true(s[1] < 0.0);
    singular(1.0, 0.0, 0.3, s);
    assert_true(fabs(s[1]) < 1e-12);
}

static void
a_triangle_without_area_has_no_stretch(void **state)
{
    const otx_vec3 line[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const otx_vec2 uv[3] = {{0, 0}, {5, 1}, {3, 3}};
    double s[2];

    (void)state;
    otx_stretch_singular(line, uv, s);
    assert_true(s[0] == 1.0 && s[1] == 1.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_maps),
        cmocka_unit_test(flips_are_negative),
        cmocka_unit_test(a_triangle_without_area_has_no_stretch),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_obj_origin.c -- meshes that lie far away from the scene's origin. */
#include "obj_support.h"

#include <math.h>

/* A triangle of that size at (x, y, z), as text. */
static otx_obj
triangle_at(otx_run *run, double x, double y, double z, double size)
{
    char text[512];

    snprintf(
        text, sizeof text,
        "v %.10f %.10f %.10f\nv %.10f %.10f %.10f\nv %.10f %.10f %.10f\n"
        "v 0 0 0\nf 1 2 3\n",
        x, y, z, x + size, y, z, x, y + size, z);
    return test_obj_parse(run, text);
}

static void
near_meshes_keep_their_numbers(void **state)
{
    const otx_obj obj = triangle_at(*state, 10.5, -3, 0.1, 1);

    for (int k = 0; k < 3; ++k)
        assert_true(obj.origin[k] == 0.0);
    assert_true(obj.points[0] == 10.5f && obj.points[2] == 0.1f);
    assert_string_equal(test_last_message(*state), "");
}

/* Points and origin together are what the file says, to seven digits of the
 * mesh's size; an axis along which it is near keeps its zero; a stray vertex
 * that no face uses does not count. */
static void
far_meshes_keep_their_detail(void **state)
{
    static const double places[] = {1e3, 451200.25, 1e7, 1e9, -3e7};

    for (int i = 0; i < 5; ++i)
    {
        const double x = places[i];
        const otx_obj obj = triangle_at(*state, x, -2 * x, 0.25, 0.3);

        assert_true(obj.origin[0] != 0.0 && obj.origin[1] != 0.0);
        assert_true(obj.origin[2] == 0.0);
        assert_true(
            fabs(obj.origin[0] + (double)obj.points[3] - (x + 0.3)) <=
            4e-8 + 3e-16 * fabs(x));
        assert_true(
            fabs((double)obj.points[3] - (double)obj.points[0] - 0.3) <=
            1e-7 + 3e-16 * fabs(x));
    }
}

static void
what_does_not_fit_is_told(void **state)
{
    otx_run *run = *state;
    osdtex_diagnostic d;

    triangle_at(run, 1e7, 0, 0, 0.3);
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
    assert_non_null(strstr(test_last_message(run), "32 bits"));
    test_obj_parse(
        run, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e7 0 0\nv 10000000.1 0 0\n"
             "v 1e7 .1 0\nf 1 2 3\nf 4 5 6\n");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 2);
    otx_diagnostics_get(run->diagnostics, 1, &d);
    assert_non_null(strstr(d.message, "1 faces (first is face 1) are too"));
    assert_int_equal(d.face, 1);
}

#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(near_meshes_keep_their_numbers),
        TEST(far_meshes_keep_their_detail), TEST(what_does_not_fit_is_told)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

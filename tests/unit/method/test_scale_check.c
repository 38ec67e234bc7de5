/* test_scale_check.c -- scales that go with a surface, and those that do not.
 */
#include "unit/bake/flat.h"

#include "method/scale_check.h"

static otx_status
check(otx_run *run, double finer, double scale)
{
    const otx_surface *surface = flat_surface(run, 4, 2);
    const otx_exemplar *exemplar = flat_exemplar(run, 256, 3);

    return otx_scale_check(run, surface, finer, exemplar, scale);
}

/* Sixteen square units in edges of a quarter of one. */
static void
scales_are_bounded_from_both_sides(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(check(run, 1.0, 1.0), OSDTEX_OK);
    assert_int_equal(check(run, 1.0, 1000.0), OSDTEX_OK);
    assert_int_equal(check(run, 1.0, 1025.0), OSDTEX_ERROR_LIMIT);
    assert_int_equal(check(run, 1.0, 1e300), OSDTEX_ERROR_LIMIT);
    assert_int_equal(check(run, 1.0, 0.25 / 1000.0), OSDTEX_OK);
    assert_int_equal(check(run, 1.0, 0.25 / 1030.0), OSDTEX_ERROR_LIMIT);
    assert_int_equal(check(run, 1.0, 1e-300), OSDTEX_ERROR_LIMIT);
    assert_int_equal(check(run, 4.0, 0.25 / 4000.0), OSDTEX_OK);
    test_run_destroy(run);
}

/* Whether a scale is warned of at a level; the diagonal is sqrt(32). */
static bool
is_warned(int32_t level, double scale, const char *words)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, 4, 0);
    bool warned;

    otx_scale_warn(run, surface->cage, level, scale);
    warned = otx_diagnostics_count(run->diagnostics) > 0;
    if (warned)
        assert_non_null(strstr(test_last_message(run), words));
    test_run_destroy(run);
    return warned;
}

static void
other_units_are_warned_of(void **state)
{
    (void)state;
    assert_false(is_warned(5, 0.2, ""));
    assert_false(is_warned(0, 20.0, ""));
    assert_true(is_warned(7, 0.1, "57 pictures side by side"));
    assert_true(is_warned(0, 40.0, "0.14 of the picture's width"));
    assert_true(is_warned(0, 0.5, "still 2 pictures long"));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scales_are_bounded_from_both_sides),
        cmocka_unit_test(other_units_are_warned_of),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

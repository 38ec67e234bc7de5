/* test_colour.c -- which rule decides, on every configuration at hand. */
#include "colour_support.h"

static void
test_unknown_name_lists_near_ones(void **state)
{
    const otx_colour_source source = {.from = "ACESgc"};
    otx_run *run = test_run_create();
    const char *space = NULL;
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, NULL),
        OSDTEX_ERROR_COLOUR);
    assert_null(space);
    assert_non_null(strstr(test_last_message(run), "from"));
    assert_non_null(strstr(test_last_message(run), "'ACEScg'"));
    test_run_destroy(run);
}

/* A configuration that cannot be used is one finding, with its file. */
static void
test_bad_configurations(void **state)
{
    static const char *const paths[] = {
        "no/such.ocio",
        HOSTILE "ocio_tabs.ocio",
        HOSTILE "ocio_truncated.ocio",
        HOSTILE "ocio_unknown_transform.ocio",
        HOSTILE "ocioz_missing_luts.ocioz",
        HOSTILE "too_new_cg-config_ocio-v2.5.ocio",
    };
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA);
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; ++i)
    {
        otx_run *run = test_run_create();
        osdtex_diagnostic d;
        otx_colour colour;

        assert_int_equal(
            otx_colour_open(run, paths[i], CG, &colour), OSDTEX_ERROR_COLOUR);
        assert_null(colour.config);
        assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
        otx_diagnostics_get(run->diagnostics, 0, &d);
        assert_string_equal(d.file, paths[i]);
        assert_int_equal(d.status, OSDTEX_ERROR_COLOUR);
        test_run_destroy(run);
    }
}

/* The missing table is only missed by those who need it. */
static void
test_missing_table(void **state)
{
    const otx_colour_source source = {.path = "x.exr", .is_float = true};
    otx_run *run = test_run_create();
    float pixel[3] = {0.5F, 0.5F, 0.5F};
    otx_image image = {1, 1, 3, pixel};
    const char *space = NULL;
    otx_colour colour;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
    {
        test_run_destroy(run);
        test_skip("no " SHARED_DATA);
    }
    assert_int_equal(
        otx_colour_open(run, HOSTILE "ocio_missing_lut.ocio", NULL, &colour),
        OSDTEX_OK);
    assert_int_equal(warning_count(run), 1);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, NULL), OSDTEX_OK);
    assert_string_equal(space, "lin");
    assert_int_equal(
        otx_colour_convert(run, &colour, "lin", "raw", &image), OSDTEX_OK);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unknown_name_lists_near_ones),
        cmocka_unit_test(test_bad_configurations),
        cmocka_unit_test(test_missing_table),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_run.c -- findings fold, the first error counts, progress can stop. */
#include "support.h"

static void
like_findings_fold_into_one(void **state)
{
    otx_run *run = test_run_create();
    osdtex_diagnostic d;

    (void)state;
    for (int i = 0; i < 5; ++i)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "cage",
            (otx_where){"a.obj", 7, i, -1}, "face %d is odd", i);
    otx_note(
        run, OSDTEX_SEVERITY_WARNING, "cage", OTX_NOWHERE, "something else");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 2);
    otx_diagnostics_get(run->diagnostics, 0, &d);
    assert_string_equal(d.message, "face 0 is odd");
    assert_string_equal(d.file, "a.obj");
    assert_int_equal(d.count, 5);
    assert_int_equal(d.face, 0);
    test_run_destroy(run);
}

static void
a_failure_returns_its_status_and_says_why(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(
        otx_fail(
            run, OSDTEX_ERROR_LIMIT, "refine", OTX_NOWHERE, "%d is too many",
            12),
        OSDTEX_ERROR_LIMIT);
    assert_string_equal(test_last_message(run), "12 is too many");
    assert_int_equal(otx_fail_memory(run, "refine"), OSDTEX_ERROR_MEMORY);
    assert_true(strlen(test_last_message(run)) > 0);
    test_run_destroy(run);
}

static void
count_finding(void *user, const osdtex_diagnostic *finding)
{
    assert_non_null(finding->message);
    ++*(int *)user;
}

static void
listeners_hear_new_findings_once(void **state)
{
    otx_run *run = test_run_create();
    int heard = 0;

    (void)state;
    otx_diagnostics_listen(run->diagnostics, count_finding, &heard);
    for (int i = 0; i < 3; ++i)
        otx_note(run, OSDTEX_SEVERITY_INFO, "a", OTX_NOWHERE, "same");
    otx_note(run, OSDTEX_SEVERITY_INFO, "a", OTX_NOWHERE, "other");
    assert_int_equal(heard, 2);
    test_run_destroy(run);
}

static bool
stop_at_half(void *user, const char *stage, double fraction)
{
    assert_string_equal(stage, "fit");
    *(double *)user = fraction;
    return fraction < 0.5;
}

static void
progress_can_cancel(void **state)
{
    otx_run *run = test_run_create();
    double seen = -1.0;

    (void)state;
    assert_int_equal(otx_progress(run, "fit", 0.7), OSDTEX_OK);
    run->progress = stop_at_half;
    run->progress_user = &seen;
    assert_int_equal(otx_progress(run, "fit", 0.25), OSDTEX_OK);
    assert_true(seen == 0.25);
    assert_int_equal(otx_progress(run, "fit", 0.5), OSDTEX_ERROR_CANCELLED);
    test_run_destroy(run);
}

/* Programs call options by other names than the library does. */
static void
names_of_options_are_marked(void **state)
{
    otx_run *run = test_run_create();
    const osdtex_diagnostic *error = otx_diagnostics_error(run->diagnostics);

    (void)state;
    (void)otx_fail(
        run, OSDTEX_ERROR_LIMIT, "a", OTX_NOWHERE, "%s: raise {level} to %d",
        OTX_OPTION_NAME("to"), 3);
    assert_string_equal(error->message, "to: raise level to 3");
    assert_string_equal(error->marked, "\x1fto\x1f: raise \x1flevel\x1f to 3");
    test_run_destroy(run);
}

/* Findings fold by their format, but the error is told in its own words. */
static void
the_first_error_is_kept_in_its_own_words(void **state)
{
    otx_run *run = test_run_create();
    const osdtex_diagnostic *error = otx_diagnostics_error(run->diagnostics);

    (void)state;
    assert_int_equal(error->status, OSDTEX_OK);
    assert_string_equal(error->message, "");
    for (int32_t i = 0; i < 2; ++i)
    {
        otx_diagnostics_forget_error(run->diagnostics);
        (void)otx_fail(
            run, OSDTEX_ERROR_FORMAT, "a", (otx_where){"f.obj", 7 + i, -1, -1},
            "line %d", (int)i);
        (void)otx_fail(run, OSDTEX_ERROR_IO, "b", OTX_NOWHERE, "follows");
    }
    assert_int_equal(error->status, OSDTEX_ERROR_FORMAT);
    assert_string_equal(error->stage, "a");
    assert_string_equal(error->file, "f.obj");
    assert_int_equal(error->line, 8);
    assert_string_equal(error->message, "line 1");
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(like_findings_fold_into_one),
        cmocka_unit_test(a_failure_returns_its_status_and_says_why),
        cmocka_unit_test(listeners_hear_new_findings_once),
        cmocka_unit_test(progress_can_cancel),
        cmocka_unit_test(the_first_error_is_kept_in_its_own_words),
        cmocka_unit_test(names_of_options_are_marked),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_option.c -- settings survive the way through text. */
#include "support.h"

#include "method/option.h"

typedef struct example
{
    double width;
    int32_t count;
    int32_t mode;
    int32_t relax;
} example;

static const char *const modes[] = {"best", "paper", NULL};

static const otx_option table[] = {
    {"width", OTX_OPTION_REAL, offsetof(example, width), 0.0, 2.5, 0.1, NULL,
     "width"},
    {"count", OTX_OPTION_INTEGER, offsetof(example, count), 1, 64, 19, NULL,
     "count"},
    {"mode", OTX_OPTION_CHOICE, offsetof(example, mode), 0, 0, 0, modes,
     "mode"},
    {"relax", OTX_OPTION_SWITCH, offsetof(example, relax), 0, 0, 1, NULL,
     "relax"},
};

enum
{
    COUNT = sizeof table / sizeof table[0]
};

static int
set_up(void **state)
{
    *state = test_run_create();
    return 0;
}

static int
tear_down(void **state)
{
    test_run_destroy(*state);
    return 0;
}

static void
defaults_are_the_table_s(void **state)
{
    example e;

    (void)state;
    otx_option_defaults(table, COUNT, &e);
    assert_true(e.width == 0.1);
    assert_int_equal(e.count, 19);
    assert_int_equal(e.mode, 0);
    assert_int_equal(e.relax, 1);
}

static void
text_goes_round(void **state)
{
    static const char *const values[] = {"0.1", "19", "best", "on"};
    static const char *const others[] = {"2.25", "64", "paper", "off"};
    example e;
    char text[64];

    otx_option_defaults(table, COUNT, &e);
    for (int32_t i = 0; i < COUNT; ++i)
    {
        otx_option_text(&table[i], &e, text);
        assert_string_equal(text, values[i]);
        assert_int_equal(
            otx_option_set(*state, table, COUNT, &e, table[i].name, others[i]),
            OSDTEX_OK);
        otx_option_text(&table[i], &e, text);
        assert_string_equal(text, others[i]);
    }
}

static void
what_does_not_fit_is_refused_and_changes_nothing(void **state)
{
    static const char *const bad[][2] = {
        {"width", "-0.1"}, {"width", "2.6"},  {"width", "nan"},
        {"width", ""},     {"width", "1x"},   {"count", "1.5"},
        {"count", "0"},    {"count", "1e99"}, {"mode", "Paper"},
        {"relax", "1"},    {"widht", "1"},    {"", "1"},
    };
    example e, before;

    memset(&e, 0, sizeof e);
    otx_option_defaults(table, COUNT, &e);
    before = e;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        assert_int_equal(
            otx_option_set(*state, table, COUNT, &e, bad[i][0], bad[i][1]),
            OSDTEX_ERROR_ARGUMENT);
    assert_memory_equal(&e, &before, sizeof e);
}

static void
sentences_help(void **state)
{
    example e;

    otx_option_defaults(table, COUNT, &e);
    otx_option_set(*state, table, COUNT, &e, "widht", "1");
    assert_string_equal(
        test_last_message(*state),
        "the method has no setting 'widht'; did you mean 'width'?");
    otx_option_set(*state, table, COUNT, &e, "count", "65");
    assert_string_equal(
        test_last_message(*state),
        "setting 'count' is a whole number from 1 to 64, not '65'");
    otx_option_set(*state, table, COUNT, &e, "mode", "papr");
    assert_string_equal(
        test_last_message(*state),
        "setting 'mode' is one of best, paper, not 'papr'");
}

#define WITH_RUN(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_table_s),
        WITH_RUN(text_goes_round),
        WITH_RUN(what_does_not_fit_is_refused_and_changes_nothing),
        WITH_RUN(sentences_help),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_html.c -- what stands in a page is text and finite numbers. */
#include "support.h"

#include "regress/html.h"

#include <stdlib.h>
#include <string.h>

static char *
sparkline(const char *numbers, const char *reference)
{
    json_t *list = json_loads(numbers, 0, NULL);
    json_t *was = json_loads(reference, JSON_DECODE_ANY, NULL);
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    assert_non_null(list);
    otx_html_put_sparkline(out, list, was);
    assert_int_equal(fclose(out), 0);
    json_decref(list);
    json_decref(was);
    return text;
}

static void
curves_are_finite_whatever_the_numbers(void **state)
{
    static const char *const rows[] = {
        "[1e308, -1e308]", "[1e308, -1e308, 0]", "[0, 0, 0]", "[5e-324, 0]",
        "[1.7e308]"};
    static const char *const references[] = {"-1.7e308", "0", "null"};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        for (size_t k = 0; k < sizeof references / sizeof references[0]; ++k)
        {
            char *text = sparkline(rows[i], references[k]);

            assert_non_null(strstr(text, "<svg"));
            assert_null(strstr(text, "nan"));
            assert_null(strstr(text, "inf"));
            free(text);
        }
}

static void
text_cannot_become_markup(void **state)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    (void)state;
    otx_html_put_text(out, "a\"<b>&c");
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text, "a&quot;&lt;b&gt;&amp;c");
    free(text);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_finite_whatever_the_numbers),
        cmocka_unit_test(text_cannot_become_markup),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

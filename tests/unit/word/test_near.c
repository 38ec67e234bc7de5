/* test_near.c -- what counts as a slip of the finger. */
#include "support.h"

#include "word/near.h"

static const char *const names[] = {"catmark", "loop", "bilinear", NULL};

static const char *
name_at(const void *list, int32_t index)
{
    return ((const char *const *)list)[index];
}

static void
distance_counts_edits(void **state)
{
    (void)state;
    assert_int_equal(otx_near_distance("", ""), 0);
    assert_int_equal(otx_near_distance("", "abc"), 3);
    assert_int_equal(otx_near_distance("Loop", "loop"), 0);
    assert_int_equal(otx_near_distance("lopo", "loop"), 1);
    assert_int_equal(otx_near_distance("catmrk", "catmark"), 1);
    assert_int_equal(
        otx_near_distance("kitten", "sitting"),
        otx_near_distance("sitting", "kitten"));
}

static void
long_names_are_far(void **state)
{
    char longer[100];

    (void)state;
    memset(longer, 'a', sizeof longer);
    longer[99] = '\0';
    assert_true(otx_near_distance(longer, "loop") > 100);
}

static void
near_names_are_listed(void **state)
{
    char text[256];

    (void)state;
    otx_near_text("catmrk", name_at, names, text);
    assert_string_equal(text, "; did you mean 'catmark'?");
    otx_near_text("bilin", name_at, names, text);
    assert_string_equal(text, "; did you mean 'bilinear'?");
    otx_near_text("zzzzzzzz", name_at, names, text);
    assert_string_equal(text, "");
}

static void
nearest_come_first_and_three_at_most(void **state)
{
    static const char *const many[] = {
        "abcx", "abxx", "abcd", "abce", "abcf", NULL};
    char text[256];

    (void)state;
    otx_near_text("abcd", name_at, many, text);
    assert_string_equal(text, "; did you mean 'abcd', 'abcx' or 'abce'?");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_counts_edits),
        cmocka_unit_test(long_names_are_far),
        cmocka_unit_test(near_names_are_listed),
        cmocka_unit_test(nearest_come_first_and_three_at_most),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

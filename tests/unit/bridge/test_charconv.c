/* test_charconv.c -- numbers read and print the same under any locale. */
#include "support.h"

#include "base/random.h"
#include "bridge/charconv.h"

#include <locale.h>
#include <math.h>

static otx_charconv_result
read_float(const char *text, float *value, size_t *used)
{
    const char *rest = text;
    const otx_charconv_result result =
        otx_charconv_read_float(text, text + strlen(text), value, &rest);

    *used = (size_t)(rest - text);
    return result;
}

static void
forms_are_read(void **state)
{
    static const struct
    {
        const char *text;
        float value;
        size_t used;
    } cases[] = {
        {"1", 1, 1},
        {"+1", 1, 2},
        {"-1", -1, 2},
        {".5", .5f, 2},
        {"+.5", .5f, 3},
        {"5.", 5, 2},
        {"1e5", 1e5f, 3},
        {"2.e-1", .2f, 5},
        {"1E+2", 100, 4},
        {"1.5/2", 1.5f, 3},
        {"1e", 1, 1},
        {"3.1+e2", 3.1f, 3},
        {"1.#IND", 1, 2},
        {"0x10", 0, 1},
        {"1,5", 1, 1},
        {"1e-60", 0, 5},
        {"1e-400", 0, 6},
        {"-1e-400", 0, 7},
        {"0.0001e-300", 0, 11},
        {"1e-99999999999999999999", 0, 23}};

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        float value = -99;
        size_t used;

        assert_int_equal(
            read_float(cases[i].text, &value, &used), OTX_CHARCONV_OK);
        assert_true(value == cases[i].value);
        assert_int_equal(used, cases[i].used);
    }
}

static void
what_is_no_number_is_malformed(void **state)
{
    static const char *const texts[] = {
        "", "+", "-", ".", "+-1", "++1", "e5", "x1", "-+1", " 1", "/"};

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i)
    {
        const char *rest = texts[i];
        float value = -99;
        double wide = -99;
        int64_t integer = -99;
        size_t used;

        assert_int_equal(
            read_float(texts[i], &value, &used), OTX_CHARCONV_MALFORMED);
        assert_int_equal(used, 0);
        assert_true(value == -99);
        assert_int_equal(
            otx_charconv_read_double(
                texts[i], texts[i] + strlen(texts[i]), &wide, &rest),
            OTX_CHARCONV_MALFORMED);
        assert_int_equal(
            otx_charconv_read_int(
                texts[i], texts[i] + strlen(texts[i]), &integer, &rest),
            OTX_CHARCONV_MALFORMED);
        assert_ptr_equal(rest, texts[i]);
    }
}

static void
overflow_is_told_from_underflow(void **state)
{
    static const char *const large[] = {
        "1e39",
        "-1e50",
        "1e400",
        "1e99999999999999999999",
        "1000000000000000000000000000000000000000000000",
        "0.1e400"};
    char digits[500];
    float value = -99;
    size_t used;

    (void)state;
    for (size_t i = 0; i < sizeof large / sizeof *large; ++i)
    {
        assert_int_equal(
            read_float(large[i], &value, &used), OTX_CHARCONV_OVERFLOW);
        assert_int_equal(used, strlen(large[i]));
        assert_true(value == -99);
    }
    /* 0.000…01 without an exponent, and the same lifted by one. */
    memset(digits, '0', sizeof digits);
    digits[1] = '.';
    memcpy(digits + 490, "1", 2);
    assert_int_equal(read_float(digits, &value, &used), OTX_CHARCONV_OK);
    assert_true(value == 0);
    memcpy(digits + 490, "1e489", 6);
    assert_int_equal(read_float(digits, &value, &used), OTX_CHARCONV_OK);
    assert_true(value == 1);
}

static void
nan_and_infinity_are_numbers(void **state)
{
    float value;
    size_t used;

    (void)state;
    assert_int_equal(read_float("nan", &value, &used), OTX_CHARCONV_OK);
    assert_true(isnan(value));
    assert_int_equal(read_float("-inf", &value, &used), OTX_CHARCONV_OK);
    assert_true(isinf(value) && value < 0);
}

static void
integers_end_at_64_bits(void **state)
{
    static const char in[] = "+9223372036854775807/";
    static const char out[] = "-9223372036854775809";
    const char *rest;
    int64_t value = 0;

    (void)state;
    assert_int_equal(
        otx_charconv_read_int(in, in + strlen(in), &value, &rest),
        OTX_CHARCONV_OK);
    assert_true(value == INT64_MAX);
    assert_int_equal(*rest, '/');
    assert_int_equal(
        otx_charconv_read_int(out, out + strlen(out), &value, &rest),
        OTX_CHARCONV_OVERFLOW);
}

/* Any float, printed and read back, is the same bits; and so for doubles. */
static void
printing_round_trips(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 200000; ++i)
    {
        const uint64_t bits = otx_random_bits(7, 0, i);
        const uint32_t bits32 = (uint32_t)bits;
        char text[OTX_CHARCONV_BYTES];
        const char *rest;
        float value, back;
        double wide, wide_back;
        size_t size;

        memcpy(&value, &bits32, sizeof value);
        memcpy(&wide, &bits, sizeof wide);
        if (!isfinite(value) || !isfinite(wide))
            continue;
        size = otx_charconv_print_float(text, value);
        assert_true(size <= 16);
        assert_int_equal(
            otx_charconv_read_float(text, text + size, &back, &rest),
            OTX_CHARCONV_OK);
        assert_ptr_equal(rest, text + size);
        assert_memory_equal(&value, &back, sizeof value);
        size = otx_charconv_print_double(text, wide);
        assert_true(size <= 24);
        assert_int_equal(
            otx_charconv_read_double(text, text + size, &wide_back, &rest),
            OTX_CHARCONV_OK);
        assert_memory_equal(&wide, &wide_back, sizeof wide);
    }
}

static void
printing_is_shortest(void **state)
{
    static const struct
    {
        float value;
        const char *text;
    } cases[] = {{1, "1"},         {-0.0f, "-0"},   {0.1f, "0.1"},
                 {1e10f, "1e+10"}, {0.25f, "0.25"}, {16777216, "16777216"}};
    char text[OTX_CHARCONV_BYTES];

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        const size_t size = otx_charconv_print_float(text, cases[i].value);

        assert_int_equal(size, strlen(cases[i].text));
        assert_memory_equal(text, cases[i].text, size);
    }
    assert_int_equal(otx_charconv_print_int(text, INT64_MIN), 20);
    assert_memory_equal(text, "-9223372036854775808", 20);
}

static void
locale_does_not_matter(void **state)
{
    static const char *const names[] = {
        "de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR.utf8"};
    const char *set = NULL;
    char text[OTX_CHARCONV_BYTES];
    float value;
    size_t used;

    (void)state;
    for (size_t i = 0; !set && i < sizeof names / sizeof *names; ++i)
        set = setlocale(LC_ALL, names[i]);
    if (!set)
    {
        print_message("skipped: no locale with a decimal comma is installed\n");
        skip();
    }
    assert_int_equal(read_float("1.5", &value, &used), OTX_CHARCONV_OK);
    assert_true(value == 1.5f);
    assert_int_equal(otx_charconv_print_float(text, 1.5f), 3);
    assert_memory_equal(text, "1.5", 3);
    setlocale(LC_ALL, "C");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forms_are_read),
        cmocka_unit_test(what_is_no_number_is_malformed),
        cmocka_unit_test(overflow_is_told_from_underflow),
        cmocka_unit_test(nan_and_infinity_are_numbers),
        cmocka_unit_test(integers_end_at_64_bits),
        cmocka_unit_test(printing_round_trips),
        cmocka_unit_test(printing_is_shortest),
        cmocka_unit_test(locale_does_not_matter)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_text_out.c -- buffered output keeps order, and its first failure. */
#include "folder.h"

#include <math.h>

#include "file/text_out.h"

static size_t
read_back(const test_file *f, char *bytes, size_t capacity)
{
    FILE *file = fopen(f->path, "rb");
    const size_t size = fread(bytes, 1, capacity, file);

    fclose(file);
    return size;
}

static void
values_are_plain_text(void **state)
{
    test_file *f = *state;
    char text[128];
    otx_text_out *out;

    assert_int_equal(
        otx_text_out_open(f->run, "test", f->path, NULL, &out), OSDTEX_OK);
    otx_text_out_string(out, "a ");
    otx_text_out_int(out, -12);
    otx_text_out_char(out, ' ');
    otx_text_out_float(out, 0.1f);
    otx_text_out_char(out, ' ');
    otx_text_out_name(out, "b c\nd", false);
    otx_text_out_char(out, ' ');
    otx_text_out_name(out, "b c\nd", true);
    assert_int_equal(otx_text_out_close(f->run, out), OSDTEX_OK);
    text[read_back(f, text, sizeof text - 1)] = '\0';
    assert_string_equal(text, "a -12 0.1 b_c_d b c_d");
}

/* A number relative to an origin reads back as the same, less the origin, in
 * few digits. */
static void
placed_numbers_read_back(void **state)
{
    static const double origins[] = {0.0, 451204.0, -5412304.0, 1e9, 1e15, 0.5};
    static const float values[] = {0.0f, -3.95f, 0.3f, 2.8463f, 1e-3f, 1e8f};
    test_file *f = *state;
    char text[4096];
    const char *at = text;
    otx_text_out *out;

    assert_int_equal(
        otx_text_out_open(f->run, "test", f->path, NULL, &out), OSDTEX_OK);
    for (size_t i = 0; i < 36; ++i)
    {
        otx_text_out_placed(out, values[i % 6], origins[i / 6]);
        otx_text_out_char(out, ' ');
    }
    assert_int_equal(otx_text_out_close(f->run, out), OSDTEX_OK);
    text[read_back(f, text, sizeof text - 1)] = '\0';
    assert_non_null(strstr(text, "0 -3.95 0.3 2.8463 0.001 1e+08 451204 "));
    assert_non_null(strstr(text, " 451200.05 451204.3 451206.8463 "));
    for (size_t i = 0; i < 36; ++i)
    {
        char *end;
        const double back = strtod(at, &end) - origins[i / 6];

        /* What a double next to the origin can tell apart. */
        assert_true(
            fabs(back - (double)values[i % 6]) <=
            1.2e-16 * fabs(origins[i / 6]) +
                6e-8 * fabs((double)values[i % 6]));
        if (fabs(origins[i / 6]) < 1e8 && values[i % 6] != 1e-3f)
            assert_true((float)back == values[i % 6]);
        at = end;
    }
}

/* Small pieces and pieces larger than any buffer come out in order. */
static void
order_is_kept(void **state)
{
    enum
    {
        LARGE = 1 << 20,
        SMALL = 1000
    };
    test_file *f = *state;
    char *bytes = OTX_NEW(f->run->arena, char, LARGE + 2 * SMALL);
    char *back = OTX_NEW(f->run->arena, char, LARGE + 3 * SMALL);
    otx_text_out *out;

    for (size_t i = 0; i < LARGE + 2 * SMALL; ++i)
        bytes[i] = (char)(i * 31 % 251);
    assert_int_equal(
        otx_text_out_open(f->run, "test", f->path, NULL, &out), OSDTEX_OK);
    otx_text_out_bytes(out, bytes, SMALL);
    otx_text_out_bytes(out, bytes + SMALL, LARGE);
    otx_text_out_bytes(out, bytes + SMALL + LARGE, SMALL);
    assert_int_equal(otx_text_out_close(f->run, out), OSDTEX_OK);
    assert_int_equal(read_back(f, back, LARGE + 3 * SMALL), LARGE + 2 * SMALL);
    assert_memory_equal(bytes, back, LARGE + 2 * SMALL);
}

static void
the_first_failure_is_told_once(void **state)
{
    test_file *f = *state;
    otx_text_out *out;
    osdtex_diagnostic d;

    if (access("/dev/full", W_OK) != 0)
        test_skip("no /dev/full");
    assert_int_equal(
        otx_text_out_open(f->run, "test", "/dev/full", "out.obj", &out),
        OSDTEX_OK);
    for (int i = 0; i < 1000000; ++i)
        otx_text_out_char(out, 'x');
    assert_int_equal(otx_text_out_close(f->run, out), OSDTEX_ERROR_IO);
    assert_int_equal(otx_diagnostics_count(f->run->diagnostics), 1);
    otx_diagnostics_get(f->run->diagnostics, 0, &d);
    assert_string_equal(d.file, "out.obj");
    assert_non_null(strstr(d.message, "full"));
}

/* A stream that an error left open is closed with the scratch arena. */
static void
release_closes(void **state)
{
    test_file *f = *state;

    for (int i = 0; i < 5000; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(f->run->scratch);
        otx_text_out *out;

        assert_int_equal(
            otx_text_out_open(f->run, "test", f->path, NULL, &out), OSDTEX_OK);
        otx_arena_release(f->run->scratch, mark);
    }
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_file_setup, test_file_teardown)
    const struct CMUnitTest tests[] = {
        TEST(values_are_plain_text), TEST(placed_numbers_read_back),
        TEST(order_is_kept), TEST(the_first_failure_is_told_once),
        TEST(release_closes)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

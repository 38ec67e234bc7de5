/* test_text.c -- lines, continuations, and files that are no text. */
#include "support.h"

#include "file/text.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    LIMIT = 1 << 20
};

static otx_text
open_bytes(otx_run *run, const char *bytes, size_t size)
{
    otx_text text;

    assert_int_equal(
        otx_text_open(run, "test", "t.txt", bytes, size, &text), OSDTEX_OK);
    return text;
}

/* Goes over the lines and holds number and content against what is expected,
 * twice: joining a line must not move the numbers. */
static void
check_lines(
    otx_run *run, const char *bytes, size_t count, const int64_t *lines,
    const char *const *contents)
{
    otx_text text = open_bytes(run, bytes, strlen(bytes));

    for (int pass = 0; pass < 2; ++pass)
    {
        otx_text_rewind(&text);
        for (size_t i = 0; i < count; ++i)
        {
            assert_true(otx_text_next(&text));
            assert_int_equal(text.line, lines[i]);
            assert_true(otx_token_is(otx_text_remainder(&text), contents[i]));
        }
        assert_false(otx_text_next(&text));
    }
}

static void
all_line_ends_count(void **state)
{
    static const int64_t lines[] = {1, 2, 3, 4, 5};
    static const char *const contents[] = {"a", "b", "", "c", "d"};

    check_lines(*state, "a\nb\r\n\rc\r d ", 5, lines, contents);
    check_lines(
        *state,
        "\xEF\xBB\xBF"
        "a\rb\n\nc\nd\n",
        5, lines, contents);
}

static void
continued_lines_are_one(void **state)
{
    static const int64_t lines[] = {1, 4, 5, 6};
    static const char *const contents[] = {"a    b   c", "d", "# e \\", "f\\g"};
    static const int64_t last_line[] = {1};
    static const char *const last[] = {"a"};

    check_lines(*state, "a \\\n b\\\r\nc\nd\n# e \\\nf\\g", 4, lines, contents);
    check_lines(*state, "a\\\n\\\n", 1, last_line, last);
}

static void
tokens_end_at_blanks_and_comments(void **state)
{
    static const char bytes[] = "\t v\f1 \v 2\\\n3 # 4\n#5";
    otx_text text = open_bytes(*state, bytes, strlen(bytes));
    otx_token token;

    assert_true(otx_text_next(&text));
    assert_int_equal(otx_text_count(&text), 4);
    assert_true(otx_text_token(&text, &token));
    assert_true(otx_token_is(token, "v"));
    assert_int_equal(otx_text_count(&text), 3);
    assert_true(otx_text_next(&text));
    assert_int_equal(text.line, 3);
    assert_false(otx_text_token(&text, &token));
    assert_false(otx_text_next(&text));
}

static void
long_lines_have_no_limit(void **state)
{
    enum
    {
        TOKENS = 300000
    };
    otx_run *run = *state;
    char *bytes = OTX_NEW(run->arena, char, 2 * TOKENS);
    otx_text text;

    for (size_t i = 0; i < TOKENS; ++i)
    {
        bytes[2 * i] = 'x';
        bytes[2 * i + 1] = ' ';
    }
    text = open_bytes(run, bytes, 2 * TOKENS);
    assert_true(otx_text_next(&text));
    assert_int_equal(otx_text_count(&text), TOKENS);
}

static void
quotes_are_short_and_printable(void **state)
{
    char bytes[200];
    otx_text_quote quote;

    (void)state;
    memset(bytes, 'x', sizeof bytes);
    bytes[1] = '\x1B';
    quote = otx_token_quote((otx_token){bytes, bytes + 3});
    assert_string_equal(quote.text, "x?x");
    quote = otx_token_quote((otx_token){bytes, bytes + sizeof bytes});
    assert_int_equal(strlen(quote.text), OTX_TEXT_QUOTE_BYTES - 1);
    assert_string_equal(quote.text + OTX_TEXT_QUOTE_BYTES - 4, "...");
}

static void
check_refused(otx_run *run, const char *bytes, size_t size, const char *words)
{
    otx_text text;

    assert_int_equal(
        otx_text_open(run, "test", words, bytes, size, &text),
        OSDTEX_ERROR_FORMAT);
    assert_non_null(strstr(test_last_message(run), words));
}

static void
what_is_no_utf8_is_refused(void **state)
{
    check_refused(*state, "", 0, "empty");
    check_refused(*state, "\xFF\xFEv\0", 4, "UTF-16; save it as UTF-8");
    check_refused(*state, "\xFE\xFF\0v", 4, "UTF-16; save it as UTF-8");
    check_refused(*state, "v\0 \0", 4, "zero bytes");
}

static void
check_unreadable(otx_run *run, const char *path, otx_status status)
{
    otx_text text;

    assert_int_equal(otx_text_read(run, "test", path, LIMIT, &text), status);
    assert_true(strlen(test_last_message(run)) > 0);
}

static void
unreadable_files_say_why(void **state)
{
    otx_run *run = *state;
    char path[] = "/tmp/osdtex-text-XXXXXX";
    const int fd = mkstemp(path);

    assert_true(fd >= 0);
    check_unreadable(run, path, OSDTEX_ERROR_FORMAT);
    assert_string_equal(test_last_message(run), "the file is empty");
    assert_int_equal(ftruncate(fd, LIMIT + 1), 0);
    check_unreadable(run, path, OSDTEX_ERROR_LIMIT);
    close(fd);
    if (geteuid() != 0)
    {
        assert_int_equal(chmod(path, 0), 0);
        check_unreadable(run, path, OSDTEX_ERROR_IO);
    }
    unlink(path);
    check_unreadable(run, "/nowhere/at/all.obj", OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(run), "No such file"));
    check_unreadable(run, "/tmp", OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(run), "directory"));
    check_unreadable(run, "/dev/zero", OSDTEX_ERROR_IO);
}

/* A pipe does not tell its size. */
static void
pipes_are_read(void **state)
{
    int ends[2];
    char name[64];
    otx_text text;

    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], "a\nb", 3), 3);
    close(ends[1]);
    snprintf(name, sizeof name, "/dev/fd/%d", ends[0]);
    assert_int_equal(
        otx_text_read(*state, "test", name, LIMIT, &text), OSDTEX_OK);
    close(ends[0]);
    assert_true(otx_text_next(&text));
    assert_true(otx_text_next(&text));
    assert_false(otx_text_next(&text));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            all_line_ends_count, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            continued_lines_are_one, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            tokens_end_at_blanks_and_comments, test_run_setup,
            test_run_teardown),
        cmocka_unit_test_setup_teardown(
            long_lines_have_no_limit, test_run_setup, test_run_teardown),
        cmocka_unit_test(quotes_are_short_and_printable),
        cmocka_unit_test_setup_teardown(
            what_is_no_utf8_is_refused, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            unreadable_files_say_why, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            pipes_are_read, test_run_setup, test_run_teardown)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_mark.c -- files that say what they are, and whether they are whole. */
#include "support.h"

#include "file/mark.h"

#include <unistd.h>

static const char JOB[] = "0123456789abcdef0123456789abcdef";

static void
names_become_plain_and_stay_apart(void **state)
{
    static const struct
    {
        const char *path, *source;
    } rows[] = {
        {"a/shirt.obj", "shirt.obj"}, {"shirt-2_b.obj", "shirt-2_b.obj"},
        {"a b.obj", "a_b.obj_"},      {"a--b.obj", "a-_b.obj_"},
        {"\xff\n.obj", "__.obj_"},
    };
    char longest[256];
    otx_mark a, b;

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
    {
        otx_mark_set_source(&a, rows[i].path);
        assert_int_equal(
            strncmp(a.source, rows[i].source, strlen(rows[i].source)), 0);
    }
    otx_mark_set_source(&a, "a b.obj");
    otx_mark_set_source(&b, "a\tb.obj");
    assert_string_not_equal(a.source, b.source);
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    otx_mark_set_source(&a, longest);
    assert_true(strlen(a.source) < OTX_MARK_SOURCE_BYTES);
}

static void
put(const char *path, const char *text, size_t bytes)
{
    FILE *file = fopen(path, "wb");

    assert_int_equal(fwrite(text, 1, bytes, file), bytes);
    fclose(file);
}

/* Any byte that changes, goes or comes breaks the seal. */
static void
a_seal_knows_every_byte(void **state)
{
    otx_mark mark = {0};
    otx_mark_found found;
    char path[] = "/tmp/osdtex-mark-XXXXXX", line[OTX_MARK_BYTES];
    char text[2 * OTX_MARK_BYTES];
    size_t size;
    FILE *file;

    (void)state;
    close(mkstemp(path));
    strcpy(mark.job, JOB);
    otx_mark_set_source(&mark, "shirt.obj");
    otx_mark_print(&mark, line);
    size = (size_t)snprintf(
        text, sizeof text, "# osdtex 0.1.0\n# %s\nv 0 0 0\n", line);
    put(path, text, size);
    assert_true(otx_mark_read(path, true, &found));
    assert_false(found.is_whole);
    assert_int_equal(otx_mark_seal(path), 0);
    assert_true(otx_mark_read(path, true, &found));
    assert_true(found.is_whole);
    assert_string_equal(found.mark.job, JOB);
    assert_string_equal(found.mark.source, "shirt.obj");
    file = fopen(path, "rb");
    assert_int_equal(fread(text, 1, sizeof text, file), size);
    fclose(file);
    for (size_t i = 0; i < size; ++i)
    {
        text[i] ^= 1;
        put(path, text, size);
        otx_mark_read(path, true, &found);
        text[i] ^= 1;
        assert_false(found.is_whole && strcmp(found.mark.job, JOB) == 0);
    }
    for (size_t bytes = 0; bytes < size; ++bytes)
    {
        put(path, text, bytes);
        otx_mark_read(path, true, &found);
        assert_false(found.is_whole);
    }
    unlink(path);
}

static void
other_files_have_no_mark(void **state)
{
    char path[] = "/tmp/osdtex-mark-XXXXXX";
    otx_mark_found found;

    (void)state;
    close(mkstemp(path));
    assert_false(otx_mark_read(path, true, &found));
    put(path, "# osdtex 0.1.0\nosdtex job 12", 28);
    assert_false(otx_mark_read(path, true, &found));
    assert_int_equal(otx_mark_seal(path), 0);
    assert_false(otx_mark_read("/dev/null", true, &found));
    assert_false(otx_mark_read("/nowhere", true, &found));
    unlink(path);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_become_plain_and_stay_apart),
        cmocka_unit_test(a_seal_knows_every_byte),
        cmocka_unit_test(other_files_have_no_mark),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

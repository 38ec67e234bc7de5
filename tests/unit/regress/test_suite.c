/* test_suite.c -- tables of a regression suite, as products of their rows. */
#include "support.h"

#include "regress/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char WHOLE[] =
    "{\"threads\": 2, \"rows\": [\n"
    " {\"cages\": [\"a.obj\", \"/b/b c.obj\"], \"exemplars\": [\"x.png\"],\n"
    "  \"methods\": [\"tile\", \"lapped\"],\n"
    "  \"options\": {\"\": \"--level 1\", \"two\": \"--level 2\"}},\n"
    " {\"cages\": [\"d.obj\"], \"exemplars\": [\"y.exr\", \"z.exr\"],\n"
    "  \"methods\": [\"vertex\"], \"tiles\": \"--tile-size 64\"}]}\n";

typedef struct place
{
    char folder[64], file[96];
} place;

static int
make_place(void **state)
{
    place *p = calloc(1, sizeof *p);

    if (!p)
        return -1;
    snprintf(p->folder, sizeof p->folder, "/tmp/osdtex-test-suite-XXXXXX");
    if (!mkdtemp(p->folder))
        return -1;
    snprintf(p->file, sizeof p->file, "%s/table.json", p->folder);
    *state = p;
    return 0;
}

static int
remove_place(void **state)
{
    place *p = *state;

    unlink(p->file);
    rmdir(p->folder);
    free(p);
    return 0;
}

static bool
read_bytes(
    const place *p, const char *text, size_t length, otx_suite *suite,
    char *error)
{
    FILE *out = fopen(p->file, "w");

    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, length, out), length);
    assert_int_equal(fclose(out), 0);
    return otx_suite_read(p->folder, suite, error);
}

static void
a_row_is_the_product_of_its_lists(void **state)
{
    const place *p = *state;
    char error[OTX_SUITE_ERROR_BYTES], path[128];
    otx_suite suite;
    const json_t *item;

    assert_true(read_bytes(p, WHOLE, strlen(WHOLE), &suite, error));
    assert_int_equal(json_object_size(suite.cases), 2 * 1 * 2 * 2 + 2);

    item = json_object_get(suite.cases, "a.x.lapped.two");
    assert_string_equal(otx_suite_text(item, "options"), "--level 2");
    snprintf(path, sizeof path, "%s/a.obj", p->folder);
    assert_string_equal(otx_suite_text(item, "cage"), path);
    assert_null(json_object_get(item, "tiles"));

    item = json_object_get(suite.cases, "b_c.x.tile");
    assert_string_equal(otx_suite_text(item, "cage"), "/b/b c.obj");
    item = json_object_get(suite.cases, "d.z.vertex");
    assert_string_equal(otx_suite_text(item, "tiles"), "--tile-size 64");
    assert_string_equal(otx_suite_text(item, "options"), "");

    assert_true(otx_suite_number(&suite, "threads", 1.0) == 2.0);
    assert_true(otx_suite_number(&suite, "timeout", 7.0) == 7.0);
    otx_suite_free(&suite);
}

static void
no_prefix_of_a_table_is_one(void **state)
{
    for (size_t length = 0; length + 2 < sizeof WHOLE; ++length)
    {
        char error[OTX_SUITE_ERROR_BYTES] = "";
        otx_suite suite;

        assert_false(read_bytes(*state, WHOLE, length, &suite, error));
        assert_non_null(strstr(error, "table.json:"));
        assert_null(suite.table);
        assert_null(suite.cases);
    }
}

static void
no_broken_byte_does_harm(void **state)
{
    static const char bytes[] = {'\0', '"', '{', ']', '\\', '\xff', '1', ' '};
    char text[sizeof WHOLE];

    for (size_t at = 0; at + 1 < sizeof WHOLE; at += 3)
        for (size_t i = 0; i < sizeof bytes; ++i)
        {
            char error[OTX_SUITE_ERROR_BYTES] = "";
            otx_suite suite;

            memcpy(text, WHOLE, sizeof WHOLE);
            text[at] = bytes[i];
            if (read_bytes(*state, text, sizeof WHOLE - 1, &suite, error))
            {
                assert_true(json_object_size(suite.cases) > 0);
                otx_suite_free(&suite);
            }
            else
                assert_true(strlen(error) > 10);
        }
}

static void
what_is_wrong_is_named(void **state)
{
    static const struct
    {
        const char *table, *words;
    } rows[] = {
        {"{}", "no \"rows\""},
        {"{\"rows\": []}", "no \"rows\""},
        {"{\"rows\": [{}]}", "row 0 has no \"cages\""},
        {"{\"rows\": [{\"cages\": [\"a\"], \"exemplars\": []}]}",
         "\"exemplars\""},
        {"{\"rows\": [{\"cages\": [\"a\", 3]}]}", "number 1 is no text"},
        {"{\"rows\": [{\"cages\": [\"a\"], \"exemplars\": [\"a\"], "
         "\"methods\": [\"m\"], \"options\": {\"o\": 1}}]}",
         "called 'o'"},
        {"{\"rows\": [{\"cages\": [\"a.obj\", \"b/a.obj\"], "
         "\"exemplars\": [\"a\"], \"methods\": [\"m\"]}]}",
         "two cases are called 'a.a.m'"},
        {"{\"rows\": 1, \"rows\": 2}", "duplicate"},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
    {
        char error[OTX_SUITE_ERROR_BYTES] = "";
        otx_suite suite;

        assert_false(read_bytes(
            *state, rows[i].table, strlen(rows[i].table), &suite, error));
        if (!strstr(error, rows[i].words))
            fail_msg("'%s' lacks '%s'", error, rows[i].words);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_is_the_product_of_its_lists),
        cmocka_unit_test(no_prefix_of_a_table_is_one),
        cmocka_unit_test(no_broken_byte_does_harm),
        cmocka_unit_test(what_is_wrong_is_named),
    };

    return cmocka_run_group_tests(tests, make_place, remove_place);
}

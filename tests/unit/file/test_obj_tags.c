/* test_obj_tags.c -- the grammar of subdivision tags. */
#include "obj_support.h"

#include "file/obj.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"

/* Integers are edges, not a chain, with one sharpness for all or one each. */
static void
one_line_may_hold_many_edges(void **state)
{
    static const int32_t edges[] = {0, 1, 2, 3, 1, 2, 3, 0};
    static const float sharpness[] = {2, 2, 3, 4};
    const otx_obj obj = test_obj_parse(
        *state, SQUARE "t crease 4/1/0 0 1 2 3 2\n"
                       "t crease 4/2/0 1 2 3 0 3 4\n");

    assert_int_equal(obj.creases.count, 4);
    assert_memory_equal(obj.creases.verts, edges, sizeof edges);
    assert_memory_equal(obj.creases.sharpness, sharpness, sizeof sharpness);
}

static void
one_line_may_hold_many_corners(void **state)
{
    static const float sharpness[] = {2, 2, 3, 4};
    const otx_obj obj = test_obj_parse(
        *state, SQUARE "t corner 2/1/0 0 1 2\nt corner 2/2/0 2 3 3 4\n");

    assert_int_equal(obj.corners.count, 4);
    assert_int_equal(obj.corners.verts[3], 3);
    assert_memory_equal(obj.corners.sharpness, sharpness, sizeof sharpness);
}

static void
the_last_rule_counts(void **state)
{
    const otx_obj obj = test_obj_parse(
        *state, SQUARE "t interpolateboundary 1/0/0 1\n"
                       "t interpolateboundary 1/0/0 0\n"
                       "t facevaryinginterpolateboundary 1/0/0 5\n"
                       "t creasemethod 0/0/1 normal\n"
                       "t smoothtriangles 0/0/1 smooth\n");

    assert_int_equal(obj.boundary.value, 0);
    assert_int_equal(obj.boundary.line, 7);
    assert_int_equal(obj.fvar.value, 5);
    assert_int_equal(obj.crease_method.value, OTX_OBJ_CREASE_NORMAL);
    assert_int_equal(obj.triangles.value, OTX_OBJ_TRIANGLES_SMOOTH);
}

static void
other_tags_are_warned_about(void **state)
{
    otx_run *run = *state;
    osdtex_diagnostic d;

    test_obj_parse(
        run, SQUARE "t vertexedit 99/99/99\nt facevaryingpropagatecorners\n"
                    "t what ever\n");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
    otx_diagnostics_get(run->diagnostics, 0, &d);
    assert_int_equal(d.severity, OSDTEX_SEVERITY_WARNING);
    assert_int_equal(d.count, 3);
    assert_int_equal(d.line, 6);
}

static void
embree_edges_count_from_one(void **state)
{
    static const int32_t edges[] = {0, 1, 3, 2};
    const otx_obj obj =
        test_obj_parse(*state, SQUARE "ec 1.5 1 2\nec 10 -1 -2\n");

    assert_int_equal(obj.creases.count, 2);
    assert_memory_equal(obj.creases.verts, edges, sizeof edges);
    assert_true(obj.creases.sharpness[0] == 1.5f);
    assert_int_equal(obj.creases.line[1], 7);
}

static const struct
{
    const char *line;
    const char *words;
} MISTAKES[] = {
    {"t", "no name"},
    {"t crease", "as in 2/1/0"},
    {"t crease 2/1", "as in 2/1/0"},
    {"t crease 2/1/0/0 0 1 1", "as in 2/1/0"},
    {"t crease 2/1/x 0 1 1", "as in 2/1/0"},
    {"t crease -2/1/0 0 1 1", "as in 2/1/0"},
    {"t crease 99999999999999999999/1/0 0", "as in 2/1/0"},
    {"t crease 999999999/1/0 0", "999999999/1/0 values, and 1 follow"},
    {"t crease 9223372036854775807/9223372036854775807/2 0", "1 follow"},
    {"t crease 2/1/0 0 1 2 3", "and 4 follow"},
    {"t crease 2/1/0 0 1", "and 2 follow"},
    {"t crease 3/1/0 0 1 2 1", "2n/1/0 or 2n/n/0 are expected"},
    {"t crease 4/3/0 0 1 2 3 1 1 1", "are expected"},
    {"t crease 2/0/0 0 1", "are expected"},
    {"t crease 0/1/0 1", "are expected"},
    {"t crease 2/1/1 0 1 1 x", "are expected"},
    {"t crease 2/1/0 0 -1 1", "not between 0"},
    {"t crease 2/1/0 0 4 1", "vertex 4, counted from 0"},
    {"t crease 2/1/0 0 1.5 1", "not a number"},
    {"t crease 2/1/0 0 1 nan", "not a finite number"},
    {"t crease 2/1/0 0 1 1e99", "too large"},
    {"t corner 1/2/0 0 1 1", "n/1/0 or n/n/0"},
    {"t corner 1/1/0 4 1", "vertex 4"},
    {"t hole 1/0/0 1", "face 1, counted from 0"},
    {"t hole 1/1/0 0 1", "n/0/0"},
    {"t interpolateboundary 1/0/0 3", "not between 0 and 2"},
    {"t interpolateboundary 2/0/0 1 1", "1/0/0 are expected"},
    {"t facevaryinginterpolateboundary 1/0/0 6", "not between 0 and 5"},
    {"t creasemethod 0/0/1 smooth", "normal and chaikin, not 'smooth'"},
    {"t creasemethod 1/0/0 1", "0/0/1 are expected"},
    {"ec 1 1", "two vertices"},
    {"ec 1 1 2 3", "two vertices"},
    {"ec x 1 2", "not a number"},
    {"ec 1 0 2", "counts from 1"},
    {"ec 1 1 5", "vertex 4, counted from 0"},
    {"ec 1 1 -5", "there are 4"}};

static void
errors_name_the_line(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof MISTAKES / sizeof *MISTAKES; ++i)
    {
        otx_run *run = test_run_create_with(NULL, 1);
        char text[256];
        osdtex_diagnostic d;
        otx_obj obj;

        snprintf(text, sizeof text, SQUARE "%s\n", MISTAKES[i].line);
        assert_int_equal(
            otx_obj_parse(run, "t.obj", text, strlen(text), &obj),
            OSDTEX_ERROR_FORMAT);
        otx_diagnostics_get(run->diagnostics, 0, &d);
        assert_int_equal(d.line, 6);
        if (!strstr(d.message, MISTAKES[i].words))
            fail_msg("\"%s\" lacks \"%s\"", d.message, MISTAKES[i].words);
        test_run_destroy(run);
    }
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)
    const struct CMUnitTest tests[] = {TEST(one_line_may_hold_many_edges),
                                       TEST(one_line_may_hold_many_corners),
                                       TEST(the_last_rule_counts),
                                       TEST(other_tags_are_warned_about),
                                       TEST(embree_edges_count_from_one),
                                       cmocka_unit_test(errors_name_the_line)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

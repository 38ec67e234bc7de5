/* test_constraint_file.c -- what is read, and what is refused how. */
#include "file/constraint_file.h"
#include "support.h"

#include <stdlib.h>
#include <unistd.h>

static otx_status
read_text(
    otx_run *run, const char *extension, const char *text,
    otx_constraint_file *out)
{
    char path[64];
    otx_status status;
    FILE *file;

    snprintf(path, sizeof path, "/tmp/osdtex-%d.%s", (int)getpid(), extension);
    file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    status = otx_constraint_file_read(run, path, out);
    remove(path);
    return status;
}

static void
reads_json(void **state)
{
    otx_run *run = test_run_create();
    otx_constraint_file f;

    (void)state;
    assert_int_equal(
        read_text(
            run, "json",
            "{\"symmetry\": 2, \"follow\": [0, 1, 0], \"follow-length\": 3,\n"
            " \"constraints\": [{\"face\": 7, \"direction\": [1, 0, 0]},\n"
            "  {\"point\": [1, 2, 3.5], \"radius\": 0.5, \"scale\": 2}]}",
            &f),
        OSDTEX_OK);
    assert_int_equal(f.symmetry, 2);
    assert_string_equal(f.follow, "axis");
    assert_true(f.axis[1] == 1.0 && f.follow_length == 3.0);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.lines[0].face, 7);
    assert_true(f.lines[0].has_direction && f.lines[0].scale == 0.0);
    assert_int_equal(f.lines[1].face, -1);
    assert_true(f.lines[1].point[2] == 3.5 && f.lines[1].radius == 0.5);
    assert_true(!f.lines[1].has_direction && f.lines[1].scale == 2.0);
    test_run_destroy(run);
}

static void
reads_csv(void **state)
{
    otx_run *run = test_run_create();
    otx_constraint_file f;

    (void)state;
    assert_int_equal(
        read_text(run, "csv", "face,x,y,z\n0,1,0,0\n\n12, 0,0 ,-1e2,1.5\n", &f),
        OSDTEX_OK);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.lines[1].face, 12);
    assert_true(f.lines[1].direction[2] == -100.0 && f.lines[1].scale == 1.5);
    test_run_destroy(run);
}

static void
reads_exemplars(void **state)
{
    otx_run *run = test_run_create();
    otx_constraint_file f;

    (void)state;
    assert_int_equal(
        read_text(
            run, "json",
            "{\"constraints\": [{\"face\": 7, \"exemplar\": 3},\n"
            "  {\"face\": 8, \"exemplar\": \"moss.png\"}]}",
            &f),
        OSDTEX_OK);
    assert_int_equal(f.lines[0].exemplar, 3);
    assert_null(f.lines[0].exemplar_name);
    assert_int_equal(f.lines[1].exemplar, 0);
    assert_string_equal(f.lines[1].exemplar_name, "moss.png");
    assert_int_equal(
        read_text(
            run, "csv",
            "face,x,y,z,scale, exemplar\n0,0,0,0,1,4\n1,0,0,0,1,0\n", &f),
        OSDTEX_OK);
    assert_int_equal(f.lines[0].exemplar, 4);
    assert_int_equal(f.lines[1].exemplar, 0);
    assert_false(f.lines[0].has_material || f.lines[1].has_material);
    test_run_destroy(run);
}

static void
refuses_with_a_sentence(void **state)
{
    static const struct
    {
        const char *extension, *text, *says;
    } cases[] = {
        {"json", "{", "no JSON"},
        {"json", "[]", "object"},
        {"json", "{\"simmetry\": 1}", "\"simmetry\" is not known"},
        {"json", "{\"symmetry\": 3}", "1, 2 or 4"},
        {"json", "{\"follow\": [1, 2]}", "three numbers"},
        {"json", "{\"follow\": \"fur\"}", "curvature"},
        {"json", "{\"constraints\": [{\"face\": 1, \"material\": 2}]}",
         "0 to 1"},
        {"csv", "0,1,0,0,1,7\n", "face,x,y,z"},
        {"csv", "face,x,y,z,scale,exemplar\n0,1,0,0,1,0.5\n", "from 1"},
        {"json", "{\"constraints\": [{\"face\": 1, \"exemplar\": 0}]}",
         "from 1"},
        {"json", "{\"constraints\": [{\"face\": 1, \"exemplar\": \"\"}]}",
         "from 1"},
        {"json",
         "{\"constraints\": [{\"face\": 1, \"exemplar\": 1, "
         "\"material\": 0}]}",
         "give one"},
        {"json", "{\"constraints\": [{\"face\": 1}]}", "constraint 1"},
        {"json", "{\"constraints\": [{\"direction\": [1,0,0]}]}", "point"},
        {"json", "{\"constraints\": [{\"face\": -1, \"scale\": 1}]}", "from 0"},
        {"json", "{\"constraints\": [{\"face\": 1, \"scale\": 0}]}",
         "positive"},
        {"json", "{\"constraints\": [{\"face\": 1, \"angle\": 0}]}",
         "not known"},
        {"csv", "0,1,0\n1,2\n", "face,x,y,z"},
        {"csv", "0,1,0,0\nx,1,0,0\n", "face,x,y,z"},
        {"csv", "0,nan,0,0\n", "face,x,y,z"},
        {"csv", "0,1,0,0,-1\n", "face,x,y,z"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    {
        otx_run *run = test_run_create();
        otx_constraint_file f;

        assert_int_equal(
            read_text(run, cases[i].extension, cases[i].text, &f),
            OSDTEX_ERROR_FORMAT);
        if (!strstr(test_last_message(run), cases[i].says))
            fail_msg("'%s': %s", cases[i].text, test_last_message(run));
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_json),
        cmocka_unit_test(reads_csv),
        cmocka_unit_test(reads_exemplars),
        cmocka_unit_test(refuses_with_a_sentence),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

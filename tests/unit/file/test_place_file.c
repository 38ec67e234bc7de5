/* test_place_file.c -- what is read of pictures to be placed, and what is
 * refused how. */
#include "file/place_file.h"
#include "support.h"

#include <unistd.h>

static otx_status
read_text(
    otx_run *run, const char *extension, const char *text, otx_place_file *out)
{
    char path[64];
    otx_status status;
    FILE *file;

    snprintf(path, sizeof path, "/tmp/osdtex-p%d.%s", (int)getpid(), extension);
    file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    status = otx_place_file_read(run, path, out);
    remove(path);
    return status;
}

static void
reads_json(void **state)
{
    otx_run *run = *state;
    otx_place_file f;

    assert_int_equal(
        read_text(
            run, "json",
            "{\"placed\": [\n"
            " {\"picture\": \"a.png\", \"face\": 7, \"width\": 2},\n"
            " {\"picture\": \"/b/c.exr\", \"from\": \"raw\",\n"
            "  \"points\": [[1, 2, 3], [4, 5, 6]], \"width\": 1.5,\n"
            "  \"height\": 2, \"up\": [0, 0, 1], \"turn\": 45,\n"
            "  \"mirror\": true, \"opacity\": 0.5, \"anchor\": [0, 1]},\n"
            " {\"picture\": \"a.png\", \"scatter\": 12, \"width\": 2}]}",
            &f),
        OSDTEX_OK);
    assert_int_equal(f.count, 4);
    assert_string_equal(f.lines[0].picture, "/tmp/a.png");
    assert_int_equal(f.lines[0].face, 7);
    assert_true(f.lines[0].opacity == 1.0 && f.lines[0].anchor[1] == 0.5);
    assert_string_equal(f.lines[2].picture, "/b/c.exr");
    assert_string_equal(f.lines[2].from, "raw");
    assert_int_equal(f.lines[2].face, -1);
    assert_int_equal(f.lines[2].number, 2);
    assert_true(f.lines[2].point[0] == 4.0 && f.lines[2].up[2] == 1.0);
    assert_true(f.lines[2].mirror && f.lines[2].turn == 45.0);
    assert_int_equal(f.lines[3].scatter, 12);
}

static void
reads_csv(void **state)
{
    otx_run *run = *state;
    otx_place_file f;

    assert_int_equal(
        read_text(
            run, "csv",
            "picture,face,x,y,z,width,ux,uy,uz,mirror\n# knots\n"
            "knot.png, 4,,,,0.5\nknot.png,,1,2,3,0.25,0,1,0,1\n",
            &f),
        OSDTEX_OK);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.lines[0].face, 4);
    assert_false(f.lines[0].has_up || f.lines[0].mirror);
    assert_true(f.lines[1].point[2] == 3.0 && f.lines[1].up[1] == 1.0);
    assert_true(f.lines[1].has_up && f.lines[1].mirror);
}

static void
refuses(void **state)
{
    static const struct
    {
        const char *extension, *text, *sentence;
    } cases[] = {
        {"json", "{", "no JSON"},
        {"json", "[]", "\"placed\", which is a list"},
        {"json", "{\"placed\": [3]}", "holds objects"},
        {"json", "{\"placed\": [{\"face\": 1, \"width\": 1}]}",
         "\"picture\" is needed"},
        {"json", "{\"placed\": [{\"picture\": \"a\", \"face\": 1}]}",
         "\"width\" is needed"},
        {"json", "{\"placed\": [{\"picture\": \"a\", \"width\": 1}]}",
         "\"face\" or \"point\""},
        {"json",
         "{\"placed\": [{\"picture\": \"a\", \"width\": 1, \"face\": 1, "
         "\"scatter\": 3}]}",
         "one of them"},
        {"json",
         "{\"placed\": [{\"picture\": \"a\", \"width\": -1, \"face\": 1}]}",
         "placed 1: \"width\" is a positive"},
        {"json",
         "{\"placed\": [{\"picture\": \"a\", \"width\": 1, \"face\": -2}]}",
         "\"face\" is a face of the cage"},
        {"json", "{\"placed\": [{\"colour\": 1}]}", "is not known"},
        {"json",
         "{\"placed\": [{\"picture\": \"a\", \"width\": 1, \"points\": []}]}",
         "one or more"},
        {"json",
         "{\"placed\": [{\"picture\": \"a\", \"width\": 1, \"face\": 1, "
         "\"up\": [0, 0, 0]}]}",
         "not all 0"},
        {"csv", "a,b\n", "names the columns"},
        {"csv", "picture,face,width\na.png,x,1\n", "no number"},
        {"csv", "picture,face,width\na.png,1,1,1\n", "more cells"},
        {"csv", "picture,face,width\na.png,1,0\n", "width is a positive"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        otx_run *run = test_run_create();
        otx_place_file f;

        assert_int_equal(
            read_text(run, cases[i].extension, cases[i].text, &f),
            OSDTEX_ERROR_FORMAT);
        if (!strstr(test_last_message(run), cases[i].sentence))
            fail_msg("%s: %s", cases[i].text, test_last_message(run));
        test_run_destroy(run);
    }
    (void)state;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(reads_json),
        test_with_run(reads_csv),
        cmocka_unit_test(refuses),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

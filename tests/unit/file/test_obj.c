/* test_obj.c -- the OBJ dialects, their errors, and damaged files. */
#include "obj_support.h"

#include "base/random.h"
#include "file/obj.h"

#include <dirent.h>
#include <stdlib.h>

/* A square with UVs, groups, materials and tags: something of everything. */
static const char square[] = "# a square\n"
                             "mtllib a b.mtl\n"
                             "v 0 0 0\n"
                             "v 1 0 0\n"
                             "v 1 1 0 1.0\n"
                             "v 0 1 0\n"
                             "v .5 5.e-1 1e0\n"
                             "vt 0 0\nvt 1\nvt 1 1 0\n"
                             "vn 0 0 1\n"
                             "o thing\n"
                             "g left right\n"
                             "usemtl red  paint \n"
                             "s 1\n"
                             "f 1/1/1 2/2/1 3/3/1\n"
                             "s off\n"
                             "f -5//-1 -3//1 \\\n"
                             " -2//1 5//1\n"
                             "t crease 2/1/0 0 1 2.5\n"
                             "t corner 1/1/0 3 10\n"
                             "t hole 1/0/0 1\n"
                             "t interpolateboundary 1/0/0 2\n"
                             "t creasemethod 0/0/1 chaikin\n"
                             "ec 3 -5 3\n";

static void
everything_is_read(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 0, 2, 3, 4};
    static const int32_t uvs[] = {0, 1, 2, -1, -1, -1, -1};
    static const int32_t firsts[] = {0, 3, 7};
    static const float texture[] = {0, 0, 1, 0, 1, 1};
    static const float last[] = {.5f, .5f, 1};
    const otx_obj obj = test_obj_parse(*state, square);

    assert_string_equal(obj.path, "t.obj");
    assert_int_equal(obj.vert_count, 5);
    assert_int_equal(obj.uv_count, 3);
    assert_int_equal(obj.face_count, 2);
    assert_int_equal(obj.corner_count, 7);
    assert_memory_equal(obj.face_first, firsts, sizeof firsts);
    assert_memory_equal(obj.face_verts, verts, sizeof verts);
    assert_memory_equal(obj.face_uvs, uvs, sizeof uvs);
    assert_memory_equal(obj.uvs, texture, sizeof texture);
    assert_memory_equal(obj.points + 12, last, sizeof last);
    assert_null(obj.colors);
    assert_int_equal(obj.face_line[0], 16);
    assert_int_equal(obj.face_line[1], 18);
    assert_int_equal(
        otx_diagnostics_count(((otx_run *)*state)->diagnostics), 0);
}

static void
names_are_verbatim(void **state)
{
    const otx_obj obj = test_obj_parse(*state, square);

    assert_int_equal(obj.groups.count, 1);
    assert_string_equal(obj.groups.text[0], "left right");
    assert_string_equal(obj.objects.text[0], "thing");
    assert_string_equal(obj.materials.text[0], "red  paint");
    assert_int_equal(obj.smooths.count, 2);
    assert_string_equal(obj.smooths.text[1], "off");
    assert_string_equal(obj.libraries.text[0], "a b.mtl");
    assert_int_equal(obj.face_smooth[0], 0);
    assert_int_equal(obj.face_smooth[1], 1);
    assert_int_equal(obj.face_material[1], 0);
}

static void
names_occur_once_and_may_be_absent(void **state)
{
    const otx_obj obj = test_obj_parse(
        *state, "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
                "f 1 2 3\ng a\nf 1 2 3\ng b\\\n c\nf 1 2 3\ng a\nf 1 2 3\n"
                "g b   c\nf 1 2 3\ng\nf 1 2 3\n");
    static const int32_t groups[] = {-1, 0, 1, 0, 1, -1};

    assert_int_equal(obj.groups.count, 2);
    assert_string_equal(obj.groups.text[1], "b   c");
    assert_memory_equal(obj.face_group, groups, sizeof groups);
    assert_int_equal(obj.face_object[0], -1);
}

static void
tags_are_read(void **state)
{
    const otx_obj obj = test_obj_parse(*state, square);
    static const int32_t edges[] = {0, 1, 0, 2};

    assert_int_equal(obj.creases.count, 2);
    assert_memory_equal(obj.creases.verts, edges, sizeof edges);
    assert_true(obj.creases.sharpness[0] == 2.5f);
    assert_true(obj.creases.sharpness[1] == 3);
    assert_int_equal(obj.creases.line[0], 20);
    assert_int_equal(obj.creases.line[1], 25);
    assert_int_equal(obj.corners.count, 1);
    assert_int_equal(obj.corners.verts[0], 3);
    assert_int_equal(obj.hole_count, 1);
    assert_int_equal(obj.hole_faces[0], 1);
    assert_int_equal(obj.boundary.value, 2);
    assert_int_equal(obj.boundary.line, 23);
    assert_int_equal(obj.fvar.value, -1);
    assert_int_equal(obj.crease_method.value, OTX_OBJ_CREASE_CHAIKIN);
    assert_int_equal(obj.triangles.value, -1);
}

static void
vertices_have_weights_or_colors(void **state)
{
    otx_run *run = *state;
    static const float colors[] = {1, 1, 1, .1f, .2f, .3f, .4f, .5f, .6f};
    const otx_obj obj = test_obj_parse(
        run, "v 1 2 3 2\nv 4 5 6 .1 .2 .3\nv 7 8 9 .4 .5 .6 1\n");

    assert_int_equal(obj.vert_count, 3);
    assert_true(obj.points[2] == 3 && obj.points[3] == 4);
    assert_memory_equal(obj.colors, colors, sizeof colors);
    assert_non_null(strstr(test_last_message(run), "weight"));
}

static void
faces_may_refer_forward(void **state)
{
    const otx_obj obj =
        test_obj_parse(*state, "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0");

    assert_int_equal(obj.face_verts[2], 2);
}

static void
ignored_kinds_are_counted_once(void **state)
{
    otx_run *run = *state;
    osdtex_diagnostic d;

    test_obj_parse(
        run, "v 0 0 0\nl 1 1\np 1\nl 1 1\nvp 0 0\nlod 3\nwhat \x1B\nfo 1\n");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 4);
    otx_diagnostics_get(run->diagnostics, 0, &d);
    assert_int_equal(d.severity, OSDTEX_SEVERITY_WARNING);
    assert_int_equal(d.line, 2);
    assert_non_null(strstr(d.message, "number is 3"));
    otx_diagnostics_get(run->diagnostics, 3, &d);
    assert_int_equal(d.line, 7);
    assert_non_null(strstr(d.message, "is 2, and the first is 'what'"));
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void
errors_name_the_line(void **state)
{
    static const struct
    {
        const char *text;
        int64_t line;
        const char *words;
    } cases[] = {
        {"v 0 0\n", 1, "3, 4, 6 or 7 numbers, not 2"},
        {"v 0 0 0 0 0\n", 1, "not 5"},
        {"v 0 0 0 0 0 0 0 0\n", 1, "not more than 7"},
        {"\nv 0 x 0\n", 2, "'x' is not a number"},
        {"v 0 3.1+e2 0\n", 1, "is not a number"},
        {"v 0 1,5 0\n", 1, "is not a number"},
        {"v 0 1e99 0\n", 1, "too large"},
        {"v 0 nan 0\n", 1, "not a finite number"},
        {"v 0 -inf 0\n", 1, "not a finite number"},
        {"vt\n", 1, "not none"},
        {"vt 0 0 0 0\n", 1, "not more"},
        {TRIANGLE "f 1 2\n", 4, "at least 3 corners"},
        {TRIANGLE "f\n", 4, "this one has 0"},
        {TRIANGLE "f 1 2 0\n", 4, "vertex 0 does not exist"},
        {TRIANGLE "f 1 2 4\n", 4, "the file has 3"},
        {TRIANGLE "f 1 2 -4\n", 4, "up to this line there are 3"},
        {TRIANGLE "f 1 2 2147483648\n", 4, "numbers end at"},
        {TRIANGLE "f 1 2 99999999999999999999\n", 4, "numbers end at"},
        {TRIANGLE "f 1/1 2/1 3/1\n", 4, "texture vertex 1 does not exist"},
        {TRIANGLE "vt 0 0\nf 1/1 2/1 3/0\n", 5, "texture vertex 0"},
        {TRIANGLE "vt 0 0\nf 1/1 2/1 3\n", 5, "some corners"},
        {TRIANGLE "f 1 2 3/\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 3//\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 3//0\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 3/1/1/\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 3/1/1/1\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 /3\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 3.0\n", 4, "no corner of a face"},
        {TRIANGLE "f 1 2 \\", 4, "no corner of a face"},
        {"\xFF\xFEv", 0, "save it as UTF-8"},
        {"", 0, "empty"}};

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        otx_run *run = test_run_create_with(NULL, 1);
        osdtex_diagnostic d;
        otx_obj obj;

        assert_int_equal(
            otx_obj_parse(
                run, "t.obj", cases[i].text, strlen(cases[i].text), &obj),
            OSDTEX_ERROR_FORMAT);
        assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
        otx_diagnostics_get(run->diagnostics, 0, &d);
        assert_string_equal(d.file, "t.obj");
        assert_int_equal(d.line, cases[i].line);
        if (!strstr(d.message, cases[i].words))
            fail_msg("\"%s\" lacks \"%s\"", d.message, cases[i].words);
        test_run_destroy(run);
    }
}

/* What must hold of everything that was read, however damaged the file. */
static void
check_invariants(const otx_obj *obj)
{
    assert_int_equal(obj->face_first[0], 0);
    assert_int_equal(obj->face_first[obj->face_count], obj->corner_count);
    for (int32_t f = 0; f < obj->face_count; ++f)
    {
        assert_true(obj->face_first[f + 1] - obj->face_first[f] >= 3);
        assert_in_range(obj->face_group[f] + 1, 0, obj->groups.count);
        assert_in_range(obj->face_material[f] + 1, 0, obj->materials.count);
    }
    for (int32_t c = 0; c < obj->corner_count; ++c)
    {
        assert_in_range(obj->face_verts[c], 0, obj->vert_count - 1);
        assert_in_range(obj->face_uvs[c] + 1, 0, obj->uv_count);
    }
    for (int32_t i = 0; i < 2 * obj->creases.count; ++i)
        assert_in_range(obj->creases.verts[i], 0, obj->vert_count - 1);
    for (int32_t i = 0; i < obj->hole_count; ++i)
        assert_in_range(obj->hole_faces[i], 0, obj->face_count - 1);
}

/* Parses bytes that may be anything: the result holds together, or there is
 * one error that names a line of the file. */
static void
parse_damaged(const char *bytes, size_t size)
{
    otx_run *run = test_run_create_with(NULL, 1);
    /* Of exactly this size, so that reading past the end is caught. */
    char *copy = malloc(size ? size : 1);
    int64_t lines = 1;
    osdtex_diagnostic d;
    otx_obj obj;

    memcpy(copy, bytes, size);
    for (size_t i = 0; i < size; ++i)
        lines += bytes[i] == '\n' || bytes[i] == '\r';
    if (otx_obj_parse(run, "t.obj", copy, size, &obj) == OSDTEX_OK)
        check_invariants(&obj);
    else
    {
        const int32_t count = otx_diagnostics_count(run->diagnostics);

        assert_true(count > 0);
        otx_diagnostics_get(run->diagnostics, count - 1, &d);
        assert_int_equal(d.severity, OSDTEX_SEVERITY_ERROR);
        assert_in_range(d.line, 0, lines);
    }
    free(copy);
    test_run_destroy(run);
}

static void
any_prefix_parses_or_names_a_line(void **state)
{
    (void)state;
    for (size_t size = 0; size < sizeof square; ++size)
        parse_damaged(square, size);
}

static void
mutated_files_parse_or_fail(void **state)
{
    static const char likely[] = "\n\r\\ \t/-+.e0129vtfgsco#\"\xFF";
    char bytes[sizeof square - 1];

    (void)state;
    for (uint64_t k = 0; k < 2000; ++k)
    {
        const uint64_t mutations = 1 + otx_random_bits(1, 0, k) % 4;

        memcpy(bytes, square, sizeof bytes);
        for (uint64_t m = 0; m < mutations; ++m)
        {
            const uint64_t r = otx_random_bits(2, (uint32_t)m, k);
            const char any = (char)(r >> 40);

            bytes[(r & 0xFFFFFF) % sizeof bytes] =
                (r >> 32) % 4 ? likely[(r >> 40) % (sizeof likely - 1)] : any;
        }
        parse_damaged(bytes, sizeof bytes);
    }
}

typedef struct expected
{
    char file[96];
    int32_t verts, faces, triangles, quads, more, creases, corners;
    char uvs[8];
} expected;

/* One row of the table in SOURCES.md that describes the cages. */
static bool
parse_row(const char *row, expected *e)
{
    return sscanf(
               row,
               "|%95[^|]|%d|%d|%d/%d/%d|%*[^|]|%*[^|]|%*[^|]|%d/%d|%7[^|]|",
               e->file, &e->verts, &e->faces, &e->triangles, &e->quads,
               &e->more, &e->creases, &e->corners, e->uvs) == 9;
}

static void
check_cage(const expected *e)
{
    otx_run *run = test_run_create_with(NULL, 1);
    int32_t sizes[3] = {0};
    bool uvs = true;
    char path[256];
    otx_obj obj;

    snprintf(path, sizeof path, SHARED_DATA "/cages/%s", e->file);
    assert_int_equal(otx_obj_read(run, path, &obj), OSDTEX_OK);
    check_invariants(&obj);
    for (int32_t f = 0; f < obj.face_count; ++f)
    {
        const int32_t size = obj.face_first[f + 1] - obj.face_first[f];

        ++sizes[size > 4 ? 2 : size - 3];
        uvs &= obj.face_uvs[obj.face_first[f]] >= 0;
    }
    assert_int_equal(obj.vert_count, e->verts);
    assert_int_equal(obj.face_count, e->faces);
    assert_int_equal(sizes[0], e->triangles);
    assert_int_equal(sizes[1], e->quads);
    assert_int_equal(sizes[2], e->more);
    assert_int_equal(obj.creases.count, e->creases);
    assert_int_equal(obj.corners.count, e->corners);
    assert_int_equal(uvs, strcmp(e->uvs, "yes") == 0);
    test_run_destroy(run);
}

static void
cages_have_the_counts_of_their_table(void **state)
{
    FILE *table = fopen(SHARED_DATA "/cages/SOURCES.md", "r");
    char row[1024];
    expected e;
    int checked = 0;

    (void)state;
    if (!table)
    {
        print_message("skipped: no " SHARED_DATA "/cages\n");
        skip();
    }
    while (fgets(row, sizeof row, table))
    {
        if (!parse_row(row, &e))
            continue;
        check_cage(&e);
        ++checked;
    }
    fclose(table);
    assert_int_equal(checked, 31);
}

static void
check_hostile(const char *name)
{
    otx_run *run = test_run_create_with(NULL, 1);
    char path[512];
    otx_obj obj;

    snprintf(path, sizeof path, SHARED_DATA "/hostile/%s", name);
    if (otx_obj_read(run, path, &obj) == OSDTEX_OK)
        check_invariants(&obj);
    else
    {
        const int32_t count = otx_diagnostics_count(run->diagnostics);
        int32_t errors = 0;

        for (int32_t i = 0; i < count; ++i)
        {
            osdtex_diagnostic d;

            otx_diagnostics_get(run->diagnostics, i, &d);
            errors += d.severity == OSDTEX_SEVERITY_ERROR;
        }
        assert_int_equal(errors, 1);
    }
    test_run_destroy(run);
}

/* All of it, whatever the extension: a picture is a possible cage, too. */
static void
hostile_files_parse_or_fail_with_one_sentence(void **state)
{
    DIR *folder = opendir(SHARED_DATA "/hostile");
    const struct dirent *entry;

    (void)state;
    if (!folder)
    {
        print_message("skipped: no " SHARED_DATA "/hostile\n");
        skip();
    }
    while ((entry = readdir(folder)))
        check_hostile(entry->d_name);
    closedir(folder);
}

static bool
cancel(void *user, const char *stage, double fraction)
{
    (void)stage;
    assert_true(fraction >= 0 && fraction <= 1);
    ++*(int *)user;
    return false;
}

static void
reading_can_be_cancelled(void **state)
{
    enum
    {
        LINES = 200000,
        BYTES = 8
    };
    otx_run *run = *state;
    char *bytes = OTX_NEW(run->arena, char, LINES *BYTES);
    int calls = 0;
    otx_obj obj;

    for (size_t i = 0; i < LINES; ++i)
        memcpy(bytes + BYTES * i, "v 1 2 3\n", BYTES);
    run->progress = cancel;
    run->progress_user = &calls;
    assert_int_equal(
        otx_obj_parse(run, "t.obj", bytes, LINES * BYTES, &obj),
        OSDTEX_ERROR_CANCELLED);
    assert_int_equal(calls, 1);
}

static void
memory_may_end_anywhere(void **state)
{
    enum
    {
        VERTS = 100000,
        BYTES = 14
    };
    char *bytes = malloc(VERTS * BYTES);
    otx_status status = OSDTEX_ERROR_MEMORY;

    (void)state;
    for (size_t i = 0; i < VERTS; ++i)
        memcpy(bytes + BYTES * i, "v 1 2 3 4 5 6\n", BYTES);
    for (int k = 0; status != OSDTEX_OK; ++k)
    {
        test_ration ration = {1000};
        const otx_allocator_hooks hooks = test_ration_hooks(&ration);
        otx_run *run = test_run_create_with(&hooks, 1);
        otx_obj obj;

        ration.left = k;
        status = otx_obj_parse(run, "t.obj", bytes, VERTS * BYTES, &obj);
        ration.left = 1000;
        assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
        assert_true(k < 100);
        test_run_destroy(run);
    }
    free(bytes);
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)
    const struct CMUnitTest tests[] = {
        TEST(everything_is_read),
        TEST(names_are_verbatim),
        TEST(names_occur_once_and_may_be_absent),
        TEST(tags_are_read),
        TEST(vertices_have_weights_or_colors),
        TEST(faces_may_refer_forward),
        TEST(ignored_kinds_are_counted_once),
        cmocka_unit_test(errors_name_the_line),
        cmocka_unit_test(any_prefix_parses_or_names_a_line),
        cmocka_unit_test(mutated_files_parse_or_fail),
        cmocka_unit_test(cages_have_the_counts_of_their_table),
        cmocka_unit_test(hostile_files_parse_or_fail_with_one_sentence),
        TEST(reading_can_be_cancelled),
        cmocka_unit_test(memory_may_end_anywhere)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

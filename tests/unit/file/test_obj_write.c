/* test_obj_write.c -- what is written reads back as the same. */
#include "folder.h"
#include "obj_support.h"

#include "base/random.h"
#include "file/obj_write.h"

#include <math.h>

static void
same_bytes(const void *a, const void *b, size_t size)
{
    assert_true((a == NULL) == (b == NULL));
    if (a && size > 0)
        assert_memory_equal(a, b, size);
}

static void
same_names(const otx_obj_names *a, const otx_obj_names *b)
{
    assert_int_equal(a->count, b->count);
    for (int32_t i = 0; i < a->count; ++i)
        assert_string_equal(a->text[i], b->text[i]);
}

static void
same_creases(const otx_obj_creases *a, const otx_obj_creases *b, size_t width)
{
    assert_int_equal(a->count, b->count);
    same_bytes(a->verts, b->verts, (size_t)a->count * width * 4);
    same_bytes(a->sharpness, b->sharpness, (size_t)a->count * 4);
}

static void
same_obj(const otx_obj *a, const otx_obj *b)
{
    const size_t faces = (size_t)a->face_count * 4;

    assert_int_equal(a->vert_count, b->vert_count);
    assert_int_equal(a->uv_count, b->uv_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->corner_count, b->corner_count);
    same_bytes(a->points, b->points, (size_t)a->vert_count * 12);
    same_bytes(a->colors, b->colors, (size_t)a->vert_count * 12);
    same_bytes(a->uvs, b->uvs, (size_t)a->uv_count * 8);
    same_bytes(a->face_first, b->face_first, faces + 4);
    same_bytes(a->face_verts, b->face_verts, (size_t)a->corner_count * 4);
    same_bytes(a->face_uvs, b->face_uvs, (size_t)a->corner_count * 4);
    same_bytes(a->face_group, b->face_group, faces);
    same_bytes(a->face_object, b->face_object, faces);
    same_bytes(a->face_material, b->face_material, faces);
    same_bytes(a->face_smooth, b->face_smooth, faces);
    same_names(&a->groups, &b->groups);
    same_names(&a->objects, &b->objects);
    same_names(&a->smooths, &b->smooths);
    same_names(&a->materials, &b->materials);
    same_names(&a->libraries, &b->libraries);
    same_creases(&a->creases, &b->creases, 2);
    same_creases(&a->corners, &b->corners, 1);
    assert_int_equal(a->hole_count, b->hole_count);
    same_bytes(a->hole_faces, b->hole_faces, (size_t)a->hole_count * 4);
    assert_int_equal(a->boundary.value, b->boundary.value);
    assert_int_equal(a->fvar.value, b->fvar.value);
    assert_int_equal(a->crease_method.value, b->crease_method.value);
    assert_int_equal(a->triangles.value, b->triangles.value);
}

static otx_obj
write_and_read(test_file *f, const otx_obj *obj)
{
    static const otx_obj_write_options options = {.tags = true};
    otx_obj back;

    otx_obj printed = *obj;

    printed.point_lines = NULL;
    assert_int_equal(
        otx_obj_write(f->run, &printed, f->path, &options), OSDTEX_OK);
    assert_int_equal(otx_obj_read(f->run, f->path, &back), OSDTEX_OK);
    return back;
}

static void
write_text(
    test_file *f, const otx_obj *obj, const otx_obj_write_options *options,
    char text[512])
{
    FILE *file;

    assert_int_equal(otx_obj_write(f->run, obj, f->path, options), OSDTEX_OK);
    file = fopen(f->path, "r");
    text[fread(text, 1, 511, file)] = '\0';
    fclose(file);
}

/* Lines of points as they were: numbers, blanks, colours, remarks. */
static void
lines_of_points_stay(void **state)
{
    test_file *f = *state;
    const otx_obj obj = test_obj_parse(
        f->run, "v 0 -0 +0\r\n# aside\n  v\t1e0  0 .10 \n"
                "v 0 1.000 0 0 1 0 # green\nv 2 \\\n3 4\nf 1 2 3\n");
    char text[512];

    write_text(f, &obj, NULL, text);
    assert_string_equal(
        text, "v 0 -0 +0\nv\t1e0  0 .10 \nv 0 1.000 0 0 1 0 # green\n"
              "v 2   3 4\nf 1 2 3\n");
}

static void
written_text_is_plain(void **state)
{
    static const char *const comments[] = {"made by a test", "in two\nlines"};
    static const otx_obj_write_options options = {
        .comments = comments, .comment_count = 2};
    test_file *f = *state;
    otx_obj obj = test_obj_parse(
        f->run, "mtllib a.mtl\nv 0 0 0\nv 1e0 0 .1\nv 0 1 0\nvt .5 .25\n"
                "f 1 2 3\ng a b\nusemtl my mat\nf 1/1 2/1 3/1\nf 1 3 2\n"
                "g\nf 2 1 3\nt crease 2/1/0 0 1 2\n");
    char text[512];

    obj.point_lines = NULL;
    write_text(f, &obj, &options, text);
    assert_string_equal(
        text, "# made by a test\n# in two_lines\nmtllib a.mtl\n"
              "v 0 0 0\nv 1 0 0.1\nv 0 1 0\nvt 0.5 0.25\n"
              "f 1 2 3\ng a b\nusemtl my_mat\nf 1/1 2/1 3/1\nf 1 3 2\n"
              "g\nf 2 1 3\n");
}

static void
everything_round_trips(void **state)
{
    test_file *f = *state;
    const otx_obj obj = test_obj_parse(
        f->run,
        "mtllib a b.mtl\nmtllib c.mtl\nv 0 0 0 1 0 .5\nv 1 0 0\nv 1 1 0\n"
        "v 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 1e-30 16777217\n"
        "f 1 2 3\no body\ng left side\nusemtl red\ns 1\nf 1/1 2/2 3/3 4/4\n"
        "s off\ng\nf 2 3 4\ng left side\nusemtl blue\nf 4/4 3/3 1/1\n"
        "t crease 4/2/0 0 1 2 3 1.5 10\nt corner 1/1/0 2 .1\nt hole 2/0/0 1 3\n"
        "t interpolateboundary 1/0/0 0\nt creasemethod 0/0/1 chaikin\n"
        "t facevaryinginterpolateboundary 1/0/0 4\n"
        "t smoothtriangles 0/0/1 smooth\n");
    const otx_obj back = write_and_read(f, &obj);

    same_obj(&obj, &back);
}

static void
any_float_round_trips(void **state)
{
    enum
    {
        VERTS = 20000
    };
    test_file *f = *state;
    float *points = OTX_NEW(f->run->arena, float, 3 * VERTS);
    static const int32_t first[1] = {0};
    otx_obj obj = {
        .path = "t.obj",
        .vert_count = VERTS,
        .points = points,
        .face_first = first,
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE};
    otx_obj back;

    for (uint64_t i = 0; i < 3 * VERTS; ++i)
    {
        const uint32_t bits = (uint32_t)otx_random_bits(3, 0, i);

        memcpy(&points[i], &bits, sizeof bits);
        if (!isfinite(points[i]))
            points[i] = 0;
    }
    back = write_and_read(f, &obj);
    assert_int_equal(back.vert_count, VERTS);
    assert_memory_equal(back.points, points, 3 * VERTS * sizeof *points);
}

static void
real_cages_round_trip(void **state)
{
    static const char *const names[] = {
        "catmark_car",       "catmark_cubes_semisharp", "catmark_hole_test2",
        "fancy_teapot_subd", "spot_control_mesh",       "loop_chaikin0"};
    test_file *f = *state;

    if (access(SHARED_DATA "/cages", R_OK) != 0)
    {
        print_message("skipped: no " SHARED_DATA "/cages\n");
        skip();
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    {
        char path[128];
        otx_obj obj, back;

        snprintf(path, sizeof path, SHARED_DATA "/cages/%s.obj", names[i]);
        assert_int_equal(otx_obj_read(f->run, path, &obj), OSDTEX_OK);
        back = write_and_read(f, &obj);
        same_obj(&obj, &back);
    }
}

static void
what_is_not_finite_is_not_written(void **state)
{
    test_file *f = *state;
    static const float points[] = {0, 0, 0, 0, NAN, 0};
    static const int32_t first[1] = {0};
    const otx_obj obj = {
        .vert_count = 2, .points = points, .face_first = first};

    assert_int_equal(
        otx_obj_write(f->run, &obj, f->path, NULL), OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(f->run), "vertex 1"));
}

static void
a_full_disk_is_told(void **state)
{
    test_file *f = *state;
    const otx_obj obj = test_obj_parse(f->run, "v 0 0 0\n");

    if (access("/dev/full", W_OK) != 0)
        test_skip("no /dev/full");
    assert_int_equal(
        otx_obj_write(f->run, &obj, "/dev/full", NULL), OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(f->run), "full"));
    assert_int_equal(
        otx_obj_write(f->run, &obj, "/nowhere/at/all.obj", NULL),
        OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(f->run), "No such file"));
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_file_setup, test_file_teardown)
    const struct CMUnitTest tests[] = {
        TEST(written_text_is_plain),  TEST(lines_of_points_stay),
        TEST(everything_round_trips), TEST(any_float_round_trips),
        TEST(real_cages_round_trip),  TEST(what_is_not_finite_is_not_written),
        TEST(a_full_disk_is_told)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

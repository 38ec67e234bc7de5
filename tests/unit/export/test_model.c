/* test_model.c -- what is written is what was mapped. */
#include "export/model.h"
#include "file/mtl.h"
#include "file/obj.h"
#include "file/picture_read.h"
#include "folder.h"
#include "support.h"

#include <stdlib.h>
#include <unistd.h>

enum
{
    /* A strip of four quads; vertex 10 belongs to none. */
    FACES = 4,
    VERTS = 11,
    CORNERS = 16
};

static const int32_t FIRST[] = {0, 4, 8, 12, 16};
static const int32_t FACE_VERTS[] = {
    0, 1, 3, 2, 2, 3, 5, 4, 4, 5, 7, 6, 6, 7, 9, 8};
static const int32_t FACE_CAGE[] = {0, 0, 1, 1};
static const char *const GROUPS[] = {"body", "left sleeve"};
static const char *const MATERIALS[] = {"red", "blue cloth"};

/* A mapping by hand: only what an export looks at. */
typedef struct fixture
{
    otx_run *run;
    char folder[64];
    otx_cage cage;
    otx_level leaf;
    otx_surface surface;
    otx_mapping mapping;
    otx_exemplar exemplar;
    float points[VERTS * 3];
    float uvs[CORNERS * 2];
    int32_t groups[2], materials[2];
    uint8_t holes[FACES];
    int32_t patches[FACES];
} fixture;

static void
set_up_exemplar(fixture *f)
{
    otx_exemplar *exemplar = &f->exemplar;

    otx_image_create(f->run, f->run->arena, 70, 50, 3, &exemplar->linear);
    for (int32_t i = 0; i < 70 * 50 * 3; ++i)
        exemplar->linear.pixels[i] = (float)(i * 37 % 1001) / 700.0f + 0.001f;
    exemplar->wrap_x = true;
    exemplar->linear_space = "ACEScg";
    exemplar->interop_id = "lin_ap1_scene";
    exemplar->has_chromaticities = true;
    memcpy(
        exemplar->chromaticities,
        (float[8]){
            0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f},
        sizeof exemplar->chromaticities);
}

static void
set_up(fixture *f)
{
    *f = (fixture){.run = test_run_create(), .groups = {0, 1}};
    strcpy(f->folder, "/tmp/osdtex-model-XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    for (int32_t i = 0; i < VERTS * 3; ++i)
        f->points[i] = (float)(i * i) / 7.0f - 3.0f;
    /* Patches of two faces: UVs agree inside, not across. */
    for (int32_t c = 0; c < CORNERS; ++c)
    {
        f->uvs[2 * c] = (float)(FACE_VERTS[c] % 2) + (c < 8 ? 0.0f : 0.3f);
        f->uvs[2 * c + 1] = (float)(FACE_VERTS[c] / 2) / 7.0f;
    }
    f->cage = (otx_cage){
        .face_count = 2,
        .group_count = 2,
        .group_names = GROUPS,
        .face_group = f->groups,
    };
    f->leaf = (otx_level){
        .face_count = FACES,
        .vert_count = VERTS,
        .corner_count = CORNERS,
        .face_first = FIRST,
        .face_verts = FACE_VERTS,
        .face_cage = FACE_CAGE,
        .face_hole = f->holes,
    };
    f->surface = (otx_surface){
        .cage = &f->cage,
        .level_count = 1,
        .levels = &f->leaf,
        .points = f->points,
    };
    f->mapping = (otx_mapping){
        .surface = &f->surface,
        .scale = 1.0,
        .uvs = f->uvs,
        .face_patch = f->patches,
        .patch_count = 1,
    };
    set_up_exemplar(f);
}

static const char *
path_in(fixture *f, const char *name)
{
    char *path = OTX_NEW(f->run->arena, char, 256);

    snprintf(path, 256, "%s/%s", f->folder, name);
    return path;
}

static bool
exists(fixture *f, const char *name)
{
    return access(path_in(f, name), F_OK) == 0;
}

static void
tear_down(fixture *f)
{
    static const char *const names[] = {
        "m.obj", "m.mtl", "m.exr", "m.png", "my m.obj", "my_m.mtl", "my_m.exr"};

    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        unlink(path_in(f, names[i]));
    /* Fails when anything else was left there. */
    assert_int_equal(rmdir(f->folder), 0);
    test_run_destroy(f->run);
}

static otx_model_files
write_model(fixture *f, const char *name)
{
    static const char *const comments[] = {"made by a test"};
    const otx_model_options options = {
        .path = path_in(f, name), .comments = comments, .comment_count = 1};
    otx_model_files files;

    assert_int_equal(
        otx_model_write(f->run, &f->mapping, &f->exemplar, &options, &files),
        OSDTEX_OK);
    return files;
}

static otx_obj
read_obj(fixture *f, const char *path)
{
    otx_obj obj;

    assert_int_equal(otx_obj_read(f->run, path, &obj), OSDTEX_OK);
    return obj;
}

static void
vertices_faces_and_uvs_come_back(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);

    const otx_model_files files = write_model(&f, "m.obj");
    const otx_obj obj = read_obj(&f, files.obj);

    assert_int_equal(obj.vert_count, VERTS);
    assert_memory_equal(obj.points, f.points, sizeof f.points);
    assert_int_equal(obj.face_count, FACES);
    assert_memory_equal(obj.face_first, FIRST, sizeof FIRST);
    assert_memory_equal(obj.face_verts, FACE_VERTS, sizeof FACE_VERTS);
    for (int32_t c = 0; c < CORNERS; ++c)
        assert_memory_equal(
            obj.uvs + 2 * obj.face_uvs[c], f.uvs + 2 * c, 2 * sizeof(float));
    /* Ten vertices, two of them on the seam. */
    assert_int_equal(obj.uv_count, 12);
    assert_int_equal(files.uv_count, 12);
    tear_down(&f);
}

static void
names_of_the_cage_are_carried(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);
    f.cage.material_count = 2;
    f.cage.material_names = MATERIALS;
    f.cage.face_material = f.materials;
    f.materials[0] = 1;
    f.materials[1] = -1;

    const otx_model_files files = write_model(&f, "m.obj");
    const otx_obj obj = read_obj(&f, files.obj);
    otx_mtl mtl;

    assert_int_equal(otx_mtl_read(f.run, files.mtl, &mtl), OSDTEX_OK);
    assert_int_equal(mtl.count, 3);
    for (int32_t i = 0; i < mtl.count; ++i)
        assert_string_equal(mtl.materials[i].map_kd, "m.exr");
    for (int32_t i = 0; i < FACES; ++i)
    {
        const char *material = obj.materials.text[obj.face_material[i]];

        assert_string_equal(
            obj.groups.text[obj.face_group[i]], GROUPS[FACE_CAGE[i]]);
        assert_string_equal(material, i < 2 ? "blue_cloth" : "m");
        assert_true(otx_mtl_find(&mtl, material) >= 0);
    }
    assert_int_equal(obj.libraries.count, 1);
    assert_string_equal(obj.libraries.text[0], "m.mtl");
    tear_down(&f);
}

static void
without_materials_there_is_one(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);

    const otx_model_files files = write_model(&f, "m.obj");
    const otx_obj obj = read_obj(&f, files.obj);

    assert_int_equal(obj.materials.count, 1);
    assert_string_equal(obj.materials.text[0], "m");
    assert_int_equal(obj.face_material[0], 0);
    tear_down(&f);
}

static void
holes_are_left_out(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);
    f.holes[1] = 1;

    const otx_model_files files = write_model(&f, "m.obj");
    const otx_obj obj = read_obj(&f, files.obj);

    assert_int_equal(obj.vert_count, VERTS);
    assert_int_equal(obj.face_count, 3);
    assert_memory_equal(
        obj.face_verts + 4, FACE_VERTS + 8, 8 * sizeof *FACE_VERTS);
    tear_down(&f);
}

/* The nearest half, ties to even; normal halves only. */
static float
round_to_half(float x)
{
    int exponent;

    if (x == 0.0f)
        return x;
    frexp(x, &exponent);
    return (float)ldexp(nearbyint(ldexp(x, 11 - exponent)), exponent - 11);
}

static void
the_texture_is_the_exemplar_in_halves(void **state)
{
    fixture f;
    otx_picture picture;

    (void)state;
    set_up(&f);

    const otx_model_files files = write_model(&f, "m.obj");

    assert_int_equal(otx_picture_read(f.run, files.exr, &picture), OSDTEX_OK);
    assert_int_equal(picture.image.width, 70);
    assert_int_equal(picture.image.height, 50);
    assert_int_equal(picture.image.channels, 3);
    assert_int_equal(picture.bits, 16);
    for (int32_t i = 0; i < 70 * 50 * 3; ++i)
        assert_true(
            picture.image.pixels[i] ==
            round_to_half(f.exemplar.linear.pixels[i]));
    assert_string_equal(picture.interop_id, "lin_ap1_scene");
    assert_string_equal(picture.oiio_space, "ACEScg");
    assert_true(picture.has_chromaticities);
    assert_memory_equal(
        picture.chromaticities, f.exemplar.chromaticities,
        sizeof picture.chromaticities);
    tear_down(&f);
}

/* A PNG is the same colours with the sRGB curve, dithered so that their mean
 * stays, and the MTL names it. */
static void
the_texture_is_a_png_for_the_web(void **state)
{
    fixture f;
    otx_picture picture;
    double sum = 0.0;

    (void)state;
    set_up(&f);
    f.exemplar.type = OTX_TEXTURE_PNG;

    const otx_model_files files = write_model(&f, "m.obj");

    assert_int_equal(otx_picture_read(f.run, files.exr, &picture), OSDTEX_OK);
    assert_int_equal(picture.kind, OTX_PICTURE_PNG);
    assert_true(picture.says_srgb);
    for (int32_t i = 0; i < 70 * 50 * 3; ++i)
    {
        const float value = fminf(f.exemplar.linear.pixels[i], 1.0f);
        const float expected = otx_embedding_encode(value);

        assert_true(fabsf(picture.image.pixels[i] - expected) <= 1.0f / 255.0f);
        sum += picture.image.pixels[i] - expected;
    }
    assert_true(fabs(sum / (70 * 50 * 3)) < 0.02 / 255.0);
    assert_non_null(strstr(test_read_text(f.run, files.mtl), "map_Kd m.png\n"));
    tear_down(&f);
}

static void
blanks_stay_in_the_obj_only(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);

    const otx_model_files files = write_model(&f, "my m.obj");
    const otx_obj obj = read_obj(&f, files.obj);

    assert_string_equal(obj.libraries.text[0], "my_m.mtl");
    assert_true(exists(&f, "my m.obj") && exists(&f, "my_m.mtl"));
    assert_true(exists(&f, "my_m.exr"));
    assert_true(otx_diagnostics_count(f.run->diagnostics) > 0);
    tear_down(&f);
}

static void
a_failure_leaves_nothing(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);
    f.uvs[5] = NAN;

    const otx_model_options options = {.path = path_in(&f, "m.obj")};
    otx_model_files files;

    assert_int_not_equal(
        otx_model_write(f.run, &f.mapping, &f.exemplar, &options, &files),
        OSDTEX_OK);
    assert_null(files.obj);
    assert_false(exists(&f, "m.obj") || exists(&f, "m.mtl"));
    assert_false(exists(&f, "m.exr"));
    tear_down(&f);
}

static void
a_set_of_the_caller_is_left_to_it(void **state)
{
    fixture f;
    otx_model_options options = {0};
    otx_model_files files;

    (void)state;
    set_up(&f);
    options.path = path_in(&f, "m.obj");
    options.without_image = true;
    assert_int_equal(
        otx_atomic_file_begin(f.run, f.run->arena, &options.set), OSDTEX_OK);
    assert_int_equal(
        otx_model_write(f.run, &f.mapping, &f.exemplar, &options, &files),
        OSDTEX_OK);
    assert_false(exists(&f, "m.obj"));
    assert_int_equal(
        otx_atomic_file_commit(f.run, options.set, false), OSDTEX_OK);
    assert_true(exists(&f, "m.obj") && exists(&f, "m.mtl"));
    assert_false(exists(&f, "m.exr"));
    assert_null(files.exr);
    tear_down(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_faces_and_uvs_come_back),
        cmocka_unit_test(names_of_the_cage_are_carried),
        cmocka_unit_test(without_materials_there_is_one),
        cmocka_unit_test(holes_are_left_out),
        cmocka_unit_test(the_texture_is_the_exemplar_in_halves),
        cmocka_unit_test(the_texture_is_a_png_for_the_web),
        cmocka_unit_test(blanks_stay_in_the_obj_only),
        cmocka_unit_test(a_failure_leaves_nothing),
        cmocka_unit_test(a_set_of_the_caller_is_left_to_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

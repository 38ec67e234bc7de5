/* test_paste_model.c -- a mapping of pastes as files. */
#include "export/paste_model.h"
#include "file/mtl.h"
#include "file/obj.h"
#include "file/picture_read.h"
#include "folder.h"
#include "strip_pastes.h"

typedef struct fixture
{
    otx_run *run;
    strip_pastes *s;
    test_folder folder;
} fixture;

static void
set_up(fixture *f)
{
    f->run = test_run_create();
    f->s = strip_pastes_create(f->run);
    f->folder = test_folder_create();
}

static void
tear_down(fixture *f)
{
    test_folder_remove(&f->folder);
    test_run_destroy(f->run);
}

static otx_status
write_it(fixture *f)
{
    const otx_model_options options = {
        .path = test_path(&f->folder, "a.obj"), .pastes = true};
    otx_model_files files;

    return otx_model_write(
        f->run, &f->s->mapping, &f->s->exemplar, &options, &files);
}

static void
layers_are_groups_in_their_order(void **state)
{
    fixture f;
    otx_obj obj;

    (void)state;
    set_up(&f);
    assert_int_equal(write_it(&f), OSDTEX_OK);
    assert_int_equal(
        otx_obj_read(f.run, test_path(&f.folder, "a.obj"), &obj), OSDTEX_OK);
    assert_int_equal(obj.face_count, 8);
    assert_int_equal(obj.vert_count, STRIP_VERTS);
    assert_int_equal(obj.groups.count, 3);
    for (int32_t i = 1; i < 8; ++i)
        assert_true(obj.face_group[i] >= obj.face_group[i - 1]);
    assert_string_equal(obj.groups.text[2], "layer_2");
    assert_string_equal(obj.materials.text[obj.face_material[0]], "a");
    assert_string_equal(obj.materials.text[obj.face_material[4]], "a_pastes");
    tear_down(&f);
}

static void
pieces_are_cut_out_by_their_alpha(void **state)
{
    fixture f;
    otx_mtl mtl;
    otx_picture picture;

    (void)state;
    set_up(&f);
    assert_int_equal(write_it(&f), OSDTEX_OK);
    assert_int_equal(
        otx_mtl_read(f.run, test_path(&f.folder, "a.mtl"), &mtl), OSDTEX_OK);
    assert_int_equal(mtl.count, 2);
    assert_null(mtl.materials[0].map_d);
    assert_string_equal(mtl.materials[0].map_kd, "a.exr");
    assert_string_equal(mtl.materials[1].map_d, "a_pastes.exr");
    assert_string_equal(mtl.materials[1].map_kd, "a_pastes.exr");
    assert_int_equal(
        otx_picture_read(f.run, test_path(&f.folder, "a_pastes.exr"), &picture),
        OSDTEX_OK);
    assert_int_equal(picture.image.channels, 4);
    tear_down(&f);
}

static int32_t
count(const char *text, const char *word)
{
    int32_t n = 0;

    for (const char *c = strstr(text, word); c; c = strstr(c + 1, word))
        ++n;
    return n;
}

static void
usd_has_a_subset_for_each_layer(void **state)
{
    fixture f;
    const char *text;

    (void)state;
    set_up(&f);
    assert_int_equal(write_it(&f), OSDTEX_OK);
    text = test_read_text(f.run, test_path(&f.folder, "a.usda"));
    assert_int_equal(count(text, "def GeomSubset"), 3);
    assert_int_equal(count(text, "inherits = </a/Look>"), 1);
    assert_int_equal(count(text, "inherits = </a/Overlay>"), 2);
    assert_int_equal(count(text, "inputs:opacity.connect"), 1);
    assert_int_equal(count(text, "@a_pastes.exr@"), 1);
    tear_down(&f);
}

static void
what_are_no_pastes_is_refused(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);
    f.s->mapping.lookups = NULL;
    assert_int_equal(write_it(&f), OSDTEX_ERROR_SUPPORT);
    tear_down(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_are_groups_in_their_order),
        cmocka_unit_test(pieces_are_cut_out_by_their_alpha),
        cmocka_unit_test(usd_has_a_subset_for_each_layer),
        cmocka_unit_test(what_are_no_pastes_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

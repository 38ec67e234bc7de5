/* test_exr_data.c -- layers that hold numbers, listed and read by name. */
#include "exr_support.h"

#include "file/exr_data.h"
#include "file/material_layers.h"

/* OpenImageIO names parts that have no name, and a part's name goes before its
 * layers. */

/* A material of colours, normals by X, Y, Z, a height that is one channel, and
 * a part of its own for roughness. */
static const char *
material(const fixture *f)
{
    make(
        f, "a.exr a.exr --mulc 0.5 --chnames normal.X,normal.Y,normal.Z "
           "--chappend a.exr --ch G --chnames height --chappend "
           "a.exr --ch B --chnames Y --attrib oiio:subimagename roughness "
           "--siappend -d float -o m.exr");
    return test_path(&f->folder, "m.exr");
}

static void
test_layers_are_listed(void **state)
{
    static const char *const wanted[] = {"height", "normal", "roughness"};
    const fixture *f = *state;
    otx_exr_data_list list;

    assert_int_equal(
        otx_exr_data_list_read(f->run, material(f), &list), OSDTEX_OK);
    assert_int_equal(list.count, 4);
    for (int32_t i = 0; i < 3; ++i)
    {
        int32_t k = 0;

        while (k < list.count && !strstr(list.names[k], wanted[i]))
            ++k;
        assert_int_not_equal(k, list.count);
    }
}

static void
test_numbers_are_read(void **state)
{
    const fixture *f = *state;
    const char *path = material(f);
    otx_picture picture;

    assert_int_equal(
        otx_picture_read_layer(f->run, path, "subimage00.normal", &picture),
        OSDTEX_OK);
    assert_int_equal(picture.image.channels, 3);
    assert_false(picture.is_gray);
    for (int32_t i = 0; i < 30; ++i)
        assert_float_equal(
            picture.image.pixels[i], 0.5f * f->image.pixels[i], 1e-6);
    assert_int_equal(
        otx_picture_read_layer(f->run, path, "subimage00.height", &picture),
        OSDTEX_OK);
    assert_true(picture.is_gray);
    assert_float_equal(picture.image.pixels[3], f->image.pixels[4], 0.0);
    assert_int_equal(
        otx_picture_read_layer(f->run, path, "depth", &picture),
        OSDTEX_ERROR_ARGUMENT);
}

static void
test_roles(void **state)
{
    const fixture *f = *state;
    const char *path = material(f);
    otx_material_files files, layers;

    assert_int_equal(
        otx_material_layers_find(f->run, path, &files, &layers), OSDTEX_OK);
    assert_string_equal(files.paths[OTX_MATERIAL_COLOR], path);
    assert_null(layers.paths[OTX_MATERIAL_COLOR]);
    assert_string_equal(layers.paths[OTX_MATERIAL_NORMAL], "subimage00.normal");
    assert_string_equal(layers.paths[OTX_MATERIAL_HEIGHT], "subimage00.height");
    assert_null(files.paths[OTX_MATERIAL_METALNESS]);
    assert_int_equal(
        otx_material_layers_find(
            f->run, test_path(&f->folder, "a.exr"), &files, &layers),
        OSDTEX_ERROR_FORMAT);
    assert_non_null(strstr(test_last_message(f->run), "no layer"));
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(test_layers_are_listed),
        TEST(test_numbers_are_read),
        TEST(test_roles),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

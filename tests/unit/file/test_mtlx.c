/* test_mtlx.c -- one image with its colour space, and well-formed text. */
#include "folder.h"

#include "file/mtlx.h"

static char *
written(otx_run *run, const otx_mtlx *mtlx)
{
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.mtlx");
    char *text;

    if (otx_mtlx_write(run, mtlx, path, NULL) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    text = test_read_text(run, path);
    test_folder_remove(&folder);
    return text;
}

static void
the_texture_and_its_space_are_named(void **state)
{
    otx_run *run = test_run_create();
    const otx_mtlx mtlx = {
        .name = "my shirt",
        .texture = "my_shirt.<UDIM>.exr",
        .interop_id = "lin_ap1_scene"};
    const char *text = written(run, &mtlx);

    (void)state;
    assert_non_null(strstr(
        text, "value=\"my_shirt.&lt;UDIM&gt;.exr\" colorspace=\"acescg\""));
    assert_non_null(
        strstr(text, "<standard_surface name=\"my_shirt_surface\""));
    assert_non_null(strstr(text, "nodename=\"my_shirt_image\""));
    assert_non_null(strstr(text, "nodename=\"my_shirt_surface\""));
    test_run_destroy(run);
}

static void
unknown_spaces_are_left_out(void **state)
{
    otx_run *run = test_run_create();
    const char *const ids[] = {NULL, "unknown", "lin_studio_scene"};

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        const otx_mtlx mtlx = {
            .name = "a", .texture = "a.exr", .interop_id = ids[i]};

        assert_null(strstr(written(run, &mtlx), "colorspace"));
    }
    test_run_destroy(run);
}

static void
file_names_are_escaped(void **state)
{
    otx_run *run = test_run_create();
    const otx_mtlx mtlx = {.name = "a", .texture = "a&\"b\".exr"};

    (void)state;
    assert_non_null(
        strstr(written(run, &mtlx), "value=\"a&amp;&quot;b&quot;.exr\""));
    test_run_destroy(run);
}

static void
maps_are_data(void **state)
{
    otx_run *run = test_run_create();
    const otx_mtlx mtlx = {
        .name = "a",
        .texture = "a.exr",
        .interop_id = "lin_ap1_scene",
        .maps = {
            .normal = "n.exr",
            .roughness = "r.exr",
            .metalness = "m.exr",
            .height = "h.exr"}};
    const char *text = written(run, &mtlx);

    (void)state;
    assert_non_null(strstr(text, "value=\"n.exr\" />"));
    assert_non_null(strstr(text, "<normalmap name=\"a_bent\""));
    assert_non_null(strstr(text, "nodename=\"a_roughness\""));
    assert_non_null(strstr(text, "nodename=\"a_metalness\""));
    assert_non_null(strstr(text, "<displacement name=\"a_displacement\""));
    assert_non_null(strstr(text, "nodename=\"a_displacement\""));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_texture_and_its_space_are_named),
        cmocka_unit_test(unknown_spaces_are_left_out),
        cmocka_unit_test(file_names_are_escaped),
        cmocka_unit_test(maps_are_data),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

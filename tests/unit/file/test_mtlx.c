/* test_mtlx.c -- one image with its colour space, and well-formed text. */
#include "support.h"

#include "file/mtlx.h"

#include <stdlib.h>
#include <unistd.h>

static char *
written(otx_run *run, const otx_mtlx *mtlx)
{
    char path[] = "/tmp/osdtex_mtlx_XXXXXX";
    const int fd = mkstemp(path);
    char *text = OTX_ZNEW(run->arena, char, 1 << 12);
    FILE *file;

    assert_true(fd >= 0);
    close(fd);
    if (otx_mtlx_write(run, mtlx, path, NULL) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    file = fopen(path, "rb");
    assert_true(fread(text, 1, (1 << 12) - 1, file) > 0);
    fclose(file);
    unlink(path);
    return text;
}

static void
the_texture_and_its_space_are_named(void **state)
{
    otx_run *run = test_run_create();
    const otx_mtlx mtlx = {"my shirt", "my_shirt.<UDIM>.exr", "lin_ap1_scene"};
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
        const otx_mtlx mtlx = {"a", "a.exr", ids[i]};

        assert_null(strstr(written(run, &mtlx), "colorspace"));
    }
    test_run_destroy(run);
}

static void
file_names_are_escaped(void **state)
{
    otx_run *run = test_run_create();
    const otx_mtlx mtlx = {"a", "a&\"b\".exr", NULL};

    (void)state;
    assert_non_null(
        strstr(written(run, &mtlx), "value=\"a&amp;&quot;b&quot;.exr\""));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_texture_and_its_space_are_named),
        cmocka_unit_test(unknown_spaces_are_left_out),
        cmocka_unit_test(file_names_are_escaped),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_png_file.c -- PNG files: round trips, other programs' files, refusals.
 */
#include "picture_support.h"

static void
test_rounded_values_come_back(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.png");

    (void)state;
    for (int i = 0; i < 4; ++i)
    {
        const int32_t bits = i & 1 ? 16 : 8;
        const double scale = i & 1 ? 65535.0 : 255.0;
        otx_image image = test_noise(run, 37, 23, i & 2 ? 4 : 3);
        otx_picture picture;

        assert_int_equal(test_write_png(run, path, &image, bits), OSDTEX_OK);
        picture = test_read(run, path);
        for (int32_t k = 0; k < 37 * 23 * image.channels; ++k)
            image.pixels[k] =
                (float)(floor(image.pixels[k] * scale + 0.5) / scale);
        test_same_image(&picture.image, &image, 0.0);
        assert_int_equal(picture.kind, OTX_PICTURE_PNG);
        assert_int_equal(picture.bits, bits);
        assert_int_equal(picture.has_alpha, image.channels == 4);
        assert_true(picture.says_srgb);
        assert_false(picture.is_float);
        assert_false(picture.alpha_is_premultiplied);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_values_out_of_range_are_clamped(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.png");
    otx_image image = test_noise(run, 1, 1, 3);
    otx_picture picture;

    (void)state;
    image.pixels[0] = -3.0f;
    image.pixels[1] = 1e20f;
    assert_int_equal(test_write_png(run, path, &image, 8), OSDTEX_OK);
    picture = test_read(run, path);
    assert_float_equal(picture.image.pixels[0], 0.0, 0.0);
    assert_float_equal(picture.image.pixels[1], 1.0, 0.0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_bad_input_leaves_no_file(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.png");
    otx_image image = test_noise(run, 3, 3, 3);
    const otx_image gray = test_noise(run, 3, 3, 1);

    (void)state;
    assert_int_equal(
        test_write_png(run, path, &gray, 8), OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        test_write_png(run, path, &image, 12), OSDTEX_ERROR_ARGUMENT);
    image.pixels[4] = NAN;
    assert_int_equal(
        test_write_png(run, path, &image, 8), OSDTEX_ERROR_NUMERIC);
    assert_int_equal(rmdir(folder.path), 0);
    test_run_destroy(run);
}

static void
test_full_disk_is_an_error(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = test_noise(run, 300, 300, 3);
    otx_picture picture;

    (void)state;
    assert_int_not_equal(
        test_write_png(run, "/dev/full", &image, 8), OSDTEX_OK);
    assert_int_equal(
        otx_picture_read(run, "/dev/full", &picture), OSDTEX_ERROR_FORMAT);
    test_run_destroy(run);
}

static void
test_same_input_gives_same_bytes(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 50, 40, 3);
    size_t a_bytes, b_bytes;
    const uint8_t *a, *b;

    (void)state;
    assert_int_equal(
        test_write_png(run, test_path(&folder, "a.png"), &image, 8), OSDTEX_OK);
    assert_int_equal(
        test_write_png(run, test_path(&folder, "b.png"), &image, 8), OSDTEX_OK);
    a = test_read_bytes(run, test_path(&folder, "a.png"), &a_bytes);
    b = test_read_bytes(run, test_path(&folder, "b.png"), &b_bytes);
    assert_int_equal(a_bytes, b_bytes);
    assert_memory_equal(a, b, a_bytes);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_cut_files_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 9, 8, 3);
    const char *path = test_path(&folder, "a.png");

    (void)state;
    assert_int_equal(test_write_png(run, path, &image, 8), OSDTEX_OK);
    test_prefixes_fail(run, &folder, path, 0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* Values of a file as oiiotool sees them, through an EXR of floats. */
static void
compare_with_oiio(otx_run *run, const test_folder *folder, const char *path)
{
    char command[TEST_PATH_BYTES + 128];
    char here[TEST_PATH_BYTES];
    otx_picture ours, theirs;

    assert_non_null(realpath(path, here));
    ours = test_read(run, path);
    snprintf(
        command, sizeof command,
        "oiiotool --no-autopremult %s%s -d float -o theirs.exr", here,
        ours.is_gray && !ours.has_alpha ? " --ch 0,0,0 --chnames R,G,B" : "");
    assert_int_equal(test_shell(folder, command), 0);
    theirs = test_read(run, test_path(folder, "theirs.exr"));
    test_same_image(&ours.image, &theirs.image, 1e-6);
}

static void
test_other_programs_files_are_read_alike(void **state)
{
    static const char *const names[] = {
        "hostile/pngsuite_valid_basi6a08.png",
        "hostile/pngsuite_valid_basn6a16.png",
        "hostile/pngsuite_valid_s01n3p01.png",
        "hostile/pngsuite_valid_tbrn2c08.png",
        "textures/brick_gray_512.png",
        "textures/cobbles_666.png",
        "textures/grid_test.png",
        "textures/text_333.png",
        "textures/weave_640.png"};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();

    (void)state;
    if (access(SHARED_DATA "/textures", R_OK) != 0 ||
        !test_has_tool("oiiotool"))
    {
        print_message("skipped: " SHARED_DATA " or oiiotool is absent\n");
        rmdir(folder.path);
        test_run_destroy(run);
        skip();
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    {
        char path[TEST_PATH_BYTES];

        snprintf(path, sizeof path, SHARED_DATA "/%s", names[i]);
        compare_with_oiio(run, &folder, path);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rounded_values_come_back),
        cmocka_unit_test(test_values_out_of_range_are_clamped),
        cmocka_unit_test(test_bad_input_leaves_no_file),
        cmocka_unit_test(test_full_disk_is_an_error),
        cmocka_unit_test(test_same_input_gives_same_bytes),
        cmocka_unit_test(test_cut_files_are_refused),
        cmocka_unit_test(test_other_programs_files_are_read_alike),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

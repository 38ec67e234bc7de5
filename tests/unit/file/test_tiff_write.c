/* test_tiff_write.c -- TIFF files: round trips, marks, refusals. */
#include "picture_support.h"

#include "file/mark.h"
#include "file/tiff_write.h"

static otx_status
write_tiff(otx_run *run, const char *path, const otx_image *image, int32_t bits)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_atomic_file_set *set;
    otx_status status = otx_atomic_file_begin(run, run->scratch, &set);

    if (status == OSDTEX_OK)
        status = otx_tiff_write(run, set, path, image, bits);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* What a channel of grey is read as. */
static otx_image
spread(otx_run *run, const otx_image *grey)
{
    otx_image out = test_noise(run, grey->width, grey->height, 3);

    for (int32_t i = 0; i < grey->width * grey->height; ++i)
        for (int32_t c = 0; c < 3; ++c)
            out.pixels[3 * i + c] = grey->pixels[i];
    return out;
}

static void
test_values_come_back(void **state)
{
    static const int32_t channels[] = {1, 3, 4}, depths[] = {8, 16, 32};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");

    (void)state;
    for (int i = 0; i < 9; ++i)
    {
        const int32_t bits = depths[i / 3];
        const double most = bits == 8 ? 255.0 : 65535.0;
        /* Several strips, the last one short. */
        otx_image image = test_noise(run, 301, 523, channels[i % 3]);
        otx_picture picture;

        assert_int_equal(write_tiff(run, path, &image, bits), OSDTEX_OK);
        picture = test_read(run, path);
        for (int32_t k = 0; bits < 32 && k < 301 * 523 * image.channels; ++k)
            image.pixels[k] =
                (float)(floor(image.pixels[k] * most + 0.5) / most);
        if (image.channels == 1)
            image = spread(run, &image);
        test_same_image(&picture.image, &image, 0.0);
        assert_int_equal(picture.kind, OTX_PICTURE_TIFF);
        assert_int_equal(picture.bits, bits);
        assert_int_equal(picture.is_float, bits == 32);
        assert_int_equal(picture.has_alpha, image.channels == 4);
        assert_false(picture.alpha_is_premultiplied);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_floats_are_not_clamped(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");
    otx_image image = test_noise(run, 2, 1, 1);
    otx_picture picture;

    (void)state;
    image.pixels[0] = -3.0f;
    image.pixels[1] = 1e20f;
    assert_int_equal(write_tiff(run, path, &image, 32), OSDTEX_OK);
    picture = test_read(run, path);
    assert_float_equal(picture.image.pixels[0], -3.0, 0.0);
    assert_float_equal(picture.image.pixels[3], 1e20f, 0.0);
    assert_int_equal(write_tiff(run, path, &image, 16), OSDTEX_OK);
    picture = test_read(run, path);
    assert_float_equal(picture.image.pixels[0], 0.0, 0.0);
    assert_float_equal(picture.image.pixels[3], 1.0, 0.0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* The mark stands at the head of a file that is larger than what is looked
 * through for it, and a changed byte breaks its seal. */
static void
test_the_mark_is_found_and_sealed(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");
    const otx_image image = test_noise(run, 512, 512, 3);
    otx_mark mark = {.job = "0123456789abcdef0123456789abcdef"};
    otx_mark_found found;
    uint8_t *bytes;
    size_t size;

    (void)state;
    run->mark = &mark;
    assert_int_equal(write_tiff(run, path, &image, 16), OSDTEX_OK);
    assert_int_equal(otx_mark_seal(path), 0);
    assert_true(otx_mark_read(path, true, &found));
    assert_string_equal(found.mark.job, mark.job);
    assert_true(found.is_whole);
    test_read(run, path);
    bytes = test_read_bytes(run, path, &size);
    assert_true(size > (1u << 19));
    bytes[size / 2] ^= 1;
    test_write_bytes(path, bytes, size);
    assert_true(otx_mark_read(path, true, &found));
    assert_false(found.is_whole);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_bad_input_leaves_no_file(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");
    otx_image image = test_noise(run, 4, 4, 3);

    (void)state;
    assert_int_equal(write_tiff(run, path, &image, 12), OSDTEX_ERROR_ARGUMENT);
    image.pixels[5] = NAN;
    assert_int_equal(write_tiff(run, path, &image, 16), OSDTEX_ERROR_NUMERIC);
    assert_int_equal(access(path, F_OK), -1);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* libtiff's own program finds nothing to complain of. */
static void
test_tiffinfo_takes_it(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 64, 48, 4);

    (void)state;
    if (!test_has_tool("tiffinfo"))
        test_skip("no tiffinfo");
    assert_int_equal(
        write_tiff(run, test_path(&folder, "a.tif"), &image, 16), OSDTEX_OK);
    assert_int_equal(
        test_shell(&folder, "tiffinfo -D a.tif 2>err.txt; test ! -s err.txt"),
        0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_come_back),
        cmocka_unit_test(test_floats_are_not_clamped),
        cmocka_unit_test(test_the_mark_is_found_and_sealed),
        cmocka_unit_test(test_bad_input_leaves_no_file),
        cmocka_unit_test(test_tiffinfo_takes_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

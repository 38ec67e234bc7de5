/* test_jpeg_write.c -- JPEG files: what comes back, marks, refusals. */
#include "picture_support.h"

#include "file/jpeg_write.h"
#include "file/mark.h"

static otx_status
write_jpeg(otx_run *run, const char *path, const otx_image *image)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_atomic_file_set *set;
    otx_status status = otx_atomic_file_begin(run, run->scratch, &set);

    if (status == OSDTEX_OK)
        status = otx_jpeg_write(run, set, path, image);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* A ramp of colours, which JPEG bears well; the first row is the lowest. */
static otx_image
ramp(otx_run *run, int32_t channels)
{
    otx_image image = test_noise(run, 67, 41, channels);

    for (int32_t y = 0; y < image.height; ++y)
        for (int32_t x = 0; x < image.width; ++x)
        {
            float *p = otx_image_at(&image, x, y);

            p[0] = (float)x / 66.0f;
            p[1] = (float)y / 40.0f;
            p[2] = 0.5f;
        }
    return image;
}

static void
test_colours_come_back(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");
    const otx_image image = ramp(run, 3);
    const otx_image with_alpha = ramp(run, 4);
    otx_picture picture;

    (void)state;
    assert_int_equal(write_jpeg(run, path, &image), OSDTEX_OK);
    picture = test_read(run, path);
    assert_int_equal(picture.kind, OTX_PICTURE_JPEG);
    test_same_image(&picture.image, &image, 6.0 / 255.0);
    assert_int_equal(write_jpeg(run, path, &with_alpha), OSDTEX_OK);
    picture = test_read(run, path);
    test_same_image(&picture.image, &image, 6.0 / 255.0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_the_mark_is_found_and_sealed(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");
    const otx_image image = test_noise(run, 64, 64, 3);
    otx_mark mark = {.job = "0123456789abcdef0123456789abcdef"};
    otx_mark_found found;

    (void)state;
    run->mark = &mark;
    assert_int_equal(write_jpeg(run, path, &image), OSDTEX_OK);
    assert_int_equal(otx_mark_seal(path), 0);
    assert_true(otx_mark_read(path, true, &found));
    assert_string_equal(found.mark.job, mark.job);
    assert_true(found.is_whole);
    test_read(run, path);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_bad_input_leaves_no_file(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");
    const otx_image grey = test_noise(run, 4, 4, 1);
    otx_image image = test_noise(run, 4, 4, 3);

    (void)state;
    assert_int_equal(write_jpeg(run, path, &grey), OSDTEX_ERROR_ARGUMENT);
    image.pixels[5] = NAN;
    assert_int_equal(write_jpeg(run, path, &image), OSDTEX_ERROR_NUMERIC);
    assert_int_equal(access(path, F_OK), -1);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_colours_come_back),
        cmocka_unit_test(test_the_mark_is_found_and_sealed),
        cmocka_unit_test(test_bad_input_leaves_no_file),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

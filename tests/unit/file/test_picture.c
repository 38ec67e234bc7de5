/* test_picture.c -- recognising files, and what damaged and strange ones do.
 */
#include "picture_support.h"

#include <time.h>

static void
test_files_that_are_no_pictures(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    otx_picture picture;

    (void)state;
    test_write_bytes(
        test_path(&folder, "a.exr"), (const uint8_t *)"v 0 0 0\n", 8);
    test_write_bytes(test_path(&folder, "empty.png"), (const uint8_t *)"", 0);
    assert_int_equal(
        otx_picture_read(run, test_path(&folder, "a.exr"), &picture),
        OSDTEX_ERROR_FORMAT);
    assert_int_equal(
        otx_picture_read(run, test_path(&folder, "empty.png"), &picture),
        OSDTEX_ERROR_FORMAT);
    assert_int_equal(
        otx_picture_read(run, test_path(&folder, "absent.png"), &picture),
        OSDTEX_ERROR_IO);
    assert_int_equal(
        otx_picture_read(run, folder.path, &picture), OSDTEX_ERROR_IO);
    assert_null(picture.image.pixels);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_content_decides_not_the_name(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");
    const otx_image image = test_noise(run, 4, 3, 3);

    (void)state;
    assert_int_equal(test_write_png(run, path, &image, 8), OSDTEX_OK);
    assert_int_equal(test_read(run, path).kind, OTX_PICTURE_PNG);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* Whatever allocation fails, the status says so and nothing leaks. */
static void
test_memory_limit_is_an_error(void **state)
{
    const test_folder folder = test_folder_create();
    otx_run *writer = test_run_create();
    const otx_image image = test_noise(writer, 300, 300, 3);
    const otx_exr_options options = otx_exr_options_default();

    (void)state;
    assert_int_equal(
        test_write_png(writer, test_path(&folder, "a.png"), &image, 8),
        OSDTEX_OK);
    assert_int_equal(
        test_write_exr(writer, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    for (size_t limit = 1u << 19; limit < 1u << 22; limit += 1u << 18)
    {
        const otx_allocator_hooks hooks = {.limit_bytes = limit};
        otx_run *run = test_run_create_with(&hooks, 1);
        otx_picture picture;
        const otx_status png =
            otx_picture_read(run, test_path(&folder, "a.png"), &picture);
        const otx_status exr =
            otx_picture_read(run, test_path(&folder, "a.exr"), &picture);

        assert_true(png == OSDTEX_OK || png == OSDTEX_ERROR_MEMORY);
        assert_true(exr == OSDTEX_OK || exr == OSDTEX_ERROR_MEMORY);
        assert_true(limit >= 1u << 20 || png == OSDTEX_ERROR_MEMORY);
        test_run_destroy(run);
    }
    test_run_destroy(writer);
    test_folder_remove(&folder);
}

static bool
is_picture_name(const char *name)
{
    const char *dot = strrchr(name, '.');

    return dot && (strcmp(dot, ".exr") == 0 || strcmp(dot, ".png") == 0 ||
                   strcmp(dot, ".jpg") == 0);
}

static double
seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool
all_finite(const otx_image *image)
{
    const int32_t count = image->width * image->height * image->channels;

    for (int32_t i = 0; i < count; ++i)
        if (!isfinite(image->pixels[i]))
            return false;
    return true;
}

/* Reads a file that may be anything: quickly, in bounded memory, and with a
 * sentence when it fails. */
static void
survive(const char *path)
{
    otx_run *run = test_run_create();
    const double start = seconds();
    otx_picture picture;
    const otx_status status = otx_picture_read(run, path, &picture);

    assert_true(seconds() - start < 10.0);
    assert_true(otx_allocator_peak(run->allocator) < (size_t)2 << 30);
    if (status == OSDTEX_OK)
        assert_true(all_finite(&picture.image));
    else
    {
        assert_true(status < 0);
        assert_true(strlen(test_last_message(run)) > 20);
        assert_null(picture.image.pixels);
    }
    test_run_destroy(run);
}

/* Sends stderr to a file; returns what to give back to `restore_stderr`. */
static int
divert_stderr(const test_folder *folder)
{
    const int kept = dup(STDERR_FILENO);

    fflush(stderr);
    assert_non_null(freopen(test_path(folder, "stderr"), "w", stderr));
    return kept;
}

static void
restore_stderr(int kept)
{
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
}

static void
test_hostile_files_do_no_harm(void **state)
{
    const test_folder folder = test_folder_create();
    DIR *dir = opendir(SHARED_DATA "/hostile");
    struct stat printed;
    int kept, count = 0;

    (void)state;
    if (!dir)
    {
        print_message("skipped: " SHARED_DATA " is absent\n");
        rmdir(folder.path);
        skip();
    }
    kept = divert_stderr(&folder);
    for (struct dirent *e; (e = readdir(dir));)
    {
        char path[TEST_PATH_BYTES];

        if (!is_picture_name(e->d_name))
            continue;
        snprintf(path, sizeof path, SHARED_DATA "/hostile/%s", e->d_name);
        survive(path);
        ++count;
    }
    closedir(dir);
    restore_stderr(kept);
    assert_int_equal(stat(test_path(&folder, "stderr"), &printed), 0);
    assert_int_equal(printed.st_size, 0);
    assert_true(count > 90);
    test_folder_remove(&folder);
}

static void
test_bombs_are_refused_at_once(void **state)
{
    const char *path = SHARED_DATA "/hostile/oiio_bomb-65500x65500.jpg";
    otx_run *run = test_run_create();
    otx_picture picture;

    (void)state;
    if (access(path, R_OK) == 0)
    {
        assert_int_equal(
            otx_picture_read(run, path, &picture), OSDTEX_ERROR_LIMIT);
        assert_true(otx_allocator_peak(run->allocator) < 10u << 20);
    }
    test_run_destroy(run);
}

static void
test_photographs_are_read(void **state)
{
    DIR *dir = opendir(SHARED_DATA "/textures");
    int count = 0;

    (void)state;
    if (!dir)
    {
        print_message("skipped: " SHARED_DATA " is absent\n");
        skip();
    }
    for (struct dirent *e; (e = readdir(dir));)
    {
        char path[TEST_PATH_BYTES];
        otx_run *run;

        if (!is_picture_name(e->d_name) || strstr(e->d_name, "NanInf"))
            continue;
        run = test_run_create();
        snprintf(path, sizeof path, SHARED_DATA "/textures/%s", e->d_name);
        test_read(run, path);
        ++count;
        test_run_destroy(run);
    }
    closedir(dir);
    assert_true(count >= 20);
}

/* Flips of single bytes, in files of every format: no crash, no print, and
 * either a picture or a sentence. */
static void
test_damaged_files_do_no_harm(void **state)
{
    static const char *const names[] = {"a.png", "a.exr", "b.exr"};
    const test_folder folder = test_folder_create();
    otx_run *run = test_run_create();
    const otx_image image = test_noise(run, 24, 17, 4);
    otx_exr_options options = otx_exr_options_default();

    (void)state;
    assert_int_equal(
        test_write_png(run, test_path(&folder, "a.png"), &image, 16),
        OSDTEX_OK);
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    options.tiled = false;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "b.exr"), &image, &options),
        OSDTEX_OK);
    for (int f = 0; f < 3; ++f)
    {
        size_t bytes;
        uint8_t *data =
            test_read_bytes(run, test_path(&folder, names[f]), &bytes);

        for (uint64_t i = 0; i < 300; ++i)
        {
            /* Half of the flips in the header. */
            const size_t range = i % 2 && bytes > 400 ? 400 : bytes;
            const size_t at = otx_random_bits(3, (uint32_t)f, i) % range;
            const uint8_t kept = data[at];

            data[at] = (uint8_t)otx_random_bits(4, (uint32_t)f, i);
            test_write_bytes(test_path(&folder, "cut"), data, bytes);
            survive(test_path(&folder, "cut"));
            data[at] = kept;
        }
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files_that_are_no_pictures),
        cmocka_unit_test(test_content_decides_not_the_name),
        cmocka_unit_test(test_memory_limit_is_an_error),
        cmocka_unit_test(test_hostile_files_do_no_harm),
        cmocka_unit_test(test_bombs_are_refused_at_once),
        cmocka_unit_test(test_photographs_are_read),
        cmocka_unit_test(test_damaged_files_do_no_harm),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* picture_support.h -- oracles and comparisons for the tests of picture files.
 */
#ifndef OTX_TESTS_PICTURE_SUPPORT_H
#define OTX_TESTS_PICTURE_SUPPORT_H

#include "folder.h"

#include "base/random.h"
#include "file/exr.h"
#include "file/picture_read.h"
#include "file/png_file.h"

/* Runs a program that is only an oracle. False when it is not installed. */
static inline bool
test_has_tool(const char *name)
{
    char command[256];

    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", name);
    return system(command) == 0;
}

/* Runs a shell command in the folder; 0 when it succeeded. */
static inline int
test_shell(const test_folder *folder, const char *command)
{
    char line[2 * TEST_PATH_BYTES];

    snprintf(
        line, sizeof line, "cd %s && { %s; } >log.txt 2>&1", folder->path,
        command);
    return system(line);
}

/* Uniform noise in [0, 1). */
static inline otx_image
test_noise(otx_run *run, int32_t width, int32_t height, int32_t channels)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, channels, &image),
        OSDTEX_OK);
    for (int32_t i = 0; i < width * height * channels; ++i)
        image.pixels[i] = (float)otx_random_unit(7, 1, (uint64_t)i);
    return image;
}

static inline otx_picture
test_read(otx_run *run, const char *path)
{
    otx_picture picture;
    const otx_status status = otx_picture_read(run, path, &picture);

    if (status != OSDTEX_OK)
        print_error("%s: %s\n", path, test_last_message(run));
    assert_int_equal(status, OSDTEX_OK);
    return picture;
}

/* Writes and commits one picture. */
static inline otx_status
test_write_exr(
    otx_run *run, const char *path, const otx_image *image,
    const otx_exr_options *options)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_atomic_file_set *set;
    otx_status status = otx_atomic_file_begin(run, run->scratch, &set);

    if (status == OSDTEX_OK)
        status = otx_exr_write(run, set, path, image, options);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    otx_arena_release(run->scratch, mark);
    return status;
}

static inline otx_status
test_write_png(
    otx_run *run, const char *path, const otx_image *image, int32_t bits)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_atomic_file_set *set;
    otx_status status = otx_atomic_file_begin(run, run->scratch, &set);

    if (status == OSDTEX_OK)
        status = otx_png_file_write(run, set, path, image, bits);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* Fails unless sizes agree and no value differs by more than `tolerance`. */
static inline void
test_same_image(const otx_image *a, const otx_image *b, double tolerance)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    for (int32_t i = 0; i < a->width * a->height * a->channels; ++i)
        if (!(fabs((double)a->pixels[i] - b->pixels[i]) <= tolerance))
        {
            const int32_t texel = i / a->channels;

            print_error(
                "texel (%d, %d) channel %d: %.9g and %.9g\n", texel % a->width,
                texel / a->width, i % a->channels, (double)a->pixels[i],
                (double)b->pixels[i]);
            fail();
        }
}

/* Every proper prefix of a file is refused, and leaves nothing behind. The
 * last `spare` bytes may be missing (padding). */
static inline void
test_prefixes_fail(
    otx_run *run, const test_folder *folder, const char *path, size_t spare)
{
    size_t bytes;
    const uint8_t *data = test_read_bytes(run, path, &bytes);
    char cut[TEST_PATH_BYTES];

    snprintf(cut, sizeof cut, "%s/cut", folder->path);
    for (size_t n = 0; n + spare < bytes; ++n)
    {
        const size_t used = otx_allocator_used(run->allocator);
        otx_picture picture;
        otx_status status;

        test_write_bytes(cut, data, n);
        status = otx_picture_read(run, cut, &picture);
        if (status >= 0)
            print_error("a prefix of %zu of %zu bytes is read\n", n, bytes);
        assert_true(status < 0);
        assert_null(picture.image.pixels);
        /* Findings may grow by the first of their kind. */
        assert_true(otx_allocator_used(run->allocator) < used + (1u << 20));
    }
}

#endif

/* picture_support.h -- temporary folders, oracles and comparisons for the
 * tests of picture files. */
#ifndef OTX_TESTS_PICTURE_SUPPORT_H
#define OTX_TESTS_PICTURE_SUPPORT_H

#include "support.h"

#include "base/random.h"
#include "file/exr.h"
#include "file/picture.h"
#include "file/png_file.h"

#include <dirent.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    TEST_PATH_BYTES = 4096
};

/* A folder of its own for a test, removed with all it holds. */
typedef struct test_folder
{
    char path[64];
} test_folder;

static inline test_folder
test_folder_create(void)
{
    test_folder folder = {"/tmp/osdtex-test-XXXXXX"};

    assert_non_null(mkdtemp(folder.path));
    return folder;
}

static inline void
test_folder_remove(const test_folder *folder)
{
    DIR *dir = opendir(folder->path);
    char path[TEST_PATH_BYTES];

    for (struct dirent *e; dir && (e = readdir(dir));)
    {
        snprintf(path, sizeof path, "%s/%s", folder->path, e->d_name);
        unlink(path);
    }
    if (dir)
        closedir(dir);
    rmdir(folder->path);
}

/* A path in the folder; valid until the next but three calls. */
static inline const char *
test_path(const test_folder *folder, const char *name)
{
    static char paths[4][TEST_PATH_BYTES];
    static int next = 0;
    char *path = paths[next++ % 4];

    snprintf(path, TEST_PATH_BYTES, "%s/%s", folder->path, name);
    return path;
}

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

/* All bytes of a file, in run->arena. */
static inline uint8_t *
test_read_bytes(otx_run *run, const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data;

    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *bytes = (size_t)ftell(file);
    rewind(file);
    data = OTX_NEW(run->arena, uint8_t, *bytes + 1);
    assert_int_equal(fread(data, 1, *bytes, file), *bytes);
    fclose(file);
    data[*bytes] = '\0';
    return data;
}

static inline void
test_write_bytes(const char *path, const uint8_t *data, size_t bytes)
{
    FILE *file = fopen(path, "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, bytes, file), bytes);
    assert_int_equal(fclose(file), 0);
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
        const size_t used = otx_heap_used(run->heap);
        otx_picture picture;
        otx_status status;

        test_write_bytes(cut, data, n);
        status = otx_picture_read(run, cut, &picture);
        if (status >= 0)
            print_error("a prefix of %zu of %zu bytes is read\n", n, bytes);
        assert_true(status < 0);
        assert_null(picture.image.pixels);
        /* Findings may grow by the first of their kind. */
        assert_true(otx_heap_used(run->heap) < used + (1u << 20));
    }
}

#endif

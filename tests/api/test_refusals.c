/* test_refusals.c -- what a host holds after a call that failed: NULL, whatever
 * it held before, so that destroying it is no fault. */
#include "meter.h"

#include <stdio.h>
#include <unistd.h>

/* A reader, wrapped so that all of them look alike. */
typedef struct reader
{
    const char *name;
    osdtex_status (*read)(osdtex_context *, const char *path, void **out);
    void (*destroy)(void *);
} reader;

static osdtex_status
read_cage(osdtex_context *context, const char *path, void **out)
{
    osdtex_cage *cage = *out;
    const osdtex_status status = osdtex_cage_read(context, path, NULL, &cage);

    *out = cage;
    return status;
}

static void
destroy_cage(void *cage)
{
    osdtex_cage_destroy(cage);
}

static osdtex_status
read_exemplar(osdtex_context *context, const char *path, void **out)
{
    osdtex_exemplar *exemplar = *out;
    const osdtex_status status =
        osdtex_exemplar_read(context, path, NULL, &exemplar);

    *out = exemplar;
    return status;
}

static void
destroy_exemplar(void *exemplar)
{
    osdtex_exemplar_destroy(exemplar);
}

static osdtex_status
read_model(osdtex_context *context, const char *path, void **out)
{
    osdtex_model *model = *out;
    const osdtex_status status = osdtex_model_read(context, path, &model);

    *out = model;
    return status;
}

static void
destroy_model(void *model)
{
    osdtex_model_destroy(model);
}

static osdtex_status
read_image(osdtex_context *context, const char *path, void **out)
{
    osdtex_image *image = *out;
    const osdtex_status status = osdtex_image_read(context, path, &image);

    *out = image;
    return status;
}

static void
destroy_image(void *image)
{
    osdtex_image_destroy(image);
}

static const reader readers[] = {
    {"cage", read_cage, destroy_cage},
    {"exemplar", read_exemplar, destroy_exemplar},
    {"model", read_model, destroy_model},
    {"image", read_image, destroy_image},
};

enum
{
    READERS = sizeof readers / sizeof readers[0],
    FILE_MAX = 1 << 20
};

/* Whole files, each of which some reader takes and others refuse. The third
 * fails late: its picture is good, and what it says of its tiles is not. */
static const char *const files[] = {
    "models/cages/plane.obj",
    "models/exemplars/gravel_tile.png",
    "tests/fuzz/corpus/picture/tiles_of_another_size.exr",
    "tests",
    "there/is/no.file",
};

/* Reads `path` as everything. What a failed call leaves is NULL, and what a
 * good one gives can be destroyed; the meter sees that nothing else is held. */
static void
read_as_everything(const char *path)
{
    for (int i = 0; i < READERS; ++i)
    {
        meter m = {.fail_at = -1, .cancel_at = -1};
        const osdtex_context_options options = metered(&m);
        osdtex_context *context;
        osdtex_status status;
        void *handle = &m; /* no handle: destroying it would be seen */

        assert_int_equal(osdtex_context_create(&options, &context), OSDTEX_OK);
        status = readers[i].read(context, path, &handle);
        if ((status == OSDTEX_OK) != (handle != NULL))
            fail_msg("%s of %s: status %d", readers[i].name, path, status);
        readers[i].destroy(handle);
        osdtex_context_destroy(context);
        assert_int_equal(m.blocks, 0);
    }
}

static void
whole_files_of_every_kind(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i)
        read_as_everything(files[i]);
}

/* The first bytes of a file, under a name of its own. */
static void
write_prefix(const char *path, const unsigned char *data, size_t bytes)
{
    FILE *file = fopen(path, "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, bytes, file), bytes);
    fclose(file);
}

static void
files_that_end_early(void **state)
{
    static unsigned char data[FILE_MAX];
    char path[] = "/tmp/osdtex-test-XXXXXX";
    const int fd = mkstemp(path);

    (void)state;
    assert_true(fd >= 0);
    close(fd);
    for (int i = 0; i < 3; ++i)
    {
        FILE *file = fopen(files[i], "rb");
        const size_t bytes = file ? fread(data, 1, sizeof data, file) : 0;

        assert_true(bytes > 0);
        fclose(file);
        for (size_t part = 0; part < 16; ++part)
        {
            write_prefix(path, data, bytes * part / 16);
            read_as_everything(path);
        }
    }
    unlink(path);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_files_of_every_kind),
        cmocka_unit_test(files_that_end_early),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

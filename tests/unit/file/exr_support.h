/* exr_support.h -- EXR files that oiiotool makes for a test. */
#ifndef OTX_TESTS_EXR_SUPPORT_H
#define OTX_TESTS_EXR_SUPPORT_H

#include "picture_support.h"

/* A folder with a.exr, a noise picture, for what oiiotool makes of it. */
typedef struct fixture
{
    otx_run *run;
    test_folder folder;
    otx_image image; /* of a.exr */
} fixture;

static inline int
begin(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    otx_exr_options options = otx_exr_options_default();

    f->run = test_run_create();
    f->folder = test_folder_create();
    f->image = test_noise(f->run, 100, 70, 3);
    options.tiled = false;
    options.full_float = true;
    assert_int_equal(
        test_write_exr(
            f->run, test_path(&f->folder, "a.exr"), &f->image, &options),
        OSDTEX_OK);
    *state = f;
    return 0;
}

static inline int
end(void **state)
{
    fixture *f = *state;

    test_folder_remove(&f->folder);
    test_run_destroy(f->run);
    free(f);
    return 0;
}

/* Runs oiiotool in the folder; skips the test where there is none. */
static inline void
make(const fixture *f, const char *arguments)
{
    char command[5000];

    if (!test_has_tool("oiiotool"))
    {
        print_message("skipped: oiiotool is not installed\n");
        skip();
    }
    snprintf(command, sizeof command, "oiiotool %s", arguments);
    if (test_shell(&f->folder, command) != 0)
        fail_msg("%s", command);
}

static inline otx_picture
read_file(const fixture *f, const char *name)
{
    return test_read(f->run, test_path(&f->folder, name));
}

/* What oiiotool makes, as it is read. */
static inline otx_picture
made(const fixture *f, const char *arguments)
{
    char line[4096];

    snprintf(line, sizeof line, "%s -o b.exr", arguments);
    make(f, line);
    return read_file(f, "b.exr");
}

/* Findings of one file and kind fold, so each refusal has a name of its own. */
static inline void
refuse(
    const fixture *f, const char *name, otx_status expected, const char *word)
{
    otx_picture picture;

    assert_int_equal(
        otx_picture_read(f->run, test_path(&f->folder, name), &picture),
        expected);
    if (!strstr(test_last_message(f->run), word))
        fail_msg("no \"%s\" in: %s", word, test_last_message(f->run));
}

#endif

/* folder.h -- temporary folders and files, and the bytes in them. */
#ifndef OTX_TESTS_FOLDER_H
#define OTX_TESTS_FOLDER_H

#include "support.h"

#include <dirent.h>
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

static inline void
test_put(const char *path, const char *text)
{
    test_write_bytes(path, (const uint8_t *)text, strlen(text));
}

/* Whether a file has this text; a short one. */
static inline bool
test_holds(const char *path, const char *text)
{
    char found[32] = "";
    FILE *file = fopen(path, "r");

    if (!file)
        return false;
    found[fread(found, 1, sizeof found - 1, file)] = '\0';
    fclose(file);
    return strcmp(found, text) == 0;
}

static inline char *
test_read_text(otx_run *run, const char *path)
{
    size_t bytes;

    return (char *)test_read_bytes(run, path, &bytes);
}

/* A run and a file of its own as the state of a test. */
typedef struct test_file
{
    otx_run *run;
    char path[64];
} test_file;

static inline int
test_file_setup(void **state)
{
    test_file *f = calloc(1, sizeof *f);
    int fd;

    strcpy(f->path, "/tmp/osdtex-test-XXXXXX");
    fd = mkstemp(f->path);
    assert_true(fd >= 0);
    close(fd);
    f->run = test_run_create();
    *state = f;
    return 0;
}

static inline int
test_file_teardown(void **state)
{
    test_file *f = *state;

    unlink(f->path);
    test_run_destroy(f->run);
    free(f);
    return 0;
}

#endif

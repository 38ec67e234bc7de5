/* test_temporary.c -- names of unfinished files: nobody else's, short enough,
 * and gone with the process that made them. */
#include "folder.h"

#include "file/leftovers.h"
#include "file/temporary.h"

#include <errno.h>
#include <limits.h>
#include <sys/wait.h>

static int
begin(void **state)
{
    test_folder *folder = calloc(1, sizeof *folder);

    *folder = test_folder_create();
    *state = folder;
    return 0;
}

static int
end(void **state)
{
    test_folder_remove(*state);
    free(*state);
    return 0;
}

static bool
is_there(const char *path)
{
    struct stat info;

    return lstat(path, &info) == 0;
}

static const char *
create(otx_run *run, const char *path, const char *of)
{
    const char *out;

    assert_int_equal(otx_temporary_create(run->arena, path, of, &out), 0);
    assert_non_null(out);
    assert_true(is_there(out));
    return out;
}

static const char *
base_of(const char *path)
{
    return strrchr(path, '/') + 1;
}

static void
each_is_a_file_of_its_own(void **state)
{
    otx_run *run = test_run_create();
    const char *path = test_path(*state, "a.exr"), *made[20];

    for (int i = 0; i < 20; ++i)
    {
        struct stat info;

        made[i] = create(run, path, NULL);
        assert_int_equal(stat(made[i], &info), 0);
        assert_int_equal(info.st_size, 0);
        assert_int_equal(strncmp(made[i], path, strlen(path)), 0);
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(made[k], made[i]);
    }
    assert_false(is_there(path));
    test_run_destroy(run);
}

static void
a_second_name_is_the_same_file(void **state)
{
    otx_run *run = test_run_create();
    const char *path = test_path(*state, "a.exr");
    struct stat first, second;

    test_write_bytes(path, (const uint8_t *)"abc", 3);
    assert_int_equal(stat(path, &first), 0);
    assert_int_equal(stat(create(run, path, path), &second), 0);
    assert_int_equal(first.st_ino, second.st_ino);
    test_run_destroy(run);
}

/* 255 bytes are the most that a name may have. */
static void
long_names_are_made_shorter(void **state)
{
    otx_run *run = test_run_create();
    char name[NAME_MAX + 1];
    const char *a, *b;

    memset(name, 'n', NAME_MAX);
    name[NAME_MAX] = '\0';
    a = create(run, test_path(*state, name), NULL);
    name[0] = 'm';
    b = create(run, test_path(*state, name), NULL);
    assert_true(strlen(base_of(a)) <= NAME_MAX);
    assert_string_not_equal(a, b);
    otx_leftovers_sweep_own(a);
    assert_false(is_there(a) || is_there(b));
    test_run_destroy(run);
}

/* The name that a process which is no more has left. */
static const char *
left_behind(const char *path)
{
    static char name[TEST_PATH_BYTES];
    int pipes[2], status;
    pid_t child;

    assert_int_equal(pipe(pipes), 0);
    child = fork();
    if (child == 0)
    {
        otx_arena *arena = otx_arena_create(otx_allocator_create(NULL));
        const char *out;

        if (otx_temporary_create(arena, path, NULL, &out) != 0 ||
            write(pipes[1], out, strlen(out) + 1) < 0)
            _exit(1);
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_true(read(pipes[0], name, sizeof name) > 0);
    close(pipes[0]);
    close(pipes[1]);
    assert_true(is_there(name));
    return name;
}

static void
only_what_the_dead_have_left_is_swept(void **state)
{
    otx_run *run = test_run_create();
    const char *path = test_path(*state, "a.exr");
    const char *own = create(run, path, NULL), *dead = left_behind(path);
    char foreign[TEST_PATH_BYTES], folder[TEST_PATH_BYTES + 8];
    char cut[TEST_PATH_BYTES + 8];
    char *machine;

    /* The same of another machine, a folder of such a name, and a name that
     * only begins like one. */
    snprintf(foreign, sizeof foreign, "%s", dead);
    machine = strstr(foreign, ".tmp-") + 5;
    *machine = *machine == '0' ? '1' : '0';
    test_write_bytes(foreign, (const uint8_t *)"", 0);
    snprintf(folder, sizeof folder, "%s9", dead);
    assert_int_equal(mkdir(folder, 0700), 0);
    snprintf(cut, sizeof cut, "%s.exr", dead);
    test_write_bytes(cut, (const uint8_t *)"", 0);
    otx_leftovers_sweep(path);
    assert_false(is_there(dead));
    assert_true(is_there(own) && is_there(foreign));
    assert_true(is_there(folder) && is_there(cut));
    otx_leftovers_sweep_own(path);
    assert_false(is_there(own));
    assert_true(is_there(foreign) && is_there(folder));
    rmdir(folder);
    test_run_destroy(run);
}

static void
what_cannot_be_made_is_an_error(void **state)
{
    otx_run *run = test_run_create();
    test_ration ration = {0};
    const otx_allocator_hooks hooks = test_ration_hooks(&ration);
    otx_allocator *allocator;
    otx_arena *arena;
    const char *out;

    assert_int_equal(
        otx_temporary_create(
            run->arena, test_path(*state, "none/a.exr"), NULL, &out),
        ENOENT);
    assert_null(out);
    assert_int_equal(
        otx_temporary_create(
            run->arena, test_path(*state, "a"), test_path(*state, "none"),
            &out),
        ENOENT);
    ration.left = 2;
    allocator = otx_allocator_create(&hooks);
    arena = otx_arena_create(allocator);
    ration.left = 0;
    assert_int_equal(
        otx_temporary_create(arena, test_path(*state, "a"), NULL, &out),
        ENOMEM);
    assert_null(out);
    otx_arena_destroy(arena);
    otx_allocator_destroy(allocator);
    /* Folders that are not there have nothing to sweep. */
    otx_leftovers_sweep(test_path(*state, "none/a.exr"));
    otx_leftovers_sweep_own(test_path(*state, "none/a.exr"));
    test_run_destroy(run);
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(each_is_a_file_of_its_own),
        TEST(a_second_name_is_the_same_file),
        TEST(long_names_are_made_shorter),
        TEST(only_what_the_dead_have_left_is_swept),
        TEST(what_cannot_be_made_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

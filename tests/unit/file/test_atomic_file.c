/* test_atomic_file.c -- all files of a set appear, or none. */
#include "folder.h"

#include "file/atomic_file.h"

#include <dirent.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct fixture
{
    otx_run *run;
    char folder[32];
    char a[64], b[64];
} fixture;

static int
begin(void **state)
{
    fixture *f = calloc(1, sizeof *f);

    strcpy(f->folder, "/tmp/osdtex-atomic-XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    snprintf(f->a, sizeof f->a, "%s/a.obj", f->folder);
    snprintf(f->b, sizeof f->b, "%s/b.exr", f->folder);
    f->run = test_run_create();
    *state = f;
    return 0;
}

static int
end(void **state)
{
    fixture *f = *state;

    test_run_destroy(f->run);
    unlink(f->a);
    unlink(f->b);
    rmdir(f->b);
    assert_int_equal(rmdir(f->folder), 0);
    free(f);
    return 0;
}

static int
count_files(const fixture *f)
{
    DIR *folder = opendir(f->folder);
    const struct dirent *entry;
    int count = 0;

    while ((entry = readdir(folder)))
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

/* A set of two files, written to their temporaries. */
static otx_atomic_file_set *
make_set(fixture *f)
{
    otx_atomic_file_set *set;
    const char *temporary;

    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, f->a, &temporary), OSDTEX_OK);
    test_put(temporary, "new a");
    assert_int_equal(
        otx_atomic_file_add(f->run, set, f->b, &temporary), OSDTEX_OK);
    test_put(temporary, "new b");
    return set;
}

static void
commit_replaces_all(void **state)
{
    fixture *f = *state;
    const otx_arena_mark mark = otx_arena_here(f->run->scratch);
    otx_atomic_file_set *set;

    test_put(f->a, "old a");
    set = make_set(f);
    assert_true(test_holds(f->a, "old a"));
    assert_int_equal(otx_atomic_file_commit(f->run, set, true), OSDTEX_OK);
    otx_arena_release(f->run->scratch, mark);
    assert_true(test_holds(f->a, "new a"));
    assert_true(test_holds(f->b, "new b"));
    assert_int_equal(count_files(f), 2);
}

static void
release_without_commit_leaves_what_was(void **state)
{
    fixture *f = *state;
    const otx_arena_mark mark = otx_arena_here(f->run->scratch);

    test_put(f->a, "old a");
    make_set(f);
    assert_int_equal(count_files(f), 3);
    otx_arena_release(f->run->scratch, mark);
    assert_true(test_holds(f->a, "old a"));
    assert_int_equal(count_files(f), 1);
}

static void
two_jobs_do_not_meet(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *first = make_set(f), *second = make_set(f);

    assert_int_equal(count_files(f), 4);
    assert_int_equal(otx_atomic_file_commit(f->run, second, false), OSDTEX_OK);
    assert_int_equal(otx_atomic_file_commit(f->run, first, false), OSDTEX_OK);
    assert_int_equal(count_files(f), 2);
}

static void
a_failing_rename_takes_back_new_files(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set = make_set(f);

    /* A folder has come to stand where the second file goes. */
    assert_int_equal(mkdir(f->b, 0777), 0);
    assert_int_equal(
        otx_atomic_file_commit(f->run, set, false), OSDTEX_ERROR_IO);
    assert_int_equal(count_files(f), 1);
}

/* What was there before is there again, whichever file fails. */
static void
a_failing_rename_brings_back_old_files(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;

    test_put(f->a, "old a");
    set = make_set(f);
    assert_int_equal(mkdir(f->b, 0777), 0);
    assert_int_equal(
        otx_atomic_file_commit(f->run, set, true), OSDTEX_ERROR_IO);
    assert_true(test_holds(f->a, "old a"));
    assert_int_equal(count_files(f), 2);
}

/* Calls that share a set: nothing appears before the end, and what a call did
 * not finish never does. */
static void
a_shared_set_appears_at_its_end(void **state)
{
    fixture *f = *state;
    otx_run *run = f->run;
    otx_atomic_file_set *shared, *set;
    otx_atomic_file_entry entry;
    const char *temporary;

    assert_int_equal(
        otx_atomic_file_share(run, run->scratch, &shared), OSDTEX_OK);
    run->outputs = shared;
    assert_int_equal(otx_atomic_file_begin(run, run->scratch, &set), OSDTEX_OK);
    assert_ptr_equal(set, shared);
    assert_int_equal(
        otx_atomic_file_add(run, set, f->a, &temporary), OSDTEX_OK);
    test_put(temporary, "new a");
    assert_false(otx_atomic_file_at(set, 0, &entry)); /* not finished */
    otx_atomic_file_describe(set, f->a, "picture");
    assert_int_equal(otx_atomic_file_commit(run, set, true), OSDTEX_OK);
    assert_int_not_equal(access(f->a, F_OK), 0);
    assert_true(otx_atomic_file_at(set, 0, &entry));
    assert_string_equal(entry.path, f->a);
    assert_string_equal(entry.temporary, temporary);
    assert_string_equal(entry.role, "picture");
    assert_false(otx_atomic_file_at(set, 1, &entry));
    assert_int_equal(
        otx_atomic_file_add(run, set, f->b, &temporary), OSDTEX_OK);
    assert_int_equal(otx_atomic_file_publish(run, shared), OSDTEX_OK);
    run->outputs = NULL;
    assert_true(test_holds(f->a, "new a"));
    assert_int_equal(count_files(f), 1);
}

static void
links_and_protected_files_are_refused(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;
    const char *temporary;

    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    test_put(f->b, "kept");
    assert_int_equal(symlink(f->b, f->a), 0);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, f->a, &temporary), OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(f->run), "link"));
    assert_int_equal(chmod(f->b, 0444), 0);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, f->b, &temporary), OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(f->run), "write-protected"));
}

/* A process that ends as if killed, and the next one in that folder. */
static void
leftovers_of_the_dead_are_swept(void **state)
{
    fixture *f = *state;
    char stranger[96];
    int ended;

    if (fork() == 0)
    {
        make_set(f);
        _exit(0);
    }
    wait(&ended);
    assert_int_equal(count_files(f), 2);
    snprintf(stranger, sizeof stranger, "%s.tmp-deadbeef-999999999-0", f->a);
    test_put(stranger, "of another machine");
    make_set(f);
    assert_int_equal(count_files(f), 3);
    assert_int_equal(unlink(stranger), 0);
}

static void
the_longest_name_has_a_temporary(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;
    const char *temporary;
    char path[300];

    snprintf(path, sizeof path, "%s/%0251d.obj", f->folder, 1);
    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, path, &temporary), OSDTEX_OK);
    assert_int_equal(otx_atomic_file_commit(f->run, set, false), OSDTEX_OK);
    assert_int_equal(unlink(path), 0);
    snprintf(path, sizeof path, "%s/%0252d.obj", f->folder, 1);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, path, &temporary), OSDTEX_ERROR_IO);
}

static void
impossible_places_are_refused_at_once(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;
    const char *temporary;

    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, "/nowhere/at/all.obj", &temporary),
        OSDTEX_ERROR_IO);
    assert_null(temporary);
    assert_non_null(strstr(test_last_message(f->run), "No such file"));
    assert_int_equal(
        otx_atomic_file_add(f->run, set, f->folder, &temporary),
        OSDTEX_ERROR_IO);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, "/dev/null", &temporary),
        OSDTEX_ERROR_IO);
    assert_non_null(strstr(test_last_message(f->run), "device"));
    assert_int_equal(otx_atomic_file_commit(f->run, set, false), OSDTEX_OK);
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(commit_replaces_all),
        TEST(release_without_commit_leaves_what_was),
        TEST(two_jobs_do_not_meet),
        TEST(a_failing_rename_takes_back_new_files),
        TEST(a_failing_rename_brings_back_old_files),
        TEST(a_shared_set_appears_at_its_end),
        TEST(links_and_protected_files_are_refused),
        TEST(leftovers_of_the_dead_are_swept),
        TEST(the_longest_name_has_a_temporary),
        TEST(impossible_places_are_refused_at_once)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

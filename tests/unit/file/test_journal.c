/* test_journal.c -- a process that is killed while files take their names
 * leaves a set that the next one completes. */
#include "folder.h"

#include "file/atomic_file.h"
#include "file/journal.h"
#include "file/leftovers.h"
#include "file/temporary.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum
{
    FILES = 3,
    NEVER = -1,
    PATH_SIZE = 512
};

/* Renames that are still to come before this process is killed. */
static int renames_left = NEVER;

/* The C library's, but for that. */
int
rename(const char *from, const char *to)
{
    if (renames_left == 0)
        raise(SIGKILL);
    if (renames_left > 0)
        --renames_left;
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

typedef struct fixture
{
    otx_run *run;
    char folder[64];
    char paths[FILES][PATH_SIZE];
} fixture;

static int
begin(void **state)
{
    static const char *const names[FILES] = {"b.exr", "a\nb.mtl", "a.obj"};
    fixture *f = calloc(1, sizeof *f);

    strcpy(f->folder, "/tmp/osdtex-journal-XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    for (int i = 0; i < FILES; ++i)
        snprintf(f->paths[i], PATH_SIZE, "%s/%s", f->folder, names[i]);
    f->run = test_run_create();
    *state = f;
    return 0;
}

static int
end(void **state)
{
    fixture *f = *state;
    char command[128];

    test_run_destroy(f->run);
    snprintf(command, sizeof command, "rm -r '%s'", f->folder);
    assert_int_equal(system(command), 0);
    free(f);
    return 0;
}

/* Whether there are temporaries; the last one's name, where it is asked for. */
static int
count_temporaries(const fixture *f, char journal[PATH_SIZE])
{
    DIR *folder = opendir(f->folder);
    const struct dirent *entry;
    int count = 0;

    while ((entry = readdir(folder)))
    {
        count += strstr(entry->d_name, ".tmp-") != NULL;
        if (journal &&
            strncmp(
                entry->d_name, OTX_JOURNAL_NAME, strlen(OTX_JOURNAL_NAME)) == 0)
            snprintf(journal, PATH_SIZE, "%s/%s", f->folder, entry->d_name);
    }
    closedir(folder);
    return count;
}

/* Writes the set in a process of its own, which is killed before the rename of
 * that number. */
static void
be_killed(fixture *f, int at)
{
    int ended;

    if (fork() == 0)
    {
        otx_atomic_file_set *set;
        const char *temporary;

        renames_left = at;
        otx_atomic_file_begin(f->run, f->run->scratch, &set);
        for (int i = 0; i < FILES; ++i)
        {
            otx_atomic_file_add(f->run, set, f->paths[i], &temporary);
            test_put(temporary, "new");
        }
        otx_atomic_file_commit(f->run, set, false);
        _exit(1);
    }
    wait(&ended);
    assert_true(WIFSIGNALED(ended) && WTERMSIG(ended) == SIGKILL);
}

static int
count_new(const fixture *f)
{
    int count = 0;

    for (int i = 0; i < FILES; ++i)
        count += test_holds(f->paths[i], "new");
    return count;
}

static void
half_a_set_is_completed(void **state)
{
    fixture *f = *state;

    for (int at = 0; at < FILES; ++at)
    {
        test_put(f->paths[0], "old");
        test_put(f->paths[1], "old");
        unlink(f->paths[2]);
        be_killed(f, at);
        assert_int_equal(count_new(f), at);
        otx_leftovers_sweep(f->paths[0]);
        assert_int_equal(count_new(f), FILES);
        assert_int_equal(count_temporaries(f, NULL), 0);
    }
}

/* Whoever waits for the model finds what it names. */
static void
the_last_one_added_comes_last(void **state)
{
    fixture *f = *state;

    be_killed(f, FILES - 1);
    assert_true(test_holds(f->paths[0], "new"));
    assert_int_not_equal(access(f->paths[FILES - 1], F_OK), 0);
}

static void
the_next_one_who_writes_there_completes_it(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;
    const char *temporary;
    char other[PATH_SIZE];

    be_killed(f, 1);
    snprintf(other, sizeof other, "%s/other.obj", f->folder);
    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_atomic_file_add(f->run, set, other, &temporary), OSDTEX_OK);
    assert_int_equal(count_new(f), FILES);
    assert_int_equal(count_temporaries(f, NULL), 1);
}

/* Of somebody who has worked on since. */
static void
a_name_that_was_taken_stops_it(void **state)
{
    fixture *f = *state;

    test_put(f->paths[1], "old");
    test_put(f->paths[2], "old");
    be_killed(f, 1);
    test_put(f->paths[2], "theirs");
    otx_leftovers_sweep(f->paths[0]);
    assert_true(test_holds(f->paths[1], "old"));
    assert_true(test_holds(f->paths[2], "theirs"));
    assert_int_equal(count_temporaries(f, NULL), 0);
}

static void
a_journal_that_was_cut_short_is_no_journal(void **state)
{
    fixture *f = *state;
    char journal[PATH_SIZE] = "";
    struct stat info;

    be_killed(f, 1);
    assert_int_equal(count_temporaries(f, journal), FILES);
    assert_int_equal(stat(journal, &info), 0);
    assert_int_equal(truncate(journal, info.st_size - 1), 0);
    otx_leftovers_sweep(f->paths[0]);
    assert_int_equal(count_new(f), 1);
    assert_int_equal(count_temporaries(f, NULL), 0);
}

static bool
is_temporary(const void *of, const char *name)
{
    (void)of;
    return strstr(name, ".tmp-") != NULL;
}

/* Who can write into the folder cannot have files renamed that are none of a
 * set's, or that lie elsewhere. */
static void
a_journal_speaks_of_temporaries_beside_it(void **state)
{
    static const char *const lines[][2] = {
        {"secret", "public"},
        {"x.tmp-1", "../public"},
        {"../x.tmp-1", "public"},
        {"x.tmp-1", "y.tmp-2"}};
    fixture *f = *state;
    char path[PATH_SIZE];
    int folder = open(f->folder, O_RDONLY | O_DIRECTORY);

    snprintf(path, sizeof path, "%s/secret", f->folder);
    test_put(path, "secret");
    snprintf(path, sizeof path, "%s/x.tmp-1", f->folder);
    test_put(path, "x");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i)
    {
        snprintf(path, sizeof path, "%s/journal", f->folder);
        FILE *file = fopen(path, "w");

        fprintf(file, "%s%c%s%c-%cend%c", lines[i][0], 0, lines[i][1], 0, 0, 0);
        fclose(file);
        otx_journal_complete(folder, "journal", is_temporary, NULL);
        snprintf(path, sizeof path, "%s/public", f->folder);
        assert_int_not_equal(access(path, F_OK), 0);
        snprintf(path, sizeof path, "%s/x.tmp-1", f->folder);
        assert_int_equal(access(path, F_OK), 0);
    }
    close(folder);
}

static void
a_process_that_leaves_removes_its_own(void **state)
{
    fixture *f = *state;
    otx_atomic_file_set *set;
    const char *temporary;

    test_put(f->paths[0], "old");
    assert_int_equal(
        otx_atomic_file_begin(f->run, f->run->scratch, &set), OSDTEX_OK);
    for (int i = 0; i < FILES; ++i)
        assert_int_equal(
            otx_atomic_file_add(f->run, set, f->paths[i], &temporary),
            OSDTEX_OK);
    assert_int_equal(count_temporaries(f, NULL), FILES);
    otx_leftovers_sweep_own(f->paths[0]);
    assert_int_equal(count_temporaries(f, NULL), 0);
    assert_true(test_holds(f->paths[0], "old"));
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(half_a_set_is_completed),
        TEST(the_last_one_added_comes_last),
        TEST(the_next_one_who_writes_there_completes_it),
        TEST(a_name_that_was_taken_stops_it),
        TEST(a_journal_that_was_cut_short_is_no_journal),
        TEST(a_journal_speaks_of_temporaries_beside_it),
        TEST(a_process_that_leaves_removes_its_own)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

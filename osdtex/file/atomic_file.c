/* atomic_file.c -- output files that appear together, or not at all.
 *
 * rename(2) replaces one file in one step, but nothing replaces several. So
 * everything that can fail for a reason (no folder, no right to write, a full
 * disk) fails before the first rename: temporaries are made in the final
 * folder, and `durable` syncs all of them first. */
#include "file/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define STAGE "write"

enum
{
    MAX_ATTEMPTS = 1000,
    SUFFIX_BYTES = 48
};

typedef struct entry
{
    struct entry *next;
    char *path;
    char *temporary;
    bool existed; /* `path` did, when the temporary was made */
    bool renamed;
} entry;

struct otx_atomic_file_set
{
    otx_arena *arena;
    entry *first;
    entry **last; /* where the next one goes */
};

static otx_status
fail_errno(otx_run *run, const char *path, const char *what, int error)
{
    otx_where where = OTX_NOWHERE;

    where.file = path;
    return otx_fail(
        run, OSDTEX_ERROR_IO, STAGE, where, "%s: %s", what, strerror(error));
}

/* Removes the temporaries now. The set is then empty. */
static void
discard(otx_atomic_file_set *set)
{
    for (const entry *e = set->first; e; e = e->next)
    {
        if (!e->renamed)
            unlink(e->temporary);
    }
    set->first = NULL;
    set->last = &set->first;
}

static void
discard_deferred(void *set)
{
    discard(set);
}

otx_status
otx_atomic_file_begin(otx_run *run, otx_arena *arena, otx_atomic_file_set **out)
{
    otx_atomic_file_set *set = OTX_NEW(arena, otx_atomic_file_set, 1);

    *out = NULL;
    if (!set)
        return otx_fail_memory(run, STAGE);
    *set = (otx_atomic_file_set){arena, NULL, &set->first};
    if (!otx_arena_defer(arena, discard_deferred, set))
        return otx_fail_memory(run, STAGE);
    *out = set;
    return OSDTEX_OK;
}

/* Creates a file that nobody else has, beside `path`. The process number
 * keeps jobs on one machine apart, O_EXCL the rest. */
static otx_status
create_temporary(otx_run *run, const char *path, char *name, size_t bytes)
{
    int fd = -1;

    for (int i = 0; i < MAX_ATTEMPTS && fd < 0; ++i)
    {
        snprintf(name, bytes, "%s.tmp-%ld-%d", path, (long)getpid(), i);
        fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST)
            break;
    }
    if (fd < 0)
        return fail_errno(
            run, path, "no file can be made in this folder", errno);
    close(fd);
    return OSDTEX_OK;
}

static otx_status
check_target(otx_run *run, const char *path, bool *existed)
{
    struct stat info;
    otx_where where = OTX_NOWHERE;

    where.file = path;
    *existed = stat(path, &info) == 0;
    if (!*existed || S_ISREG(info.st_mode))
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_IO, STAGE, where,
        "this is a folder or a device, not a file; give the output a name of "
        "its own");
}

otx_status
otx_atomic_file_add(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const char **temporary)
{
    const size_t bytes = strlen(path) + SUFFIX_BYTES;
    entry *e = OTX_ZNEW(set->arena, entry, 1);

    *temporary = NULL;
    if (e)
    {
        e->path = otx_arena_strdup(set->arena, path);
        e->temporary = OTX_NEW(set->arena, char, bytes);
    }
    if (!e || !e->path || !e->temporary)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(check_target(run, path, &e->existed));
    OTX_TRY(create_temporary(run, path, e->temporary, bytes));
    *set->last = e;
    set->last = &e->next;
    *temporary = e->temporary;
    return OSDTEX_OK;
}

static otx_status
sync_entry(otx_run *run, const entry *e)
{
    const int fd = open(e->temporary, O_WRONLY | O_CLOEXEC);
    int error = 0;

    if (fd < 0 || fsync(fd) != 0)
        error = errno;
    if (fd >= 0)
        close(fd);
    if (error == 0)
        return OSDTEX_OK;
    return fail_errno(run, e->path, "the file cannot be written", error);
}

/* After a rename that failed: takes back what was not there before. */
static void
take_back(otx_atomic_file_set *set)
{
    for (const entry *e = set->first; e; e = e->next)
    {
        if (e->renamed && !e->existed)
            unlink(e->path);
    }
    discard(set);
}

otx_status
otx_atomic_file_commit(otx_run *run, otx_atomic_file_set *set, bool durable)
{
    for (const entry *e = set->first; e && durable; e = e->next)
        OTX_TRY(sync_entry(run, e));
    for (entry *e = set->first; e; e = e->next)
    {
        if (rename(e->temporary, e->path) != 0)
        {
            const otx_status status = fail_errno(
                run, e->path, "the finished file cannot take its name", errno);

            take_back(set);
            return status;
        }
        e->renamed = true;
    }
    discard(set);
    return OSDTEX_OK;
}

/* atomic_file.c -- output files that appear together, or not at all.
 *
 * rename(2) replaces one file in one step, but nothing replaces several. So
 * everything that can fail for a reason (no folder, no right to write, a full
 * disk) fails before the first rename: temporaries are made in the final
 * folder, and what is durable is synced first. While files take their names,
 * those that they replace are kept under second names, and come back when one
 * of them cannot; a journal in each folder has the next run complete what a
 * kill has cut short. */
#include "file/atomic_file.h"

#include "file/journal.h"
#include "file/leftovers.h"
#include "file/mark.h"
#include "file/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define STAGE "write"

typedef struct entry
{
    struct entry *next;
    const char *path;
    const char *temporary;
    const char *role; /* a literal; NULL: nobody said */
    const char *old;  /* what `path` was before the commit; NULL none */
    bool existed;     /* `path` did, when the temporary was made */
    bool finished;    /* its writer says so */
    bool sealed;
    bool renamed;
} entry;

struct otx_atomic_file_set
{
    otx_arena *arena;
    entry *first;
    entry **last;          /* where the next one goes */
    const char **journals; /* while files take their names */
    int32_t journal_count;
    bool is_shared;
    bool durable; /* asked for by the writer of one of them */
};

static otx_status
fail_errno(otx_run *run, const char *path, const char *what, int error)
{
    return otx_fail(
        run, OSDTEX_ERROR_IO, STAGE, otx_where_file(path), "%s: %s", what,
        strerror(error));
}

/* Removes the temporaries now. The set is then empty. */
static void
discard(otx_atomic_file_set *set)
{
    for (const entry *e = set->first; e; e = e->next)
    {
        if (!e->renamed)
            unlink(e->temporary);
        if (e->old)
            unlink(e->old);
    }
    for (int32_t i = 0; i < set->journal_count; ++i)
        unlink(set->journals[i]);
    set->journal_count = 0;
    set->first = NULL;
    set->last = &set->first;
}

static void
discard_deferred(void *set)
{
    discard(set);
}

static otx_status
begin(otx_run *run, otx_arena *arena, bool is_shared, otx_atomic_file_set **out)
{
    otx_atomic_file_set *set = OTX_ZNEW(arena, otx_atomic_file_set, 1);

    *out = NULL;
    if (!set)
        return otx_fail_memory(run, STAGE);
    set->arena = arena;
    set->last = &set->first;
    set->is_shared = is_shared;
    if (!otx_arena_defer(arena, discard_deferred, set))
        return otx_fail_memory(run, STAGE);
    *out = set;
    return OSDTEX_OK;
}

otx_status
otx_atomic_file_begin(otx_run *run, otx_arena *arena, otx_atomic_file_set **out)
{
    *out = run->outputs;
    return run->outputs ? OSDTEX_OK : begin(run, arena, false, out);
}

otx_status
otx_atomic_file_share(otx_run *run, otx_arena *arena, otx_atomic_file_set **out)
{
    return begin(run, arena, true, out);
}

/* A link would be replaced by a file, and what was protected by another. */
static otx_status
check_target(otx_run *run, const char *path, bool *existed)
{
    const otx_where where = otx_where_file(path);
    struct stat info;

    *existed = lstat(path, &info) == 0;
    if (!*existed && errno == ENAMETOOLONG)
        return fail_errno(run, path, "the output needs another name", errno);
    if (!*existed)
        return OSDTEX_OK;
    if (S_ISLNK(info.st_mode))
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "this is a link, which would be replaced by a file; remove it, or "
            "name the file itself");
    if (!S_ISREG(info.st_mode))
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "this is a folder or a device, not a file; give the output a name "
            "of its own");
    if (!(info.st_mode & 0222) || access(path, W_OK) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "this file is write-protected; make it writable, or give the "
            "output another name");
    return OSDTEX_OK;
}

/* Whether the set has had a file in the folder of `path` before. */
static bool
knows_folder(const otx_atomic_file_set *set, const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash ? (size_t)(slash - path) + 1 : 0;

    for (const entry *e = set->first; e; e = e->next)
        if (strncmp(e->path, path, length) == 0 &&
            !strchr(e->path + length, '/'))
            return true;
    return false;
}

otx_status
otx_atomic_file_add(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const char **temporary)
{
    entry *e = OTX_ZNEW(set->arena, entry, 1);
    int error;

    *temporary = NULL;
    if (e)
        e->path = otx_arena_strdup(set->arena, path);
    if (!e || !e->path)
        return otx_fail_memory(run, STAGE);
    if (!knows_folder(set, path))
        otx_leftovers_sweep(path);
    OTX_TRY(check_target(run, path, &e->existed));
    error = otx_temporary_create(set->arena, path, NULL, &e->temporary);
    if (error == ENOMEM)
        return otx_fail_memory(run, STAGE);
    if (error != 0)
        return fail_errno(
            run, path, "no file can be made in this folder", error);
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

/* After a rename that failed: what was there before is there again. Where the
 * disk knows no second names, an older file that was replaced stays so. */
static void
take_back(otx_atomic_file_set *set)
{
    for (entry *e = set->first; e; e = e->next)
    {
        if (!e->renamed)
            continue;
        if (e->old && rename(e->old, e->path) == 0)
            e->old = NULL;
        else if (!e->existed)
            unlink(e->path);
    }
    discard(set);
}

/* What is about to be renamed, by folders; *count 0 where it is one file. */
static const otx_journal_line *
list_renames(const otx_atomic_file_set *set, int32_t *count)
{
    otx_journal_line *lines;
    int32_t all = 0;

    *count = 0;
    for (const entry *e = set->first; e; e = e->next)
        all += e->finished;
    lines = OTX_NEW(set->arena, otx_journal_line, all);
    for (const entry *e = set->first; lines && e; e = e->next)
        if (e->finished)
            lines[(*count)++] = (otx_journal_line){e->temporary, e->path};
    if (*count == 1)
        *count = 0;
    return lines;
}

/* Whether an earlier line is of the same folder. */
static bool
has_journal(const otx_journal_line *lines, int32_t i)
{
    const char *slash = strrchr(lines[i].path, '/');
    const size_t length = slash ? (size_t)(slash - lines[i].path) + 1 : 0;

    for (int32_t k = 0; k < i; ++k)
        if (strncmp(lines[k].path, lines[i].path, length) == 0 &&
            !strchr(lines[k].path + length, '/'))
            return true;
    return false;
}

static otx_status
write_journals(otx_run *run, otx_atomic_file_set *set)
{
    int32_t count;
    const otx_journal_line *lines = list_renames(set, &count);

    set->journals = OTX_NEW(set->arena, const char *, count);
    if (!lines || !set->journals)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < count; ++i)
    {
        int error;

        if (has_journal(lines, i))
            continue;
        error = otx_journal_write(
            set->arena, lines + i, count - i,
            &set->journals[set->journal_count]);
        if (error != 0)
            return fail_errno(
                run, lines[i].path, "the file cannot be written", error);
        ++set->journal_count;
    }
    return OSDTEX_OK;
}

/* Gives a finished file its name; 0 or an error number. */
static int
rename_one(otx_atomic_file_set *set, entry *e)
{
    if (e->existed)
        otx_temporary_create(set->arena, e->path, e->path, &e->old);
    if (rename(e->temporary, e->path) != 0)
        return errno;
    e->renamed = true;
    return 0;
}

static otx_status
rename_all(otx_run *run, otx_atomic_file_set *set)
{
    OTX_TRY(write_journals(run, set));
    for (entry *e = set->first; e; e = e->next)
    {
        const int error = e->finished ? rename_one(set, e) : 0;

        if (error != 0)
        {
            const otx_status status = fail_errno(
                run, e->path, "the finished file cannot take its name", error);

            take_back(set);
            return status;
        }
    }
    discard(set);
    return OSDTEX_OK;
}

otx_status
otx_atomic_file_seal(otx_run *run, otx_atomic_file_set *set)
{
    for (entry *e = set->first; e; e = e->next)
    {
        int error;

        if (!e->finished || e->sealed)
            continue;
        OTX_TRY(otx_pulse(run));
        error = otx_mark_seal(e->temporary);
        if (error != 0)
            return fail_errno(
                run, e->path, "the file cannot be written", error);
        if (set->durable)
            OTX_TRY(sync_entry(run, e));
        e->sealed = true;
    }
    return OSDTEX_OK;
}

void
otx_atomic_file_describe(
    otx_atomic_file_set *set, const char *path, const char *role)
{
    for (entry *e = set->first; e; e = e->next)
        if (strcmp(e->path, path) == 0)
            e->role = role;
}

bool
otx_atomic_file_at(
    const otx_atomic_file_set *set, int32_t index, otx_atomic_file_entry *out)
{
    for (const entry *e = set->first; e; e = e->next)
        if (e->finished && index-- == 0)
        {
            *out = (otx_atomic_file_entry){e->path, e->temporary, e->role};
            return true;
        }
    return false;
}

otx_status
otx_atomic_file_publish(otx_run *run, otx_atomic_file_set *set)
{
    OTX_TRY(otx_atomic_file_seal(run, set));
    return rename_all(run, set);
}

otx_status
otx_atomic_file_commit(otx_run *run, otx_atomic_file_set *set, bool durable)
{
    for (entry *e = set->first; e; e = e->next)
        e->finished = true;
    set->durable |= durable;
    return set->is_shared ? OSDTEX_OK : otx_atomic_file_publish(run, set);
}

/* leftovers.c -- what killed processes left, completed and removed. */
#include "file/leftovers.h"

#include "file/journal.h"
#include "file/temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool
is_gone(long process)
{
    return process > 0 && kill((pid_t)process, 0) != 0 && errno == ESRCH;
}

static bool
is_own(long process)
{
    return process == (long)getpid();
}

typedef bool (*process_test)(long process);

/* Temporaries of a process, as journals ask for them. */
typedef struct owner
{
    const char *machine;
    long process;
} owner;

static bool
is_of(const void *of, const char *name)
{
    const owner *o = of;

    return otx_temporary_process(name, o->machine) == o->process;
}

static void
complete(int folder, const char *name, const char *machine)
{
    const owner o = {machine, otx_temporary_process(name, machine)};

    if (strncmp(name, OTX_JOURNAL_NAME, strlen(OTX_JOURNAL_NAME)) == 0)
        otx_journal_complete(folder, name, is_of, &o);
}

static void
drop(int folder, const char *name, const char *machine)
{
    struct stat info;

    (void)machine;
    if (fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0 &&
        S_ISREG(info.st_mode))
        unlinkat(folder, name, 0);
}

/* Does something to each temporary in a folder whose process is due. */
static void
visit(
    DIR *folder, process_test is_due,
    void (*act)(int folder, const char *name, const char *machine))
{
    char machine[OTX_TEMPORARY_LEAD_BYTES];
    const struct dirent *entry;

    otx_temporary_machine(machine);
    rewinddir(folder);
    while ((entry = readdir(folder)) != NULL)
        if (is_due(otx_temporary_process(entry->d_name, machine)))
            act(dirfd(folder), entry->d_name, machine);
}

/* The folder of a path; NULL when it cannot be read. */
static DIR *
open_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *name = slash ? strndup(path, (size_t)(slash - path) + 1) : NULL;
    DIR *folder = slash && !name ? NULL : opendir(name ? name : ".");

    free(name);
    return folder;
}

void
otx_leftovers_sweep(const char *path)
{
    DIR *folder = open_folder(path);

    if (!folder)
        return;
    visit(folder, is_gone, complete);
    visit(folder, is_gone, drop);
    closedir(folder);
}

void
otx_leftovers_sweep_own(const char *path)
{
    DIR *folder = open_folder(path);

    if (!folder)
        return;
    visit(folder, is_own, drop);
    closedir(folder);
}

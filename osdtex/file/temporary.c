/* temporary.c -- making them, and sweeping up after killed processes. */
#include "file/temporary.h"

#include "base/hash.h"
#include "file/journal.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    MAX_ATTEMPTS = 1000,
    MACHINE_DIGITS = 8,
    LEAD_BYTES = 64,  /* ".tmp-MACHINE-", "PROCESS-NUMBER" */
    SHORT_DIGITS = 16 /* of the hash that stands for a long name */
};

/* ".tmp-MACHINE-". Numbers of processes mean something within one machine and,
 * in containers, one space of numbers. */
static void
machine_lead(char lead[LEAD_BYTES])
{
    char text[2 * 256] = "", hash[OTX_HASH_TEXT_BYTES];
    ssize_t space;

    gethostname(text, 255);
    space = readlink("/proc/self/ns/pid", text + 256, 255);
    otx_hash_text(text, 256 + (size_t)(space > 0 ? space : 0), hash);
    snprintf(lead, LEAD_BYTES, ".tmp-%.*s-", MACHINE_DIGITS, hash);
}

/* The file's name in FOLDER/NAME, or what stands for it. */
static char *
lead_of(otx_arena *arena, const char *path, size_t *bytes)
{
    const char *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path;
    const size_t length = strlen(base);
    char *name, hash[OTX_HASH_TEXT_BYTES];

    *bytes = strlen(path) + 2 * LEAD_BYTES;
    name = OTX_NEW(arena, char, *bytes);
    if (!name)
        return NULL;
    otx_hash_text(base, length, hash);
    if (length + LEAD_BYTES <= NAME_MAX)
        strcpy(name, path);
    else
        snprintf(
            name, *bytes, "%.*s.osdtex-%.*s", (int)(base - path), path,
            SHORT_DIGITS, hash);
    return name;
}

static int
make(const char *name, const char *of)
{
    const int fd =
        of ? -1 : open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);

    if (fd >= 0)
        close(fd);
    if (fd >= 0 || (of && link(of, name) == 0))
        return 0;
    return errno;
}

int
otx_temporary_create(
    otx_arena *arena, const char *path, const char *of, const char **out)
{
    char machine[LEAD_BYTES];
    size_t bytes, length;
    char *name = lead_of(arena, path, &bytes);
    int error = EEXIST;

    *out = NULL;
    if (!name)
        return ENOMEM;
    machine_lead(machine);
    length = strlen(name);
    for (int i = 0; i < MAX_ATTEMPTS && error == EEXIST; ++i)
    {
        snprintf(
            name + length, bytes - length, "%s%ld-%d", machine, (long)getpid(),
            i);
        error = make(name, of);
    }
    if (error == 0)
        *out = name;
    return error;
}

/* The process in a name that ends in ".tmp-MACHINE-PROCESS-NUMBER"; 0 none. */
static long
process_of(const char *name, const char *machine)
{
    const char *found = NULL;
    char *end;
    long process;

    for (const char *at = strstr(name, machine); at;
         at = strstr(at + 1, machine))
        found = at;
    if (!found)
        return 0;
    process = strtol(found + strlen(machine), &end, 10);
    return process > 1 && *end == '-' && end[1] != '\0' &&
                   end[1 + strspn(end + 1, "0123456789")] == '\0'
               ? process
               : 0;
}

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

    return process_of(name, o->machine) == o->process;
}

static void
complete(int folder, const char *name, const char *machine)
{
    const owner o = {machine, process_of(name, machine)};

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
    char machine[LEAD_BYTES];
    const struct dirent *entry;

    machine_lead(machine);
    rewinddir(folder);
    while ((entry = readdir(folder)) != NULL)
        if (is_due(process_of(entry->d_name, machine)))
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
otx_temporary_sweep(const char *path)
{
    DIR *folder = open_folder(path);

    if (!folder)
        return;
    visit(folder, is_gone, complete);
    visit(folder, is_gone, drop);
    closedir(folder);
}

void
otx_temporary_sweep_own(const char *path)
{
    DIR *folder = open_folder(path);

    if (!folder)
        return;
    visit(folder, is_own, drop);
    closedir(folder);
}

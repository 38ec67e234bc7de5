/* temporary.c -- making files that nobody else has. */
#include "file/temporary.h"

#include "base/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum
{
    MAX_ATTEMPTS = 1000,
    MACHINE_DIGITS = 8,
    SHORT_DIGITS = 16 /* of the hash that stands for a long name */
};

void
otx_temporary_machine(char lead[OTX_TEMPORARY_LEAD_BYTES])
{
    char text[2 * 256] = "", hash[OTX_HASH_TEXT_BYTES];
    ssize_t space;

    gethostname(text, 255);
    space = readlink("/proc/self/ns/pid", text + 256, 255);
    otx_hash_text(text, 256 + (size_t)(space > 0 ? space : 0), hash);
    snprintf(
        lead, OTX_TEMPORARY_LEAD_BYTES, ".tmp-%.*s-", MACHINE_DIGITS, hash);
}

/* The file's name in FOLDER/NAME, or what stands for it. */
static char *
lead_of(otx_arena *arena, const char *path, size_t *bytes)
{
    const char *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path;
    const size_t length = strlen(base);
    char *name, hash[OTX_HASH_TEXT_BYTES];

    *bytes = strlen(path) + 2 * OTX_TEMPORARY_LEAD_BYTES;
    name = OTX_NEW(arena, char, *bytes);
    if (!name)
        return NULL;
    otx_hash_text(base, length, hash);
    if (length + OTX_TEMPORARY_LEAD_BYTES <= NAME_MAX)
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
    char machine[OTX_TEMPORARY_LEAD_BYTES];
    size_t bytes, length;
    char *name = lead_of(arena, path, &bytes);
    int error = EEXIST;

    *out = NULL;
    if (!name)
        return ENOMEM;
    otx_temporary_machine(machine);
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

long
otx_temporary_process(const char *name, const char *machine)
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

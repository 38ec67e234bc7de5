/* journal.c -- writing down renames, and completing them.
 *
 * A journal is a row of strings, each with its 0: temporary, name, and what the
 * name stood for (see put_state); behind the last one "end". */
#include "file/journal.h"

#include "file/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    STATE_BYTES = 128,
    PARTS = 3,           /* strings of a line */
    MOST_BYTES = 1 << 24 /* of a journal that is read */
};

static const char END[] = "end";

static size_t
folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? (size_t)(slash - path) + 1 : 0;
}

static bool
is_in(const char *path, const char *folder, size_t length)
{
    return folder_length(path) == length && strncmp(path, folder, length) == 0;
}

/* What stands under a name, such that another file, or the same with other
 * bytes, differs; "-" nothing. */
static void
put_state(int folder, const char *name, char text[STATE_BYTES])
{
    struct stat info;

    strcpy(text, "-");
    if (fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0)
        snprintf(
            text, STATE_BYTES, "%llx %llx %llx %llx %lx",
            (unsigned long long)info.st_dev, (unsigned long long)info.st_ino,
            (unsigned long long)info.st_size,
            (unsigned long long)info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
}

static void
put_string(FILE *out, const char *text)
{
    fwrite(text, 1, strlen(text) + 1, out);
}

static int
write_lines(const char *journal, const otx_journal_line *lines, int32_t count)
{
    const size_t length = folder_length(lines[0].path);
    FILE *out = fopen(journal, "wb");
    char state[STATE_BYTES];
    bool written;

    if (!out)
        return errno;
    for (int32_t i = 0; i < count; ++i)
    {
        if (!is_in(lines[i].path, lines[0].path, length))
            continue;
        put_state(AT_FDCWD, lines[i].path, state);
        put_string(out, lines[i].temporary + length);
        put_string(out, lines[i].path + length);
        put_string(out, state);
    }
    put_string(out, END);
    errno = ENOSPC;
    written = !ferror(out);
    return fclose(out) == 0 && written ? 0 : errno;
}

int
otx_journal_write(
    otx_arena *arena, const otx_journal_line *lines, int32_t count,
    const char **out)
{
    const size_t length = folder_length(lines[0].path);
    const size_t bytes = length + sizeof OTX_JOURNAL_NAME;
    char *path = OTX_NEW(arena, char, bytes);
    int error;

    *out = NULL;
    if (!path)
        return ENOMEM;
    snprintf(
        path, bytes, "%.*s%s", (int)length, lines[0].path, OTX_JOURNAL_NAME);
    error = otx_temporary_create(arena, path, NULL, out);
    if (error == 0)
        error = write_lines(*out, lines, count);
    if (error != 0 && *out)
    {
        unlink(*out);
        *out = NULL;
    }
    return error;
}

/* ---- completing ---------------------------------------------------------- */

/* All of it with a 0 behind; NULL when it cannot be had, or is not ours. */
static char *
read_all(int folder, const char *name, size_t *size)
{
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    struct stat info;
    char *bytes = NULL;

    if (fd >= 0 && fstat(fd, &info) == 0 && S_ISREG(info.st_mode) &&
        info.st_uid == geteuid() && info.st_size > 0 &&
        info.st_size < MOST_BYTES)
    {
        *size = (size_t)info.st_size;
        bytes = malloc(*size + 1);
        if (bytes && read(fd, bytes, *size) != (ssize_t)*size)
        {
            free(bytes);
            bytes = NULL;
        }
        if (bytes)
            bytes[*size] = '\0';
    }
    if (fd >= 0)
        close(fd);
    return bytes;
}

/* Takes the strings of one line; false at the end. */
static bool
next_line(const char **at, const char *end, const char *parts[PARTS])
{
    const char *text = *at;

    for (int i = 0; i < PARTS; ++i)
    {
        if (text >= end || (i == 0 && strcmp(text, END) == 0))
            return false;
        parts[i] = text;
        text += strlen(text) + 1;
    }
    *at = text;
    return true;
}

/* Whether it was written to its end. */
static bool
is_whole(const char *bytes, size_t size)
{
    return size >= sizeof END && bytes[size - 1] == '\0' &&
           strcmp(bytes + size - sizeof END, END) == 0;
}

/* Whether a line is still to be done: 1; has been: 0; must not be: -1. */
static int
judge(
    int folder, const char *const parts[PARTS],
    bool (*is_leftover)(const void *of, const char *name), const void *of)
{
    char now[STATE_BYTES];
    struct stat info;

    if (strchr(parts[0], '/') || strchr(parts[1], '/') ||
        !is_leftover(of, parts[0]) || is_leftover(of, parts[1]))
        return -1;
    if (fstatat(folder, parts[0], &info, AT_SYMLINK_NOFOLLOW) != 0)
        return 0;
    put_state(folder, parts[1], now);
    return S_ISREG(info.st_mode) && strcmp(now, parts[2]) == 0 ? 1 : -1;
}

void
otx_journal_complete(
    int folder, const char *name,
    bool (*is_leftover)(const void *of, const char *name), const void *of)
{
    size_t size = 0;
    char *bytes = read_all(folder, name, &size);
    bool fine = bytes && is_whole(bytes, size);
    const char *parts[PARTS];

    for (const char *at = bytes; fine && next_line(&at, bytes + size, parts);)
        fine = judge(folder, parts, is_leftover, of) >= 0;
    for (const char *at = bytes; fine && next_line(&at, bytes + size, parts);)
        if (judge(folder, parts, is_leftover, of) == 1)
            renameat(folder, parts[0], folder, parts[1]);
    free(bytes);
}

/* spool.c -- inputs that come through pipes. */
#include "cli/spool.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    PIECE_BYTES = 1 << 16
};

/* More than any input may have. */
static const size_t MOST_BYTES = (size_t)8 << 30;

static bool
is_pipe(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 && S_ISFIFO(info.st_mode);
}

static bool
write_all(int fd, const char *bytes, size_t count)
{
    while (count > 0)
    {
        const ssize_t done = write(fd, bytes, count);

        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return false;
        bytes += done;
        count -= (size_t)done;
    }
    return true;
}

/* False with errno set. */
static bool
copy_all(int from, int to)
{
    char piece[PIECE_BYTES];
    size_t total = 0;

    for (;;)
    {
        const ssize_t got = read(from, piece, sizeof piece);

        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return got == 0;
        total += (size_t)got;
        if (total > MOST_BYTES)
        {
            errno = EFBIG;
            return false;
        }
        if (!write_all(to, piece, (size_t)got))
            return false;
    }
}

/* A file in memory with what comes out of the pipe; -1 with errno set. */
static int
read_pipe(const char *path)
{
    const int from = open(path, O_RDONLY | O_CLOEXEC);
    const int to = from < 0 ? -1 : memfd_create("osdtex", MFD_CLOEXEC);
    const bool ok = to >= 0 && copy_all(from, to);
    const int error = errno;

    if (from >= 0)
        close(from);
    if (ok)
        return to;
    if (to >= 0)
        close(to);
    errno = error;
    return -1;
}

/* Exchanges the file in *text, behind `prefix` bytes of it, where it is a
 * pipe. */
static bool
take(otx_flag_values *values, const char **text, size_t prefix)
{
    otx_flag_spool *spool = &values->inputs.spools[values->inputs.spool_count];
    int fd;

    if (!*text || !is_pipe(*text + prefix))
        return true;
    for (int i = 0; i < values->inputs.spool_count; ++i)
        if (strcmp(values->inputs.spools[i].name, *text) == 0)
        {
            *text = values->inputs.spools[i].text;
            return true;
        }
    if (values->inputs.spool_count == OTX_FLAG_SPOOLS_MAX ||
        prefix + 32 > sizeof spool->text)
    {
        fprintf(stderr, "osdtex: error: too many inputs are pipes\n");
        return false;
    }
    fd = read_pipe(*text + prefix);
    if (fd < 0)
    {
        fprintf(
            stderr, "osdtex: error: %s: the pipe cannot be read: %s\n",
            *text + prefix, strerror(errno));
        return false;
    }
    snprintf(
        spool->text, sizeof spool->text, "%.*s/proc/self/fd/%d", (int)prefix,
        *text, fd);
    spool->name = *text;
    spool->prefix = prefix;
    *text = spool->text;
    ++values->inputs.spool_count;
    return true;
}

bool
otx_spool_inputs(otx_flag_values *values)
{
    static const otx_flag_id files[] = {
        OTX_FLAG_MASK, OTX_FLAG_CONSTRAINTS, OTX_FLAG_FOR, OTX_FLAG_PLACE,
        OTX_FLAG_COLORCONFIG};

    for (int i = 0; i < values->operand_count; ++i)
        if (!take(values, &values->operands[i], 0))
            return false;
    for (int i = 0; i < values->also_count; ++i)
    {
        const char *equals = strchr(values->also[i], '=');

        if (!take(
                values, &values->also[i],
                equals ? (size_t)(equals - values->also[i]) + 1 : 0))
            return false;
    }
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
        if (!take(values, &values->text[files[i]], 0))
            return false;
    return true;
}

const char *
otx_spool_name(const otx_flag_values *values, const char *path)
{
    for (int i = 0; path && i < values->inputs.spool_count; ++i)
    {
        const otx_flag_spool *spool = &values->inputs.spools[i];

        if (strcmp(spool->text + spool->prefix, path) == 0)
            return spool->name + spool->prefix;
    }
    return path;
}

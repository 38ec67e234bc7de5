/* text_out.c -- buffered text output with locale-free numbers. */
#include "file/text_out.h"

#include "bridge/charconv.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum
{
    BUFFER_BYTES = 1 << 18,
    CLOSED = -1
};

struct otx_text_out
{
    const char *stage;
    const char *name;
    int fd;
    int error; /* errno of the first failure, 0 none */
    size_t used;
    char buffer[BUFFER_BYTES];
};

/* Runs when the scratch arena is released before the stream was closed. */
static void
abandon(void *object)
{
    otx_text_out *out = object;

    if (out->fd != CLOSED)
        close(out->fd);
    out->fd = CLOSED;
}

static otx_status
fail_write(otx_run *run, const char *stage, const char *name, int error)
{
    otx_where where = OTX_NOWHERE;

    where.file = name;
    if (error == ENOSPC || error == EDQUOT)
        return otx_fail(
            run, OSDTEX_ERROR_IO, stage, where,
            "the disk (or your quota) is full; make room and run again");
    return otx_fail(
        run, OSDTEX_ERROR_IO, stage, where, "the file cannot be written: %s",
        strerror(error));
}

otx_status
otx_text_out_open(
    otx_run *run, const char *stage, const char *path, const char *name,
    otx_text_out **out)
{
    otx_text_out *o = OTX_NEW(run->scratch, otx_text_out, 1);

    *out = NULL;
    OTX_TRY(otx_run_ok(run));
    o->stage = stage;
    o->name = name ? name : path;
    o->error = 0;
    o->used = 0;
    o->fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (o->fd < 0)
        return fail_write(run, stage, o->name, errno);
    if (!otx_arena_defer(run->scratch, abandon, o))
    {
        abandon(o);
        return otx_fail_memory(run, stage);
    }
    *out = o;
    return OSDTEX_OK;
}

/* Writes everything, unless an earlier write has failed. */
static void
write_all(otx_text_out *out, const char *bytes, size_t count)
{
    while (count > 0 && out->error == 0)
    {
        const ssize_t done = write(out->fd, bytes, count);

        if (done >= 0)
        {
            bytes += done;
            count -= (size_t)done;
        }
        else if (errno != EINTR)
            out->error = errno;
    }
}

static void
flush(otx_text_out *out)
{
    write_all(out, out->buffer, out->used);
    out->used = 0;
}

/* A place for `count` more bytes, at most the buffer's size. */
static char *
reserve(otx_text_out *out, size_t count)
{
    if (BUFFER_BYTES - out->used < count)
        flush(out);
    return out->buffer + out->used;
}

void
otx_text_out_bytes(otx_text_out *out, const char *bytes, size_t count)
{
    if (count > BUFFER_BYTES)
    {
        flush(out);
        write_all(out, bytes, count);
        return;
    }
    memcpy(reserve(out, count), bytes, count);
    out->used += count;
}

void
otx_text_out_string(otx_text_out *out, const char *text)
{
    otx_text_out_bytes(out, text, strlen(text));
}

void
otx_text_out_char(otx_text_out *out, char c)
{
    *reserve(out, 1) = c;
    ++out->used;
}

void
otx_text_out_int(otx_text_out *out, int64_t value)
{
    out->used +=
        otx_charconv_print_int(reserve(out, OTX_CHARCONV_BYTES), value);
}

void
otx_text_out_float(otx_text_out *out, float value)
{
    out->used +=
        otx_charconv_print_float(reserve(out, OTX_CHARCONV_BYTES), value);
}

void
otx_text_out_double(otx_text_out *out, double value)
{
    out->used +=
        otx_charconv_print_double(reserve(out, OTX_CHARCONV_BYTES), value);
}

/* Bytes of `place` with the fewest decimals that read back as `value` beyond
 * the origin. A double may not have digits enough for that where the value is
 * much smaller than the origin; then all that it has are printed. */
static size_t
print_placed(
    char text[OTX_CHARCONV_BYTES], double place, double origin, float value)
{
    const int most = 15 - (int)fmax(0.0, floor(log10(fabs(place))));

    for (int decimals = 0; decimals <= most; ++decimals)
    {
        const size_t size = otx_charconv_print_fixed(text, place, decimals);
        const char *rest;
        double back = 0.0;

        otx_charconv_read_double(text, text + size, &back, &rest);
        if ((float)(back - origin) == value)
            return size;
    }
    return otx_charconv_print_double(text, place);
}

void
otx_text_out_placed(otx_text_out *out, float value, double origin)
{
    if (origin == 0.0)
        otx_text_out_float(out, value);
    else
        out->used += print_placed(
            reserve(out, OTX_CHARCONV_BYTES), origin + (double)value, origin,
            value);
}

void
otx_text_out_name(otx_text_out *out, const char *name, bool blanks)
{
    for (; *name; ++name)
    {
        const bool control = (unsigned char)*name < ' ';
        const bool blank = *name == ' ' || *name == '\t';

        otx_text_out_char(
            out, blank ? (blanks ? *name : '_') : (control ? '_' : *name));
    }
}

void
otx_text_out_mark(
    otx_text_out *out, const otx_mark *mark, const char *before,
    const char *after)
{
    char text[OTX_MARK_BYTES];

    otx_mark_print(mark, text);
    if (!text[0])
        return;
    otx_text_out_string(out, before);
    otx_text_out_string(out, text);
    otx_text_out_string(out, after);
}

otx_status
otx_text_out_close(otx_run *run, otx_text_out *out)
{
    flush(out);
    /* Network file systems report a full disk as late as here. */
    if (close(out->fd) != 0 && out->error == 0 && errno != EINTR)
        out->error = errno;
    out->fd = CLOSED;
    if (out->error == 0)
        return OSDTEX_OK;
    return fail_write(run, out->stage, out->name, out->error);
}

/* picture_read.c -- which reader a file belongs to. */
#include "file/picture_read.h"

#include "file/exr.h"
#include "file/jpeg_file.h"
#include "file/png_file.h"
#include "file/tiff_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum
{
    MAGIC_BYTES = 8
};

/* One format: what its files begin with, and who reads them. */
typedef struct format
{
    otx_picture_kind kind;
    uint8_t magic[MAGIC_BYTES];
    size_t magic_bytes;
    otx_status (*read)(otx_run *run, const char *path, otx_picture *out);
} format;

static const format formats[] = {
    {OTX_PICTURE_EXR, {0x76, 0x2F, 0x31, 0x01}, 4, otx_exr_read},
    {OTX_PICTURE_PNG,
     {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'},
     8,
     otx_png_file_read},
    {OTX_PICTURE_TIFF, {'I', 'I', 42, 0}, 4, otx_tiff_file_read},
    {OTX_PICTURE_TIFF, {'M', 'M', 0, 42}, 4, otx_tiff_file_read},
    {OTX_PICTURE_TIFF, {'I', 'I', 43, 0}, 4, otx_tiff_file_read},
    {OTX_PICTURE_TIFF, {'M', 'M', 0, 43}, 4, otx_tiff_file_read},
    {OTX_PICTURE_JPEG, {0xFF, 0xD8, 0xFF}, 3, otx_jpeg_file_read},
};

/* The first bytes of the file; fewer where it is shorter. */
static otx_status
read_magic(otx_run *run, const char *path, uint8_t magic[MAGIC_BYTES])
{
    /* A named pipe is opened without waiting for somebody to write. */
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    FILE *file = fd < 0 ? NULL : fdopen(fd, "rb");
    struct stat info;

    memset(magic, 0, MAGIC_BYTES);
    if (!file)
        return otx_fail(
            run, OSDTEX_ERROR_IO, "picture", otx_where_file(path),
            "the picture cannot be opened (%s)", strerror(errno));
    if (fstat(fileno(file), &info) == 0 && S_ISFIFO(info.st_mode))
    {
        fclose(file);
        return otx_fail(
            run, OSDTEX_ERROR_IO, "picture", otx_where_file(path),
            "a picture cannot be read from a pipe here; give a file");
    }
    errno = 0;
    fread(magic, 1, MAGIC_BYTES, file);

    const bool failed = ferror(file);
    const int reason = errno;

    fclose(file);
    if (failed)
        return otx_fail(
            run, OSDTEX_ERROR_IO, "picture", otx_where_file(path),
            "the picture cannot be read (%s)", strerror(reason));
    return OSDTEX_OK;
}

static const format *
find_format(const uint8_t magic[MAGIC_BYTES])
{
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        if (memcmp(magic, formats[i].magic, formats[i].magic_bytes) == 0)
            return &formats[i];
    return NULL;
}

/* Finds the first value that is not finite, rows from the top. */
static otx_status
check_finite(otx_run *run, const char *path, const otx_picture *picture)
{
    const otx_image *image = &picture->image;

    for (int32_t y = 0; y < image->height; ++y)
    {
        const float *row = otx_picture_row(picture, y);

        for (int32_t i = 0; i < image->width * image->channels; ++i)
            if (!isfinite(row[i]))
                return otx_fail(
                    run, OSDTEX_ERROR_NUMERIC, "picture", otx_where_file(path),
                    "pixel (%d, %d), counted from the top-left corner, is %s "
                    "in channel %c; paint it out, or run oiiotool --fixnan "
                    "box3 on the file",
                    i / image->channels, y,
                    isnan(row[i]) ? "not a number" : "infinite",
                    "RGBA"[i % image->channels]);
    }
    return OSDTEX_OK;
}

static otx_status
read_as(
    otx_run *run, const format *f, const char *path, const char *layer,
    otx_picture *out)
{
    if (layer && f->kind == OTX_PICTURE_EXR)
        OTX_TRY(otx_exr_read_layer(run, path, layer, out));
    else
        OTX_TRY(f->read(run, path, out));
    if (layer && f->kind != OTX_PICTURE_EXR)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "picture", otx_where_file(path),
            "the picture is no EXR and has no layers, so '%.60s' is not "
            "looked for",
            layer);
    out->kind = f->kind;
    out->has_alpha = out->image.channels == 4;
    if (f->kind != OTX_PICTURE_EXR)
    {
        out->data_window = (otx_picture_window){
            0, 0, out->image.width - 1, out->image.height - 1};
        out->display_window = out->data_window;
    }
    return out->is_float ? check_finite(run, path, out) : OSDTEX_OK;
}

otx_status
otx_picture_read(otx_run *run, const char *path, otx_picture *out)
{
    return otx_picture_read_layer(run, path, NULL, out);
}

otx_status
otx_picture_read_layer(
    otx_run *run, const char *path, const char *layer, otx_picture *out)
{
    uint8_t magic[MAGIC_BYTES];

    *out = (otx_picture){0};
    OTX_TRY(read_magic(run, path, magic));

    const format *f = find_format(magic);

    if (!f)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(path),
            "the file is not an EXR, PNG, TIFF or JPEG picture; convert it to "
            "one of these");

    const otx_arena_mark results = otx_arena_here(run->arena);
    const otx_arena_mark temporaries = otx_arena_here(run->scratch);
    const otx_status status = read_as(run, f, path, layer, out);

    otx_arena_release(run->scratch, temporaries);
    if (status != OSDTEX_OK)
    {
        otx_arena_release(run->arena, results);
        *out = (otx_picture){0};
    }
    return status;
}

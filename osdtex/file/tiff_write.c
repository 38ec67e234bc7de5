/* tiff_write.c -- a directory, then strips.
 *
 * libtiff would put the directory behind the pixels; it is written first, its
 * lists of strips after them into the room that was left, so that what the file
 * says of itself stands at its head. */
#include "file/tiff_write.h"

#include "file/mark.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <tiffio.h>

static const char STAGE[] = "picture";

enum
{
    MESSAGE_BYTES = 160,
    STRIP_BYTES = 1 << 18
};

typedef struct writer
{
    otx_run *run;
    const char *path;
    const otx_image *image;
    int32_t bits;
    uint32_t strip_rows;
    TIFF *tiff;
    uint8_t *strip; /* strip_rows rows, in run->scratch */
    char error[MESSAGE_BYTES];
} writer;

/* Non-zero: libtiff's global handler is not called as well. */
static int
on_error(
    TIFF *tiff, void *user, const char *module, const char *format,
    va_list arguments)
{
    writer *w = user;

    (void)tiff;
    (void)module;
    if (w->error[0] == '\0')
        vsnprintf(w->error, sizeof w->error, format, arguments);
    return 1;
}

static int
on_warning(
    TIFF *tiff, void *user, const char *module, const char *format,
    va_list arguments)
{
    (void)tiff;
    (void)user;
    (void)module;
    (void)format;
    (void)arguments;
    return 1;
}

static size_t
row_bytes(const writer *w)
{
    return (size_t)w->image->width * (size_t)w->image->channels *
           (size_t)(w->bits / 8);
}

/* Row `y_down` from the top, in the machine's order, which is the file's. */
static void
put_row(const writer *w, uint32_t y_down, uint8_t *out)
{
    const otx_image *image = w->image;
    const float *in =
        otx_image_at(image, 0, image->height - 1 - (int32_t)y_down);
    const int32_t count = image->width * image->channels;
    const double most = w->bits == 8 ? 255.0 : 65535.0;

    if (w->bits == 32)
    {
        memcpy(out, in, (size_t)count * sizeof *in);
        return;
    }
    for (int32_t i = 0; i < count; ++i)
    {
        const double value = in[i] < 0.0f ? 0.0 : in[i] > 1.0f ? 1.0 : in[i];
        const uint16_t word = (uint16_t)(value * most + 0.5);

        if (w->bits == 8)
            out[i] = (uint8_t)word;
        else
            memcpy(out + 2 * (size_t)i, &word, sizeof word);
    }
}

/* What the tags say. */
static bool
set_tags(writer *w)
{
    const uint16_t alpha[] = {EXTRASAMPLE_UNASSALPHA};
    const int32_t channels = w->image->channels;
    char mark[OTX_MARK_BYTES];
    bool set =
        TIFFSetField(w->tiff, TIFFTAG_IMAGEWIDTH, (uint32_t)w->image->width) &&
        TIFFSetField(
            w->tiff, TIFFTAG_IMAGELENGTH, (uint32_t)w->image->height) &&
        TIFFSetField(w->tiff, TIFFTAG_BITSPERSAMPLE, (int)w->bits) &&
        TIFFSetField(w->tiff, TIFFTAG_SAMPLESPERPIXEL, (int)channels) &&
        TIFFSetField(
            w->tiff, TIFFTAG_SAMPLEFORMAT,
            w->bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT) &&
        TIFFSetField(
            w->tiff, TIFFTAG_PHOTOMETRIC,
            channels == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB) &&
        TIFFSetField(w->tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
        TIFFSetField(w->tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
        TIFFSetField(
            w->tiff, TIFFTAG_PREDICTOR,
            w->bits == 32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL) &&
        TIFFSetField(w->tiff, TIFFTAG_ROWSPERSTRIP, w->strip_rows);

    if (set && channels == 4)
        set = TIFFSetField(w->tiff, TIFFTAG_EXTRASAMPLES, 1, alpha);
    otx_mark_print(w->run->mark, mark);
    if (set && mark[0])
        set = TIFFSetField(w->tiff, TIFFTAG_IMAGEDESCRIPTION, mark);
    return set;
}

static bool
put_strips(writer *w)
{
    const uint32_t height = (uint32_t)w->image->height;
    const size_t bytes = row_bytes(w);
    uint32_t strip = 0;

    for (uint32_t y = 0; y < height; y += w->strip_rows, ++strip)
    {
        const uint32_t end =
            y + w->strip_rows < height ? y + w->strip_rows : height;

        for (uint32_t row = y; row < end; ++row)
            put_row(w, row, w->strip + (row - y) * bytes);
        if (TIFFWriteEncodedStrip(
                w->tiff, strip, w->strip,
                (tmsize_t)((size_t)(end - y) * bytes)) < 0)
            return false;
    }
    return true;
}

static bool
put_all(writer *w)
{
    return set_tags(w) && TIFFDeferStrileArrayWriting(w->tiff) &&
           TIFFWriteCheck(w->tiff, 0, "") && TIFFWriteDirectory(w->tiff) &&
           TIFFSetDirectory(w->tiff, 0) && put_strips(w) &&
           TIFFForceStrileArrayWriting(w->tiff);
}

static void
writer_close(void *object)
{
    writer *w = object;

    if (w->tiff)
        TIFFClose(w->tiff);
    w->tiff = NULL;
}

/* libtiff opens by name; the handlers belong to the handle. */
static bool
open_tiff(writer *w, const char *temporary)
{
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();

    if (!options)
        return false;
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, w);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, w);
    w->tiff = TIFFOpenExt(temporary, "w", options);
    TIFFOpenOptionsFree(options);
    return w->tiff != NULL;
}

static otx_status
write_temporary(writer *w, const char *temporary)
{
    bool written;

    w->strip_rows = (uint32_t)(STRIP_BYTES / row_bytes(w));
    if (w->strip_rows < 1)
        w->strip_rows = 1;
    w->strip = OTX_NEW(w->run->scratch, uint8_t, w->strip_rows * row_bytes(w));
    if (!w->strip || !otx_arena_defer(w->run->scratch, writer_close, w))
        return otx_fail_memory(w->run, STAGE);
    written = open_tiff(w, temporary) && put_all(w) && TIFFFlush(w->tiff);
    writer_close(w);
    if (written && w->error[0] == '\0')
        return OSDTEX_OK;
    return otx_fail(
        w->run, OSDTEX_ERROR_IO, STAGE, otx_where_file(w->path),
        "the TIFF cannot be written (%s)",
        w->error[0] ? w->error : "libtiff does not say why");
}

static otx_status
check(const writer *w)
{
    const otx_image *image = w->image;
    const size_t count =
        (size_t)image->width * (size_t)image->height * (size_t)image->channels;

    if ((w->bits != 8 && w->bits != 16 && w->bits != 32) ||
        (image->channels != 1 && image->channels != 3 && image->channels != 4))
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, STAGE, otx_where_file(w->path),
            "a TIFF has 1, 3 or 4 channels of 8, 16 or 32 bits, not %d of %d",
            image->channels, w->bits);
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(image->pixels[i]))
            return otx_fail(
                w->run, OSDTEX_ERROR_NUMERIC, STAGE, otx_where_file(w->path),
                "the picture to write holds a value that is not finite; please "
                "report how it was made");
    return OSDTEX_OK;
}

otx_status
otx_tiff_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, int32_t bits)
{
    writer w = {.run = run, .path = path, .image = image, .bits = bits};
    const char *temporary;
    otx_arena_mark mark;
    otx_status status;

    OTX_TRY(check(&w));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    mark = otx_arena_here(run->scratch);
    status = write_temporary(&w, temporary);
    otx_arena_release(run->scratch, mark);
    return status;
}

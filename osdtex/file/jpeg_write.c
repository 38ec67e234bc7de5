/* jpeg_write.c -- JPEG, row by row.
 *
 * What must survive a longjmp is in `writer`. */
#include "file/jpeg_write.h"

#include "file/mark.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* jpeglib.h needs stdio.h first. */
#include <jpeglib.h>
#include <setjmp.h>

static const char STAGE[] = "picture";

enum
{
    QUALITY = 95
};

typedef struct writer
{
    otx_run *run;
    const char *path;
    const otx_image *image;
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    jmp_buf escape;
    bool created;
    FILE *file;
    JSAMPLE *row; /* in run->scratch */
    char error[JMSG_LENGTH_MAX];
    char mark[OTX_MARK_BYTES];
} writer;

static void
on_error(j_common_ptr jpeg)
{
    writer *w = jpeg->client_data;

    jpeg->err->format_message(jpeg, w->error);
    longjmp(w->escape, 1);
}

static void
on_message(j_common_ptr jpeg, int level)
{
    (void)jpeg;
    (void)level;
}

static void
on_output(j_common_ptr jpeg)
{
    (void)jpeg;
}

static void
writer_close(void *object)
{
    writer *w = object;

    if (w->created)
        jpeg_destroy_compress(&w->jpeg);
    if (w->file)
        fclose(w->file);
    w->created = false;
    w->file = NULL;
}

static void
set_header(writer *w)
{
    w->jpeg.image_width = (JDIMENSION)w->image->width;
    w->jpeg.image_height = (JDIMENSION)w->image->height;
    w->jpeg.input_components = 3;
    w->jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&w->jpeg);
    jpeg_set_quality(&w->jpeg, QUALITY, TRUE);
    /* One sample of colour to one of lightness. */
    w->jpeg.comp_info[0].h_samp_factor = 1;
    w->jpeg.comp_info[0].v_samp_factor = 1;
    w->jpeg.dct_method = JDCT_ISLOW;
}

static void
put_row(const writer *w, int32_t y_down)
{
    const otx_image *image = w->image;
    const float *in = otx_image_at(image, 0, image->height - 1 - y_down);
    JSAMPLE *out = w->row;

    for (int32_t x = 0; x < image->width; ++x, in += image->channels)
        for (int32_t c = 0; c < 3; ++c)
        {
            const double value = in[c] < 0.0f   ? 0.0
                                 : in[c] > 1.0f ? 1.0
                                                : in[c];

            *out++ = (JSAMPLE)(value * 255.0 + 0.5);
        }
}

/* Zero when libjpeg jumped out. */
static int
writer_run(writer *w)
{
    JSAMPROW row = w->row;

    if (setjmp(w->escape))
        return 0;
    jpeg_create_compress(&w->jpeg);
    w->created = true;
    jpeg_stdio_dest(&w->jpeg, w->file);
    set_header(w);
    jpeg_start_compress(&w->jpeg, TRUE);
    if (w->mark[0])
        jpeg_write_marker(
            &w->jpeg, JPEG_COM, (const JOCTET *)w->mark,
            (unsigned)strlen(w->mark));
    while (w->jpeg.next_scanline < w->jpeg.image_height)
    {
        put_row(w, (int32_t)w->jpeg.next_scanline);
        jpeg_write_scanlines(&w->jpeg, &row, 1);
    }
    jpeg_finish_compress(&w->jpeg);
    return 1;
}

static otx_status
fail_io(const writer *w)
{
    return otx_fail(
        w->run, OSDTEX_ERROR_IO, STAGE, otx_where_file(w->path),
        "the JPEG cannot be written (%s)",
        w->error[0] ? w->error : strerror(errno));
}

static otx_status
write_temporary(writer *w, const char *temporary)
{
    bool written;

    w->row = OTX_NEW(w->run->scratch, JSAMPLE, 3 * (size_t)w->image->width);
    if (!w->row || !otx_arena_defer(w->run->scratch, writer_close, w))
        return otx_fail_memory(w->run, STAGE);
    w->file = fopen(temporary, "wb");
    if (!w->file)
        return fail_io(w);
    otx_mark_print(w->run->mark, w->mark);
    w->jpeg.err = jpeg_std_error(&w->errors);
    w->jpeg.client_data = w;
    w->errors.error_exit = on_error;
    w->errors.emit_message = on_message;
    w->errors.output_message = on_output;
    written = writer_run(w) != 0;
    written = fclose(w->file) == 0 && written;
    w->file = NULL;
    return written ? OSDTEX_OK : fail_io(w);
}

static otx_status
check(const writer *w)
{
    const otx_image *image = w->image;
    const size_t count =
        (size_t)image->width * (size_t)image->height * (size_t)image->channels;

    if (image->channels != 3 && image->channels != 4)
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, STAGE, otx_where_file(w->path),
            "a JPEG is written of 3 or 4 channels, not %d", image->channels);
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(image->pixels[i]))
            return otx_fail(
                w->run, OSDTEX_ERROR_NUMERIC, STAGE, otx_where_file(w->path),
                "the picture to write holds a value that is not finite; please "
                "report how it was made");
    return OSDTEX_OK;
}

otx_status
otx_jpeg_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image)
{
    writer *w = OTX_ZNEW(run->scratch, writer, 1);
    const char *temporary;
    otx_arena_mark mark;
    otx_status status;

    if (!w)
        return otx_fail_memory(run, STAGE);
    w->run = run;
    w->path = path;
    w->image = image;
    OTX_TRY(check(w));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    mark = otx_arena_here(run->scratch);
    status = write_temporary(w, temporary);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* jpeg_file.c -- JPEG through libjpeg.
 *
 * libjpeg fills the missing part of a truncated file with grey and calls that
 * a warning. A texture made from half a picture is worse than none, so
 * warnings about the data are errors here. As with PNG, everything that must
 * survive a longjmp is in `reader`. */
#include "file/jpeg_file.h"

#include "file/exif.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* jpeglib.h needs stdio.h first. */
#include <jerror.h>
#include <jpeglib.h>
#include <setjmp.h>

enum
{
    /* A progressive file may repeat scans at almost no cost in bytes and full
     * cost in time; honest files have about ten. */
    MAX_SCANS = 200,
    ROWS_AT_ONCE = 1,
    EXIF_MARKER = JPEG_APP0 + 1,
    ICC_MARKER = JPEG_APP0 + 2,
    MARKER_BYTES_MAX = 0xFFFF
};

typedef struct reader
{
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf escape;
    bool created;
    FILE *file;
    JSAMPLE *row; /* one decoded row, in run->scratch */
    otx_picture *out;
    char error[JMSG_LENGTH_MAX];
} reader;

static void
on_error(j_common_ptr jpeg)
{
    reader *r = jpeg->client_data;

    jpeg->err->format_message(jpeg, r->error);
    longjmp(r->escape, 1);
}

static bool
is_harmless(int code)
{
    return code == JWRN_ADOBE_XFORM || code == JWRN_EXTRANEOUS_DATA ||
           code == JWRN_JFIF_MAJOR;
}

static void
on_message(j_common_ptr jpeg, int level)
{
    if (level < 0 && !is_harmless(jpeg->err->msg_code))
        on_error(jpeg);
}

static void
on_output(j_common_ptr jpeg)
{
    (void)jpeg;
}

static void
on_progress(j_common_ptr jpeg)
{
    reader *r = jpeg->client_data;

    if (r->jpeg.input_scan_number > MAX_SCANS)
    {
        snprintf(
            r->error, sizeof r->error, "more than %d progressive scans",
            MAX_SCANS);
        longjmp(r->escape, 1);
    }
}

static void
reader_close(void *object)
{
    reader *r = object;

    if (r->created)
        jpeg_destroy_decompress(&r->jpeg);
    if (r->file)
        fclose(r->file);
}

/* Zero when libjpeg jumped out. */
static int
reader_header(reader *r)
{
    if (setjmp(r->escape))
        return 0;
    jpeg_create_decompress(&r->jpeg);
    r->created = true;
    r->jpeg.progress = &r->progress;
    jpeg_stdio_src(&r->jpeg, r->file);
    jpeg_save_markers(&r->jpeg, EXIF_MARKER, MARKER_BYTES_MAX);
    jpeg_save_markers(&r->jpeg, ICC_MARKER, MARKER_BYTES_MAX);
    jpeg_read_header(&r->jpeg, TRUE);
    return 1;
}

/* The first marker of a kind whose data begin with `name`, a NUL included. */
static const struct jpeg_marker_struct *
marker_of(const reader *r, int kind, const char *name, size_t bytes)
{
    for (const struct jpeg_marker_struct *m = r->jpeg.marker_list; m;
         m = m->next)
        if (m->marker == kind && m->data_length >= bytes &&
            memcmp(m->data, name, bytes) == 0)
            return m;
    return NULL;
}

static void
read_exif(otx_run *run, const char *path, reader *r)
{
    static const char name[] = "Exif\0";
    const struct jpeg_marker_struct *m =
        marker_of(r, EXIF_MARKER, name, sizeof name);

    if (!m)
        return;

    const uint8_t *bytes = m->data + sizeof name;
    const size_t count = m->data_length - sizeof name;

    otx_exif_note_orientation(
        run, path, "JPEG", otx_exif_orientation(bytes, count));
    r->out->says_adobe_rgb = otx_exif_says_adobe_rgb(bytes, count);
}

/* Zero when libjpeg jumped out. It puts the pieces of the profile together. */
static int
collect_profile(reader *r, JOCTET **bytes, unsigned int *count)
{
    if (setjmp(r->escape))
        return 0;
    return jpeg_read_icc_profile(&r->jpeg, bytes, count);
}

static otx_status
read_profile(otx_run *run, reader *r)
{
    static const char name[] = "ICC_PROFILE";
    JOCTET *bytes = NULL;
    unsigned int count = 0;
    otx_status status;

    if (!marker_of(r, ICC_MARKER, name, sizeof name))
        return OSDTEX_OK;
    if (!collect_profile(r, &bytes, &count) || !bytes)
    {
        r->out->icc_fault = "a piece of it is missing or there twice";
        return OSDTEX_OK;
    }
    status = otx_picture_keep_icc(run, bytes, count, r->out);
    free(bytes);
    return status;
}

/* One decoded row to floats: grey is given three times. */
static void
convert_row(const reader *r, int32_t y)
{
    float *out = otx_picture_row(r->out, y);
    const int32_t width = r->out->image.width;
    const int32_t channels = r->jpeg.output_components;

    for (int32_t x = 0; x < width; ++x)
        for (int32_t c = 0; c < 3; ++c)
        {
            const JSAMPLE value =
                r->row[x * channels + (channels == 1 ? 0 : c)];

            *out++ = (float)(value / 255.0);
        }
}

/* Zero when libjpeg jumped out. The integer DCT is the one whose rounding is
 * specified, so that values are the same on every machine. */
static int
reader_rows(reader *r)
{
    if (setjmp(r->escape))
        return 0;
    r->jpeg.dct_method = JDCT_ISLOW;
    r->jpeg.out_color_space =
        r->jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&r->jpeg);
    while (r->jpeg.output_scanline < r->jpeg.output_height)
    {
        const JDIMENSION y = r->jpeg.output_scanline;

        jpeg_read_scanlines(&r->jpeg, &r->row, ROWS_AT_ONCE);
        convert_row(r, (int32_t)y);
    }
    jpeg_finish_decompress(&r->jpeg);
    return 1;
}

static otx_status
reader_open(otx_run *run, const char *path, reader *r)
{
    r->file = fopen(path, "rb");
    if (!r->file)
        return otx_fail(
            run, OSDTEX_ERROR_IO, "picture", otx_where_file(path),
            "the picture cannot be opened (%s)", strerror(errno));
    r->jpeg.err = jpeg_std_error(&r->errors);
    r->jpeg.client_data = r;
    r->errors.error_exit = on_error;
    r->errors.emit_message = on_message;
    r->errors.output_message = on_output;
    r->progress.progress_monitor = on_progress;
    return OSDTEX_OK;
}

static otx_status
reader_failed(otx_run *run, const char *path, const reader *r)
{
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(path),
        "the JPEG is damaged or cut short (%s); export it again", r->error);
}

otx_status
otx_jpeg_file_read(otx_run *run, const char *path, otx_picture *out)
{
    reader *r = OTX_ZNEW(run->scratch, reader, 1);

    if (!r || !otx_arena_defer(run->scratch, reader_close, r))
        return otx_fail_memory(run, "picture");
    r->out = out;
    OTX_TRY(reader_open(run, path, r));
    if (!reader_header(r))
        return reader_failed(run, path, r);
    if (r->jpeg.num_components != 1 && r->jpeg.num_components != 3)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
            "the JPEG has %d components (CMYK?); convert it to RGB",
            r->jpeg.num_components);
    OTX_TRY(otx_picture_create(
        run, path, r->jpeg.image_width, r->jpeg.image_height, 3, out));
    read_exif(run, path, r);
    OTX_TRY(read_profile(run, r));
    out->bits = 8;
    out->is_gray = r->jpeg.num_components == 1;
    r->row = OTX_NEW(run->scratch, JSAMPLE, (size_t)out->image.width * 3);
    OTX_TRY(otx_run_ok(run));
    return reader_rows(r) ? OSDTEX_OK : reader_failed(run, path, r);
}

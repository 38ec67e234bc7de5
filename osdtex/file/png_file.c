/* png_file.c -- PNG through libpng's row interface.
 *
 * libpng's simplified interface would turn 16-bit files into linear light;
 * here values stay as encoded. libpng reports errors by longjmp: everything
 * that must survive a jump is in `reader` or `writer`, reached by a pointer
 * that is set before setjmp and never changed after. */
#include "file/png_file.h"

#include "file/exif.h"

#include "file/atomic_file.h"
#include "file/mark.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <string.h>

enum
{
    MESSAGE_BYTES = 160
};

typedef struct reader
{
    otx_run *run;
    const char *path;
    FILE *file;
    png_structp png;
    png_infop info;
    uint8_t *bytes; /* the decoded rows, in run->scratch */
    size_t row_bytes;
    int32_t channels; /* of the decoded rows */
    otx_picture *out;
    char error[MESSAGE_BYTES];
    char warning[MESSAGE_BYTES];
} reader;

static void
keep_message(char kept[MESSAGE_BYTES], const char *message)
{
    if (kept[0] == '\0')
        snprintf(kept, MESSAGE_BYTES, "%s", message);
}

static void
reader_error(png_structp png, png_const_charp message)
{
    reader *r = png_get_error_ptr(png);

    keep_message(r->error, message);
    png_longjmp(png, 1);
}

static void
reader_warning(png_structp png, png_const_charp message)
{
    reader *r = png_get_error_ptr(png);

    keep_message(r->warning, message);
}

static void
reader_close(void *object)
{
    reader *r = object;

    png_destroy_read_struct(&r->png, &r->info, NULL);
    if (r->file)
        fclose(r->file);
}

/* Asks libpng for 8 or 16 bits of grey, grey + alpha, RGB or RGBA, and 16-bit
 * words in the machine's order. */
static void
reader_expand(reader *r)
{
    const uint16_t one = 1;

    png_set_expand(r->png);
    if (*(const uint8_t *)&one == 1)
        png_set_swap(r->png);
    png_set_interlace_handling(r->png);
    png_read_update_info(r->png, r->info);
    r->row_bytes = png_get_rowbytes(r->png, r->info);
    r->channels = png_get_channels(r->png, r->info);
}

/* Of cHRM, white first. */
static void
reader_chromaticities(reader *r)
{
    otx_picture *out = r->out;
    double v[8];

    if (png_get_cHRM(
            r->png, r->info, &v[6], &v[7], &v[0], &v[1], &v[2], &v[3], &v[4],
            &v[5]) == 0)
        return;
    for (int i = 0; i < 8; ++i)
        out->chromaticities[i] = (float)v[i];
    out->has_chromaticities = true;
}

static void
reader_metadata(reader *r)
{
    otx_picture *out = r->out;
    double gamma = 0.0;
    int intent;

    out->bits = png_get_bit_depth(r->png, r->info);
    out->says_srgb = png_get_sRGB(r->png, r->info, &intent) != 0;
    if (png_get_gAMA(r->png, r->info, &gamma) != 0)
        out->gamma = (float)gamma;
    reader_chromaticities(r);
}

/* What the chunks of the header hold besides numbers. */
static otx_status
keep_chunks(reader *r)
{
    png_charp name = NULL;
    int method = 0;
    png_bytep profile = NULL, exif = NULL;
    png_uint_32 bytes = 0;

    if (png_get_eXIf_1(r->png, r->info, &bytes, &exif) != 0)
    {
        otx_exif_note_orientation(
            r->run, r->path, "PNG", otx_exif_orientation(exif, bytes));
        r->out->says_adobe_rgb = otx_exif_says_adobe_rgb(exif, bytes);
    }
    if (png_get_iCCP(r->png, r->info, &name, &method, &profile, &bytes) != 0)
        return otx_picture_keep_icc(r->run, profile, bytes, r->out);
    /* libpng passes over a profile that it finds at fault. */
    if (strncmp(r->warning, "iCCP", 4) == 0)
    {
        r->out->icc_fault = otx_arena_strdup(r->run->arena, r->warning);
        OTX_TRY(otx_run_ok(r->run));
        r->warning[0] = '\0';
    }
    return OSDTEX_OK;
}

/* Header and transformations. Zero when libpng jumped out. */
static int
reader_header(reader *r)
{
    if (setjmp(png_jmpbuf(r->png)))
        return 0;
    png_init_io(r->png, r->file);
    png_read_info(r->png, r->info);
    reader_metadata(r);
    reader_expand(r);
    return 1;
}

/* All rows; the tail of the file is read too, so that its damage is seen. */
static int
reader_rows(reader *r, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(r->png)))
        return 0;
    png_read_image(r->png, rows);
    png_read_end(r->png, NULL);
    return 1;
}

static otx_status
reader_failed(const reader *r)
{
    return otx_fail(
        r->run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(r->path),
        "the PNG is damaged or cut short (%s); export it again", r->error);
}

static otx_status
reader_open(reader *r)
{
    r->file = fopen(r->path, "rb");
    if (!r->file)
        return otx_fail(
            r->run, OSDTEX_ERROR_IO, "picture", otx_where_file(r->path),
            "the picture cannot be opened (%s)", strerror(errno));
    r->png = png_create_read_struct(
        PNG_LIBPNG_VER_STRING, r, reader_error, reader_warning);
    if (r->png)
        r->info = png_create_info_struct(r->png);
    if (!r->info)
        return otx_fail_memory(r->run, "picture");
    /* libpng's own limits end at a million a side; ours come first. */
    png_set_user_limits(r->png, 0x7FFFFFFF, 0x7FFFFFFF);
    return OSDTEX_OK;
}

/* One decoded row to floats: grey is given three times. */
static void
convert_row(const reader *r, const uint8_t *row, int32_t width, float *out)
{
    const bool deep = r->row_bytes / (size_t)r->channels > (size_t)width;
    const int32_t colors = r->channels < 3 ? 1 : 3;
    const int32_t out_channels = r->out->image.channels;

    for (int32_t x = 0; x < width; ++x)
        for (int32_t c = 0; c < out_channels; ++c)
        {
            const int32_t source = c == 3 ? colors : colors == 1 ? 0 : c;
            const size_t i = (size_t)x * (size_t)r->channels + (size_t)source;
            uint16_t word;

            if (deep)
                memcpy(&word, row + 2 * i, sizeof word);
            *out++ = deep ? (float)(word / 65535.0) : (float)(row[i] / 255.0);
        }
}

static otx_status
read_pixels(reader *r)
{
    const int32_t height = r->out->image.height;
    uint8_t *bytes = otx_arena_alloc(r->run->scratch, height, r->row_bytes);
    png_bytepp rows = OTX_NEW(r->run->scratch, png_bytep, height);

    OTX_TRY(otx_run_ok(r->run));
    for (int32_t y = 0; y < height; ++y)
        rows[y] = bytes + (size_t)y * r->row_bytes;
    if (!reader_rows(r, rows))
        return reader_failed(r);
    for (int32_t y = 0; y < height; ++y)
        convert_row(
            r, rows[y], r->out->image.width, otx_picture_row(r->out, y));
    return OSDTEX_OK;
}

otx_status
otx_png_file_read(otx_run *run, const char *path, otx_picture *out)
{
    reader *r = OTX_ZNEW(run->scratch, reader, 1);

    if (!r || !otx_arena_defer(run->scratch, reader_close, r))
        return otx_fail_memory(run, "picture");
    r->run = run;
    r->path = path;
    r->out = out;
    OTX_TRY(reader_open(r));
    if (!reader_header(r))
        return reader_failed(r);
    OTX_TRY(otx_picture_create(
        run, path, png_get_image_width(r->png, r->info),
        png_get_image_height(r->png, r->info), 3 + (r->channels % 2 == 0),
        out));
    OTX_TRY(keep_chunks(r));
    out->is_gray = r->channels < 3;
    OTX_TRY(read_pixels(r));
    if (r->warning[0] != '\0')
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "picture", otx_where_file(path),
            "libpng says of this file: %s", r->warning);
    return OSDTEX_OK;
}

/* ---- writing ---------------------------------------------------------- */

typedef struct writer
{
    otx_run *run;
    const char *path;
    const otx_image *image;
    int32_t bits;
    bool is_data;
    FILE *file;
    png_structp png;
    png_infop info;
    uint8_t *row; /* one row, in run->scratch */
    char error[MESSAGE_BYTES];
    char mark[OTX_MARK_BYTES];
} writer;

static void
writer_error(png_structp png, png_const_charp message)
{
    writer *w = png_get_error_ptr(png);

    keep_message(w->error, message);
    png_longjmp(png, 1);
}

static void
writer_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void
writer_close(void *object)
{
    writer *w = object;

    png_destroy_write_struct(&w->png, &w->info);
}

/* Row `y_down` from the top, as big-endian integers. */
static void
quantise_row(const writer *w, int32_t y_down)
{
    const otx_image *image = w->image;
    const float *in = otx_image_at(image, 0, image->height - 1 - y_down);
    const int32_t count = image->width * image->channels;
    const double scale = w->bits == 8 ? 255.0 : 65535.0;
    uint8_t *out = w->row;

    for (int32_t i = 0; i < count; ++i)
    {
        const double value = in[i] < 0.0f ? 0.0 : in[i] > 1.0f ? 1.0 : in[i];
        const uint32_t integer = (uint32_t)(value * scale + 0.5);

        if (w->bits == 16)
            *out++ = (uint8_t)(integer >> 8);
        *out++ = (uint8_t)(integer & 0xFF);
    }
}

/* The seal ends the text, and the checksum of the chunk follows it. */
static void
write_mark(writer *w)
{
    static char key[] = "Comment";
    png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key};

    otx_mark_print(w->run->mark, w->mark);
    text.text = w->mark;
    if (w->mark[0])
        png_set_text(w->png, w->info, &text, 1);
}

/* Zero when libpng jumped out; the row counter is not looked at after that. */
static int
writer_run(writer *w)
{
    if (setjmp(png_jmpbuf(w->png)))
        return 0;
    png_init_io(w->png, w->file);
    png_set_IHDR(
        w->png, w->info, (png_uint_32)w->image->width,
        (png_uint_32)w->image->height, w->bits,
        w->image->channels == 4   ? PNG_COLOR_TYPE_RGBA
        : w->image->channels == 1 ? PNG_COLOR_TYPE_GRAY
                                  : PNG_COLOR_TYPE_RGB,
        PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
        PNG_FILTER_TYPE_DEFAULT);
    if (!w->is_data)
        png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    write_mark(w);
    png_write_info(w->png, w->info);
    for (int32_t y = 0; y < w->image->height; ++y)
    {
        quantise_row(w, y);
        png_write_row(w->png, w->row);
    }
    png_write_end(w->png, w->info);
    return 1;
}

static otx_status
check_image(otx_run *run, const char *path, const otx_image *image)
{
    const size_t count =
        (size_t)image->width * (size_t)image->height * (size_t)image->channels;

    for (size_t i = 0; i < count; ++i)
        if (!isfinite(image->pixels[i]))
            return otx_fail(
                run, OSDTEX_ERROR_NUMERIC, "picture", otx_where_file(path),
                "the picture to write holds a value that is not finite; please "
                "report how it was made");
    return OSDTEX_OK;
}

/* With the file open: writes it, and closes it whatever happens. */
static otx_status
write_file(writer *w)
{
    w->png = png_create_write_struct(
        PNG_LIBPNG_VER_STRING, w, writer_error, writer_warning);
    if (w->png)
        w->info = png_create_info_struct(w->png);

    const bool written = w->info && writer_run(w);
    const bool closed = fclose(w->file) == 0;

    if (!w->info)
        return otx_fail_memory(w->run, "picture");
    if (!written || !closed)
        return otx_fail(
            w->run, OSDTEX_ERROR_IO, "picture", otx_where_file(w->path),
            "the PNG cannot be written (%s)",
            w->error[0] != '\0' ? w->error : strerror(errno));
    return OSDTEX_OK;
}

static otx_status
write_temporary(writer *w, const char *temporary)
{
    const size_t row_values =
        (size_t)w->image->width * (size_t)w->image->channels;

    w->row = OTX_NEW(w->run->scratch, uint8_t, row_values * 2);
    if (!w->row || !otx_arena_defer(w->run->scratch, writer_close, w))
        return otx_fail_memory(w->run, "picture");
    w->file = fopen(temporary, "wb");
    if (!w->file)
        return otx_fail(
            w->run, OSDTEX_ERROR_IO, "picture", otx_where_file(w->path),
            "the PNG cannot be written (%s)", strerror(errno));
    return write_file(w);
}

static otx_status
write_checked(writer *w, otx_atomic_file_set *set)
{
    otx_run *run = w->run;
    const char *temporary;

    OTX_TRY(check_image(run, w->path, w->image));
    /* Before the mark: the set may live in the scratch arena too. */
    OTX_TRY(otx_atomic_file_add(run, set, w->path, &temporary));

    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_status status = write_temporary(w, temporary);

    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_png_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, int32_t bits)
{
    writer w = {.run = run, .path = path, .image = image, .bits = bits};

    if ((bits != 8 && bits != 16) ||
        (image->channels != 3 && image->channels != 4))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(path),
            "a PNG has 3 or 4 channels of 8 or 16 bits, not %d of %d",
            image->channels, bits);
    return write_checked(&w, set);
}

otx_status
otx_png_file_write_data(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image)
{
    writer w = {
        .run = run, .path = path, .image = image, .bits = 16, .is_data = true};

    if (image->channels != 1 && image->channels != 3 && image->channels != 4)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(path),
            "a PNG of data has 1, 3 or 4 channels, not %d", image->channels);
    return write_checked(&w, set);
}

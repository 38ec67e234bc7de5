/* tiff_file.c -- TIFF through libtiff.
 *
 * Grey and RGB of 8 to 64 bits are read directly, in strips or tiles, samples
 * interleaved or in planes, so that no precision is lost. What libtiff can
 * only show as 8-bit RGBA (bilevel, 2 and 4 bits, palettes, YCbCr) is read
 * that way. Handlers belong to the handle: libtiff's global ones, which print,
 * are never reached. */
#include "file/tiff_file.h"

#include "file/exif.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <tiffio.h>

enum
{
    MESSAGE_BYTES = 160,
    MAX_BLOCK_BYTES = 1 << 29,
    IGNORED = -1
};

typedef struct reader
{
    otx_run *run;
    const char *path;
    TIFF *tiff;
    otx_picture *out;
    char error[MESSAGE_BYTES];
    /* What the tags say. */
    uint32_t width, height;
    uint16_t bits, samples, sample_format, photometric, planes, compression;
    int32_t alpha_sample; /* -1 none */
} reader;

/* Decoded samples of a rectangle of the picture. */
typedef struct block
{
    const uint8_t *bytes;
    size_t row_bytes;
    int32_t x, y, width, height; /* y from the top; clipped to the picture */
    int32_t sample;              /* the plane's; IGNORED: samples interleaved */
} block;

/* Non-zero: libtiff's global handler is not called as well. */
static int
on_error(
    TIFF *tiff, void *user, const char *module, const char *format,
    va_list arguments)
{
    reader *r = user;

    (void)tiff;
    (void)module;
    if (r->error[0] == '\0')
        vsnprintf(r->error, sizeof r->error, format, arguments);
    return 1;
}

/* Warnings are about tags; nearly every file has some. */
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

static void
reader_close(void *object)
{
    reader *r = object;

    if (r->tiff)
        TIFFClose(r->tiff);
}

static otx_status
reader_failed(const reader *r)
{
    return otx_fail(
        r->run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(r->path),
        "the TIFF is damaged or cut short (%s); export it again",
        r->error[0] != '\0' ? r->error : "no reason given");
}

static otx_status
reader_open(reader *r)
{
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();

    if (!options)
        return otx_fail_memory(r->run, "picture");
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, r);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, r);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, MAX_BLOCK_BYTES);
    /* m: no memory map, in which a shrinking file would be a signal. */
    r->tiff = TIFFOpenExt(r->path, "rm", options);
    TIFFOpenOptionsFree(options);
    return r->tiff ? OSDTEX_OK : reader_failed(r);
}

/* The first extra sample that is said to be alpha. */
static void
find_alpha(reader *r, int32_t colors)
{
    uint16_t extra_count = 0;
    uint16_t *extras = NULL;

    r->alpha_sample = IGNORED;
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extras);
    for (int32_t i = 0; i < extra_count && colors + i < r->samples; ++i)
        if (extras[i] == EXTRASAMPLE_ASSOCALPHA ||
            extras[i] == EXTRASAMPLE_UNASSALPHA)
        {
            r->alpha_sample = colors + i;
            r->out->alpha_is_premultiplied =
                extras[i] == EXTRASAMPLE_ASSOCALPHA;
            return;
        }
    if (extra_count > 0)
        otx_note(
            r->run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(r->path),
            "the TIFF has %d extra channels that are not said to be alpha; "
            "they are ignored",
            extra_count);
}

static otx_status
reader_tags(reader *r)
{
    uint32_t profile_bytes = 0;
    void *profile = NULL;

    r->photometric = PHOTOMETRIC_MINISBLACK;
    if (!TIFFGetField(r->tiff, TIFFTAG_IMAGEWIDTH, &r->width) ||
        !TIFFGetField(r->tiff, TIFFTAG_IMAGELENGTH, &r->height))
        return reader_failed(r);
    TIFFGetField(r->tiff, TIFFTAG_PHOTOMETRIC, &r->photometric);
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_BITSPERSAMPLE, &r->bits);
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_SAMPLESPERPIXEL, &r->samples);
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_SAMPLEFORMAT, &r->sample_format);
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_PLANARCONFIG, &r->planes);
    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_COMPRESSION, &r->compression);
    /* The JPEG codec converts to RGB by itself when asked to. */
    if (r->photometric == PHOTOMETRIC_YCBCR &&
        r->compression == COMPRESSION_JPEG &&
        TIFFSetField(r->tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB))
        r->photometric = PHOTOMETRIC_RGB;
    r->out->bits = r->bits;
    r->out->is_float = r->sample_format == SAMPLEFORMAT_IEEEFP;
    if (TIFFGetField(r->tiff, TIFFTAG_ICCPROFILE, &profile_bytes, &profile) ==
            1 &&
        profile)
        return otx_picture_keep_icc(r->run, profile, profile_bytes, r->out);
    return OSDTEX_OK;
}

static void
note_orientation(const reader *r)
{
    uint16_t orientation = ORIENTATION_TOPLEFT;

    TIFFGetFieldDefaulted(r->tiff, TIFFTAG_ORIENTATION, &orientation);
    otx_exif_note_orientation(r->run, r->path, "TIFF", orientation);
}

static bool
is_gray(const reader *r)
{
    return r->photometric == PHOTOMETRIC_MINISBLACK ||
           r->photometric == PHOTOMETRIC_MINISWHITE;
}

/* ---- the direct path --------------------------------------------------- */

static bool
is_direct(const reader *r)
{
    if (r->sample_format == SAMPLEFORMAT_IEEEFP)
        return r->bits == 16 || r->bits == 32 || r->bits == 64;
    return r->bits == 8 || r->bits == 16 || r->bits == 32;
}

static double
decode(const reader *r, const uint8_t *at)
{
    const bool is_float = r->out->is_float;
    uint16_t word;
    uint32_t quad;
    float single;
    double value;

    switch (r->bits)
    {
    case 8:
        return at[0] / 255.0;
    case 16:
        memcpy(&word, at, sizeof word);
        return is_float ? (double)imath_half_to_float(word) : word / 65535.0;
    case 32:
        memcpy(&quad, at, sizeof quad);
        memcpy(&single, at, sizeof single);
        return is_float ? (double)single : quad / 4294967295.0;
    default:
        memcpy(&value, at, sizeof value);
        return value;
    }
}

/* Puts one sample of a texel where it belongs. */
static void
store_sample(const reader *r, float *texel, int32_t sample, double value)
{
    if (sample == r->alpha_sample)
        texel[3] = (float)value;
    else if (!is_gray(r) && sample < 3)
        texel[sample] = (float)value;
    else if (is_gray(r) && sample == 0)
    {
        if (r->photometric == PHOTOMETRIC_MINISWHITE)
            value = 1.0 - value;
        texel[0] = texel[1] = texel[2] = (float)value;
    }
}

static void
store_block(const reader *r, const block *b)
{
    const size_t bytes = r->bits / 8;
    const int32_t first = b->sample == IGNORED ? 0 : b->sample;
    const int32_t count = b->sample == IGNORED ? r->samples : 1;

    for (int32_t y = 0; y < b->height; ++y)
    {
        const uint8_t *at = b->bytes + (size_t)y * b->row_bytes;
        float *texel =
            otx_picture_row(r->out, b->y + y) + b->x * r->out->image.channels;

        for (int32_t x = 0; x < b->width; ++x)
        {
            for (int32_t s = 0; s < count; ++s, at += bytes)
                store_sample(r, texel, first + s, decode(r, at));
            texel += r->out->image.channels;
        }
    }
}

/* Bytes for one scanline or tile, refused when absurd or less than the samples
 * to be taken from it. */
static otx_status
alloc_block(const reader *r, uint64_t bytes, uint64_t needed, uint8_t **out)
{
    if (bytes < needed)
        return reader_failed(r);
    if (bytes > MAX_BLOCK_BYTES)
        return otx_fail(
            r->run, OSDTEX_ERROR_LIMIT, "picture", otx_where_file(r->path),
            "the TIFF has strips or tiles of %llu bytes; write it with smaller "
            "ones",
            (unsigned long long)bytes);
    *out = otx_arena_zalloc(r->run->scratch, bytes, 1);
    return otx_run_ok(r->run);
}

static otx_status
read_rows(const reader *r, int32_t sample, size_t texel_bytes)
{
    const uint64_t row_bytes = TIFFScanlineSize64(r->tiff);
    block b = {NULL, row_bytes, 0, 0, (int32_t)r->width, 1, sample};
    uint8_t *bytes = NULL;

    OTX_TRY(alloc_block(r, row_bytes, r->width * texel_bytes, &bytes));
    b.bytes = bytes;
    for (; b.y < (int32_t)r->height; ++b.y)
    {
        if (TIFFReadScanline(
                r->tiff, bytes, (uint32_t)b.y,
                (uint16_t)(sample == IGNORED ? 0 : sample)) < 0)
            return reader_failed(r);
        store_block(r, &b);
    }
    return OSDTEX_OK;
}

static otx_status
read_tiles(const reader *r, int32_t sample, size_t texel_bytes)
{
    uint32_t width = 0, height = 0;
    uint8_t *bytes = NULL;
    block b = {.sample = sample};

    TIFFGetField(r->tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(r->tiff, TIFFTAG_TILELENGTH, &height);
    if (width == 0 || height == 0 || width > MAX_BLOCK_BYTES ||
        height > MAX_BLOCK_BYTES)
        return reader_failed(r);
    b.row_bytes = width * texel_bytes;
    OTX_TRY(alloc_block(
        r, TIFFTileSize64(r->tiff), (uint64_t)b.row_bytes * height, &bytes));
    b.bytes = bytes;
    for (uint32_t y = 0; y < r->height; y += height)
        for (uint32_t x = 0; x < r->width; x += width)
        {
            if (TIFFReadTile(
                    r->tiff, bytes, x, y, 0,
                    (uint16_t)(sample == IGNORED ? 0 : sample)) < 0)
                return reader_failed(r);
            b.x = (int32_t)x;
            b.y = (int32_t)y;
            b.width = (int32_t)(r->width - x < width ? r->width - x : width);
            b.height =
                (int32_t)(r->height - y < height ? r->height - y : height);
            store_block(r, &b);
        }
    return OSDTEX_OK;
}

static otx_status
read_plane(const reader *r, int32_t sample)
{
    const size_t texel_bytes =
        (size_t)(r->bits / 8) * (sample == IGNORED ? r->samples : 1u);

    return TIFFIsTiled(r->tiff) ? read_tiles(r, sample, texel_bytes)
                                : read_rows(r, sample, texel_bytes);
}

static otx_status
read_direct(reader *r)
{
    const int32_t colors = is_gray(r) ? 1 : 3;

    if (r->samples < colors)
        return reader_failed(r);
    find_alpha(r, colors);
    r->out->is_gray = colors == 1;
    OTX_TRY(otx_picture_create(
        r->run, r->path, r->width, r->height,
        r->alpha_sample == IGNORED ? 3 : 4, r->out));
    if (r->planes != PLANARCONFIG_SEPARATE)
        return read_plane(r, IGNORED);
    for (int32_t s = 0; s < colors; ++s)
        OTX_TRY(read_plane(r, s));
    return r->alpha_sample == IGNORED ? OSDTEX_OK
                                      : read_plane(r, r->alpha_sample);
}

/* ---- the path through 8-bit RGBA --------------------------------------- */

/* Rows as stored: `raster` has the first stored row first. */
static bool
fill_raster(const reader *r, uint32_t *raster, bool *has_alpha)
{
    TIFFRGBAImage rgba;
    char reason[1024];
    bool ok;

    if (!TIFFRGBAImageOK(r->tiff, reason) ||
        !TIFFRGBAImageBegin(&rgba, r->tiff, 1, reason))
        return false;
    rgba.req_orientation = rgba.orientation;
    *has_alpha = rgba.alpha != 0;
    ok = TIFFRGBAImageGet(&rgba, raster, r->width, r->height) != 0;
    TIFFRGBAImageEnd(&rgba);
    return ok;
}

static otx_status
read_rgba(reader *r)
{
    uint32_t *raster =
        OTX_ZNEW(r->run->scratch, uint32_t, (size_t)r->width * r->height);
    bool has_alpha = false;

    OTX_TRY(otx_run_ok(r->run));
    if (!fill_raster(r, raster, &has_alpha))
        return reader_failed(r);
    OTX_TRY(otx_picture_create(
        r->run, r->path, r->width, r->height, has_alpha ? 4 : 3, r->out));
    r->out->alpha_is_premultiplied = has_alpha;
    r->out->is_gray = is_gray(r);
    for (int32_t y = 0; y < r->out->image.height; ++y)
    {
        float *texel = otx_picture_row(r->out, y);

        for (uint32_t x = 0; x < r->width; ++x)
        {
            const uint32_t packed = raster[(size_t)y * r->width + x];

            for (int32_t c = 0; c < r->out->image.channels; ++c)
                *texel++ = (float)((packed >> (8 * c) & 0xFF) / 255.0);
        }
    }
    return OSDTEX_OK;
}

/* ------------------------------------------------------------------------ */

static otx_status
check_support(const reader *r)
{
    const bool color = r->photometric == PHOTOMETRIC_RGB ||
                       r->photometric == PHOTOMETRIC_PALETTE ||
                       r->photometric == PHOTOMETRIC_YCBCR;

    if (!color && !is_gray(r))
        return otx_fail(
            r->run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(r->path),
            "the TIFF is neither grey nor RGB (photometric %d, as for CMYK, "
            "Lab or LogLuv); convert it to RGB",
            r->photometric);
    if (r->sample_format != SAMPLEFORMAT_UINT &&
        r->sample_format != SAMPLEFORMAT_IEEEFP &&
        r->sample_format != SAMPLEFORMAT_VOID)
        return otx_fail(
            r->run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(r->path),
            "the TIFF holds signed or complex numbers; convert it to unsigned "
            "or float");
    return OSDTEX_OK;
}

static otx_status
read_any(reader *r)
{
    const bool needs_rgba = r->photometric == PHOTOMETRIC_PALETTE ||
                            r->photometric == PHOTOMETRIC_YCBCR ||
                            (r->bits < 8 && !r->out->is_float);

    if (needs_rgba)
        return read_rgba(r);
    if (!is_direct(r))
        return otx_fail(
            r->run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(r->path),
            "the TIFF has %d bits a channel; convert it to 8 or 16 bits or "
            "float",
            r->bits);
    return read_direct(r);
}

otx_status
otx_tiff_file_read(otx_run *run, const char *path, otx_picture *out)
{
    reader *r = OTX_ZNEW(run->scratch, reader, 1);

    if (!r || !otx_arena_defer(run->scratch, reader_close, r))
        return otx_fail_memory(run, "picture");
    r->run = run;
    r->path = path;
    r->out = out;
    OTX_TRY(reader_open(r));
    OTX_TRY(reader_tags(r));
    OTX_TRY(check_support(r));
    OTX_TRY(otx_picture_check_size(run, path, r->width, r->height));
    note_orientation(r);
    OTX_TRY(read_any(r));
    /* libtiff goes on after some errors; a picture with holes is none. */
    return r->error[0] == '\0' ? OSDTEX_OK : reader_failed(r);
}

/* test_tiff_file.c -- TIFF files made here with libtiff: depths, planes,
 * tiles, photometrics, and what is refused. */
#include "picture_support.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <tiffio.h>

enum
{
    WIDTH = 37,
    HEIGHT = 29,
    TILE = 16
};

typedef struct tiff_kind
{
    int bits;
    int format;
    int samples; /* 1 grey, 2 + alpha, 3 RGB, 4 + alpha */
    int photometric;
    int compression;
    bool planar;
    bool tiled;
    const char *mode;
} tiff_kind;

/* Value of a stored sample, in [0, 1], exact in 8 bits. */
static double
value_of(int x, int y_down, int sample)
{
    return (x * 3 + y_down * 5 + sample * 17) % 256 / 255.0;
}

/* The value as a number of the file's kind; returns its bytes. */
static int
store(const tiff_kind *kind, double value, uint8_t *at)
{
    const uint16_t word = (uint16_t)(value * 65535.0 + 0.5);
    const uint16_t half = imath_float_to_half((float)value);
    const uint32_t quad = (uint32_t)(value * 4294967295.0 + 0.5);
    const float single = (float)value;
    const bool is_float = kind->format == SAMPLEFORMAT_IEEEFP;

    if (kind->bits == 8)
        at[0] = (uint8_t)(value * 255.0 + 0.5);
    else if (kind->bits == 16)
        memcpy(at, is_float ? &half : &word, 2);
    else if (kind->bits == 32)
        memcpy(at, is_float ? (const void *)&single : &quad, 4);
    else
        memcpy(at, &value, 8);
    return kind->bits / 8;
}

/* Fills a rectangle of the picture with one plane, or all when plane is -1. */
static void
fill(
    const tiff_kind *kind, uint8_t *out, int x0, int y0, int width, int height,
    int plane)
{
    for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x)
            for (int s = 0; s < kind->samples; ++s)
                if (plane < 0 || s == plane)
                    out += store(kind, value_of(x, y, s), out);
}

static void
write_plane(TIFF *tiff, const tiff_kind *kind, int plane)
{
    const uint16_t sample = (uint16_t)(plane < 0 ? 0 : plane);
    uint8_t bytes[TILE * TILE * 4 * 8];

    if (!kind->tiled)
        for (int y = 0; y < HEIGHT; ++y)
        {
            fill(kind, bytes, 0, y, WIDTH, 1, plane);
            assert_true(
                TIFFWriteScanline(tiff, bytes, (uint32_t)y, sample) >= 0);
        }
    else
        for (int y = 0; y < HEIGHT; y += TILE)
            for (int x = 0; x < WIDTH; x += TILE)
            {
                fill(kind, bytes, x, y, TILE, TILE, plane);
                assert_true(
                    TIFFWriteTile(
                        tiff, bytes, (uint32_t)x, (uint32_t)y, 0, sample) >= 0);
            }
}

static void
write_tiff(const char *path, const tiff_kind *kind)
{
    TIFF *tiff = TIFFOpen(path, kind->mode ? kind->mode : "w");
    const uint16_t extra = EXTRASAMPLE_UNASSALPHA;

    assert_non_null(tiff);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, WIDTH);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, HEIGHT);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kind->bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, kind->samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, kind->format);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, kind->photometric);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind->compression);
    TIFFSetField(
        tiff, TIFFTAG_PLANARCONFIG,
        kind->planar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    if (kind->samples % 2 == 0 && kind->photometric != PHOTOMETRIC_SEPARATED)
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &extra);
    if (kind->tiled)
    {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, TILE);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, TILE);
    }
    else
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
    for (int plane = 0; kind->planar && plane < kind->samples; ++plane)
        write_plane(tiff, kind, plane);
    if (!kind->planar)
        write_plane(tiff, kind, -1);
    TIFFClose(tiff);
}

static void
expect_picture(const otx_picture *picture, const tiff_kind *kind)
{
    const bool gray = kind->samples < 3;
    const double tolerance =
        kind->bits == 16 && kind->format == SAMPLEFORMAT_IEEEFP ? 1e-3 : 1e-7;

    assert_int_equal(picture->kind, OTX_PICTURE_TIFF);
    assert_int_equal(picture->bits, kind->bits);
    assert_int_equal(picture->is_gray, gray);
    assert_int_equal(picture->is_float, kind->format == SAMPLEFORMAT_IEEEFP);
    assert_int_equal(picture->has_alpha, kind->samples % 2 == 0);
    assert_false(picture->alpha_is_premultiplied);
    assert_int_equal(picture->image.width, WIDTH);
    assert_int_equal(picture->image.height, HEIGHT);
    for (int y = 0; y < HEIGHT; ++y)
        for (int i = 0; i < WIDTH * picture->image.channels; ++i)
        {
            const int x = i / picture->image.channels;
            const int c = i % picture->image.channels;
            const int sample = c == 3 ? kind->samples - 1 : gray ? 0 : c;
            double value = value_of(x, y, sample);

            if (kind->photometric == PHOTOMETRIC_MINISWHITE && c < 3)
                value = 1.0 - value;
            assert_float_equal(
                otx_picture_row(picture, y)[i], value, tolerance);
        }
}

static void
test_every_layout_is_read(void **state)
{
    static const struct
    {
        int bits, format;
    } depths[] = {{8, SAMPLEFORMAT_UINT},    {16, SAMPLEFORMAT_UINT},
                  {32, SAMPLEFORMAT_UINT},   {16, SAMPLEFORMAT_IEEEFP},
                  {32, SAMPLEFORMAT_IEEEFP}, {64, SAMPLEFORMAT_IEEEFP}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");

    (void)state;
    for (int i = 0; i < 6 * 4 * 2 * 2; ++i)
    {
        const int samples = i / 6 % 4 + 1;
        const tiff_kind kind = {
            .bits = depths[i % 6].bits,
            .format = depths[i % 6].format,
            .samples = samples,
            .photometric =
                samples < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB,
            .compression = i % 2 ? COMPRESSION_LZW : COMPRESSION_NONE,
            .planar = i / 24 % 2,
            .tiled = i / 48};
        otx_picture picture;

        write_tiff(path, &kind);
        picture = test_read(run, path);
        expect_picture(&picture, &kind);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_variants_are_read(void **state)
{
    const tiff_kind kinds[] = {
        {8, SAMPLEFORMAT_UINT, 1, PHOTOMETRIC_MINISWHITE, COMPRESSION_NONE,
         false, false, NULL},
        {16, SAMPLEFORMAT_UINT, 3, PHOTOMETRIC_RGB, COMPRESSION_ADOBE_DEFLATE,
         false, false, "wb"},
        {32, SAMPLEFORMAT_IEEEFP, 4, PHOTOMETRIC_RGB, COMPRESSION_PACKBITS,
         false, true, "wb8"},
        {16, SAMPLEFORMAT_UINT, 3, PHOTOMETRIC_RGB, COMPRESSION_LZW, false,
         false, "wl8"}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");

    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
    {
        otx_picture picture;

        write_tiff(path, &kinds[i]);
        picture = test_read(run, path);
        expect_picture(&picture, &kinds[i]);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* Through libtiff's own conversion to RGBA. */
static void
test_palettes_and_few_bits_are_read(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");
    uint16_t red[4] = {0, 65535, 0, 65535}, green[4] = {0, 0, 65535, 65535},
             blue[4] = {0, 0, 0, 32896};
    const uint8_t row[1] = {0x1B}; /* 0 1 2 3 */
    const float expected[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 128 / 255.0f};
    otx_picture picture;
    TIFF *tiff = TIFFOpen(path, "w");

    (void)state;
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 4);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 2);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 2);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_PALETTE);
    TIFFSetField(tiff, TIFFTAG_COLORMAP, red, green, blue);
    for (uint32_t y = 0; y < 2; ++y)
    {
        uint8_t bytes[1] = {y == 0 ? row[0] : 0};

        TIFFWriteScanline(tiff, bytes, y, 0);
    }
    TIFFClose(tiff);
    picture = test_read(run, path);
    assert_int_equal(picture.image.channels, 3);
    for (int i = 0; i < 12; ++i)
    {
        assert_float_equal(otx_picture_row(&picture, 0)[i], expected[i], 1e-6);
        assert_float_equal(otx_picture_row(&picture, 1)[i], 0.0, 0.0);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_what_is_not_read_is_said(void **state)
{
    const struct
    {
        tiff_kind kind;
        const char *word;
    } cases[] = {
        {{8, SAMPLEFORMAT_UINT, 4, PHOTOMETRIC_SEPARATED, COMPRESSION_NONE,
          false, false, NULL},
         "CMYK"},
        {{16, SAMPLEFORMAT_INT, 3, PHOTOMETRIC_RGB, COMPRESSION_NONE, false,
          false, NULL},
         "signed"},
        {{8, SAMPLEFORMAT_UINT, 3, PHOTOMETRIC_CIELAB, COMPRESSION_NONE, false,
          false, NULL},
         "Lab"}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        char name[16];
        otx_picture picture;

        snprintf(name, sizeof name, "%zu.tif", i);
        write_tiff(test_path(&folder, name), &cases[i].kind);
        assert_int_equal(
            otx_picture_read(run, test_path(&folder, name), &picture),
            OSDTEX_ERROR_SUPPORT);
        assert_non_null(strstr(test_last_message(run), cases[i].word));
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* Claims more than is read; the pixels are not there. */
static void
test_sizes_are_limited_before_memory_is_taken(void **state)
{
    static const uint32_t claims[][2] = {
        {33000, 1}, {16384, 4097}, {2000000000u, 40}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.tif");

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        TIFF *tiff = TIFFOpen(path, "w");
        otx_picture picture;

        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, claims[i][0]);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, claims[i][1]);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 1);
        TIFFWriteRawStrip(tiff, 0, "x", 1);
        TIFFClose(tiff);
        assert_int_equal(
            otx_picture_read(run, path, &picture), OSDTEX_ERROR_LIMIT);
    }
    assert_true(otx_allocator_peak(run->allocator) < 10u << 20);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* libtiff writes the directory last, and no padding after it. */
static void
test_cut_files_are_refused(void **state)
{
    const tiff_kind kind = {
        .bits = 8,
        .format = SAMPLEFORMAT_UINT,
        .samples = 3,
        .photometric = PHOTOMETRIC_RGB,
        .compression = COMPRESSION_LZW};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();

    (void)state;
    write_tiff(test_path(&folder, "a.tif"), &kind);
    test_prefixes_fail(run, &folder, test_path(&folder, "a.tif"), 64);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* A directory that lies about the size of what follows. */
static void
test_damaged_files_do_no_harm(void **state)
{
    const tiff_kind kind = {
        .bits = 16,
        .format = SAMPLEFORMAT_UINT,
        .samples = 4,
        .photometric = PHOTOMETRIC_RGB,
        .compression = COMPRESSION_PACKBITS,
        .tiled = true};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    size_t bytes;
    uint8_t *data;

    (void)state;
    write_tiff(test_path(&folder, "a.tif"), &kind);
    data = test_read_bytes(run, test_path(&folder, "a.tif"), &bytes);
    for (uint64_t i = 0; i < 300; ++i)
    {
        /* Most of them in the directory, at the end. */
        const size_t range = i % 8 ? 400 : bytes;
        const size_t at = bytes - 1 - otx_random_bits(5, 0, i) % range;
        const uint8_t kept = data[at];
        const otx_arena_mark mark = otx_arena_here(run->arena);
        otx_picture picture;

        data[at] = (uint8_t)otx_random_bits(6, 0, i);
        test_write_bytes(test_path(&folder, "cut"), data, bytes);
        otx_picture_read(run, test_path(&folder, "cut"), &picture);
        data[at] = kept;
        otx_arena_release(run->arena, mark);
    }
    assert_true(otx_allocator_peak(run->allocator) < (size_t)2 << 30);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_layout_is_read),
        cmocka_unit_test(test_variants_are_read),
        cmocka_unit_test(test_palettes_and_few_bits_are_read),
        cmocka_unit_test(test_what_is_not_read_is_said),
        cmocka_unit_test(test_sizes_are_limited_before_memory_is_taken),
        cmocka_unit_test(test_cut_files_are_refused),
        cmocka_unit_test(test_damaged_files_do_no_harm),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_exr_read.c -- EXR files as other programs write them. */
#include "exr_support.h"

static void
test_every_layout_is_read(void **state)
{
    static const struct
    {
        const char *arguments;
        double tolerance;
    } cases[] = {
        {"--compression none", 0.0},
        {"--compression rle", 0.0},
        {"--compression zips", 0.0},
        {"--compression zip", 0.0},
        {"--compression piz", 0.0},
        {"--compression pxr24", 1e-4},
        {"-d half --compression none", 1e-3},
        {"-d half --compression piz", 1e-3},
        {"-d half --compression pxr24", 1e-3},
        {"-d half --compression b44", 0.2},
        {"-d half --compression b44a", 0.2},
        {"-d float --tile 32 16 --compression none", 0.0},
        {"-d float --tile 32 16 --compression piz", 0.0},
        {"-d float --tile 128 128 --compression zip", 0.0},
        {"-d half --tile 64 64 --compression pxr24", 1e-3},
    };
    const size_t case_count = sizeof cases / sizeof *cases;
    char arguments[4096] = "";
    size_t used = 0;
    const fixture *f = *state;

    /* One process: starting it costs more than the work. */
    for (size_t i = 0; i < case_count; ++i)
        used += (size_t)snprintf(
            arguments + used, sizeof arguments - used, " a.exr %s -o %zu.exr",
            cases[i].arguments, i);
    make(f, arguments);
    for (size_t i = 0; i < case_count; ++i)
    {
        char name[32];
        otx_picture picture;

        snprintf(name, sizeof name, "%zu.exr", i);
        picture = read_file(f, name);
        test_same_image(&picture.image, &f->image, cases[i].tolerance);
    }
}

static void
test_first_row_of_the_file_is_on_top(void **state)
{
    const fixture *f = *state;
    const otx_picture picture = made(
        f, "--create 4x2 3 --box:color=1,0.5,0.25:fill=1 0,0,0,0 "
           "-d half");
    assert_float_equal(otx_image_at(&picture.image, 0, 1)[0], 1.0, 0.0);
    assert_float_equal(otx_image_at(&picture.image, 0, 1)[2], 0.25, 0.0);
    assert_float_equal(otx_image_at(&picture.image, 0, 0)[0], 0.0, 0.0);
    assert_float_equal(otx_image_at(&picture.image, 1, 1)[0], 0.0, 0.0);
}

static void
test_level_0_of_a_mip_map_is_read(void **state)
{
    const fixture *f = *state;
    otx_picture picture;

    make(f, "a.exr -d float -otex b.exr");
    picture = read_file(f, "b.exr");
    test_same_image(&picture.image, &f->image, 0.0);
}

static void
test_luminance_becomes_gray(void **state)
{
    const fixture *f = *state;
    const otx_picture picture = made(f, "a.exr --ch G --chnames Y");
    assert_true(picture.is_gray);
    for (int32_t i = 0; i < 100 * 70 * 3; ++i)
        assert_float_equal(
            picture.image.pixels[i], f->image.pixels[i / 3 * 3 + 1], 0.0);
}

static void
test_alpha_is_kept(void **state)
{
    const fixture *f = *state;
    const otx_picture picture = made(f, "a.exr --ch R,G,B,A=0.5");
    assert_true(picture.has_alpha);
    assert_true(picture.alpha_is_premultiplied);
    assert_int_equal(picture.image.channels, 4);
    assert_float_equal(picture.image.pixels[3], 0.5, 0.0);
    assert_float_equal(picture.image.pixels[0], f->image.pixels[0], 0.0);
}

/* As OpenEXR itself decodes them: scanlines and tiles, half and float, with
 * alpha, in a part of several; and what is cut off is an error. */
static void
test_dwa_is_read(void **state)
{
    static const char *const cases[] = {
        "a.exr -d half --compression dwaa",
        "a.exr -d float --compression dwab",
        "a.exr -d half --tile 32 32 --compression dwab",
        "a.exr --ch R,G,B,A=0.5 -d half --compression dwaa:300",
        "a.exr --ch G --chnames Y -d half --compression dwaa",
        "a.exr --fullsize 40x30+10+5 -d half --compression dwaa",
    };
    const fixture *f = *state;
    size_t bytes;
    uint8_t *data;

    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        char arguments[512];
        otx_picture ours, theirs;

        snprintf(
            arguments, sizeof arguments,
            "%s -o dwa%zu.exr dwa%zu.exr -d float --compression zip --scanline "
            "-o zip%zu.exr",
            cases[i], i, i, i);
        make(f, arguments);
        snprintf(arguments, sizeof arguments, "dwa%zu.exr", i);
        ours = read_file(f, arguments);
        snprintf(arguments, sizeof arguments, "zip%zu.exr", i);
        theirs = read_file(f, arguments);
        test_same_image(&ours.image, &theirs.image, 0.0);
    }
    data = test_read_bytes(f->run, test_path(&f->folder, "dwa0.exr"), &bytes);
    test_write_bytes(test_path(&f->folder, "cut.exr"), data, bytes - 200);
    refuse(f, "cut.exr", OSDTEX_ERROR_FORMAT, "damaged or cut short");
}

void write_chroma(
    const char *path, const float *rgb, int width, int height, bool alpha);

void join_chroma(const char *path, const char *single);

/* A smooth picture is the same again but for the rounding of half, and the same
 * to the bit as one of several parts. */
static void
test_luminance_with_chroma_is_read(void **state)
{
    enum
    {
        W = 38,
        H = 22
    };
    const fixture *f = *state;
    float *rgb = OTX_NEW(f->run->arena, float, 3 * W * H);

    for (int32_t i = 0; i < W * H; ++i)
    {
        rgb[3 * i] = 0.2f + 0.6f * (float)(i % W) / W;
        rgb[3 * i + 1] = 0.2f + 0.6f * (float)(i / W) / H;
        rgb[3 * i + 2] = 0.9f - 0.5f * (float)(i % W) / W;
    }
    for (int alpha = 0; alpha < 2; ++alpha)
    {
        otx_picture picture;

        write_chroma(test_path(&f->folder, "yc.exr"), rgb, W, H, alpha == 1);
        picture = read_file(f, "yc.exr");
        assert_int_equal(picture.image.channels, 3 + alpha);
        assert_false(picture.is_gray);
        for (int32_t y = 0; y < H; ++y)
            for (int32_t x = 0; x < W; ++x)
                for (int32_t c = 0; c < 3; ++c)
                    assert_float_equal(
                        otx_image_at(&picture.image, x, H - 1 - y)[c],
                        rgb[3 * (y * W + x) + c], 0.05);

        otx_picture second;

        join_chroma(
            test_path(&f->folder, "parts.exr"),
            test_path(&f->folder, "yc.exr"));
        second = read_file(f, "parts.exr");
        test_same_image(&picture.image, &second.image, 0.0);
    }
}

/* Display windows: crops of what is stored, and what is stored being less. */
static void
test_picture_is_what_is_stored_and_shown(void **state)
{
    const fixture *f = *state;
    otx_picture picture = made(f, "a.exr --fullsize 40x30+10+5");
    assert_int_equal(picture.image.width, 40);
    assert_int_equal(picture.image.height, 30);
    for (int32_t y = 0; y < 30; ++y)
        assert_memory_equal(
            otx_picture_row(&picture, y),
            otx_image_at(&f->image, 10, 70 - 1 - 5 - y),
            40 * 3 * sizeof(float));

    picture = made(f, "a.exr --fullsize 300x300-20-20");
    test_same_image(&picture.image, &f->image, 0.0);
    assert_int_equal(picture.display_window.x_min, -20);
    assert_int_equal(picture.data_window.x_max, 99);
    assert_non_null(strstr(test_last_message(f->run), "(0, 0) to (99, 69)"));
}

static void
test_what_is_not_read_is_said(void **state)
{
    const fixture *f = *state;

    make(f, "a.exr --ch R,G --chnames depth,mask.R -o d.exr");
    refuse(f, "d.exr", OSDTEX_ERROR_SUPPORT, "depth, mask.R");
    make(f, "a.exr --fullsize 10x10+500+500 -o e.exr");
    refuse(f, "e.exr", OSDTEX_ERROR_FORMAT, "display window");
}

/* Makes a header claim a size; the pixels are not there. */
static void
claim_size(const fixture *f, const char *name, int32_t width, int32_t height)
{
    static const char attribute[] = "dataWindow\0box2i\0\x10\0\0";
    const int32_t maxima[2] = {width - 1, height - 1};
    size_t bytes;
    uint8_t *data =
        test_read_bytes(f->run, test_path(&f->folder, "a.exr"), &bytes);
    uint8_t *at = memmem(data, bytes, attribute, sizeof attribute);

    assert_non_null(at);
    memcpy(at + sizeof attribute + 8, maxima, sizeof maxima);
    test_write_bytes(test_path(&f->folder, name), data, bytes);
}

static void
test_sizes_are_limited_before_memory_is_taken(void **state)
{
    const fixture *f = *state;

    make(f, "--create 33000x1 3 -d half -o b.exr");
    refuse(f, "b.exr", OSDTEX_ERROR_LIMIT, "33000 x 1");
    /* The core finds by itself that such a file would have to be longer. */
    claim_size(f, "c.exr", 2000000000, 2000000000);
    refuse(f, "c.exr", OSDTEX_ERROR_FORMAT, "damaged");
    assert_true(otx_allocator_peak(f->run->allocator) < 100u << 20);
}

/* Our writer refuses such values, so the bytes of an uncompressed file are
 * patched: 42 becomes infinite, 43 not a number. */
static void
patch(uint8_t *data, size_t bytes)
{
    const float from[2] = {42.0f, 43.0f};
    const float to[2] = {INFINITY, NAN};

    for (size_t i = 0; i + sizeof(float) <= bytes; ++i)
        for (int k = 0; k < 2; ++k)
            if (memcmp(data + i, &from[k], sizeof(float)) == 0)
                memcpy(data + i, &to[k], sizeof(float));
}

static void
test_first_pixel_that_is_not_finite_is_named(void **state)
{
    const fixture *f = *state;
    otx_exr_options options = otx_exr_options_default();
    size_t bytes;
    uint8_t *data;

    options.full_float = true;
    options.tiled = false;
    otx_image_at(&f->image, 30, 70 - 1 - 20)[1] = 42.0f;
    otx_image_at(&f->image, 2, 70 - 1 - 21)[0] = 43.0f;
    assert_int_equal(
        test_write_exr(
            f->run, test_path(&f->folder, "a.exr"), &f->image, &options),
        OSDTEX_OK);
    make(f, "a.exr --compression none -o b.exr");
    data = test_read_bytes(f->run, test_path(&f->folder, "b.exr"), &bytes);
    patch(data, bytes);
    test_write_bytes(test_path(&f->folder, "b.exr"), data, bytes);
    refuse(
        f, "b.exr", OSDTEX_ERROR_NUMERIC,
        "pixel (30, 20), counted from the top-left corner, is infinite in "
        "channel G");
}

static void
test_non_finite_photograph(void **state)
{
    const char *path = SHARED_DATA "/textures/BrightRingsNanInf.exr";
    otx_run *run;
    otx_picture picture;

    (void)state;
    if (access(path, R_OK) != 0)
    {
        print_message("skipped: %s is absent\n", path);
        skip();
    }
    run = test_run_create();
    assert_int_equal(
        otx_picture_read(run, path, &picture), OSDTEX_ERROR_NUMERIC);
    assert_non_null(strstr(
        test_last_message(run), "pixel (320, 320), counted from the top-left "
                                "corner, is not a number in channel R"));
    test_run_destroy(run);
}

static void
test_cut_files_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 9, 20, 3);
    otx_exr_options options = otx_exr_options_default();

    (void)state;
    for (int tiled = 0; tiled < 2; ++tiled)
    {
        options.tiled = tiled;
        assert_int_equal(
            test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
            OSDTEX_OK);
        /* Levels below 0 come last and are not read. */
        test_prefixes_fail(
            run, &folder, test_path(&folder, "a.exr"), tiled ? 1200 : 0);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(test_every_layout_is_read),
        TEST(test_first_row_of_the_file_is_on_top),
        TEST(test_level_0_of_a_mip_map_is_read),
        TEST(test_luminance_becomes_gray),
        TEST(test_alpha_is_kept),
        TEST(test_dwa_is_read),
        TEST(test_luminance_with_chroma_is_read),
        TEST(test_picture_is_what_is_stored_and_shown),
        TEST(test_what_is_not_read_is_said),
        TEST(test_sizes_are_limited_before_memory_is_taken),
        TEST(test_first_pixel_that_is_not_finite_is_named),
        cmocka_unit_test(test_non_finite_photograph),
        cmocka_unit_test(test_cut_files_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_exr_write.c -- EXR files: round trips, mip levels as OpenImageIO sees
 * them, header, byte identity, and refusals. */
#include "picture_support.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

#include "image/pyramid.h"

static const int32_t sizes[][2] = {
    {1, 1}, {2, 1}, {64, 64}, {65, 63}, {7, 129}, {300, 200}};

enum
{
    SIZE_COUNT = sizeof sizes / sizeof *sizes
};

static void
round_to_half(otx_image *image)
{
    const int32_t count = image->width * image->height * image->channels;

    for (int32_t i = 0; i < count; ++i)
        image->pixels[i] =
            imath_half_to_float(imath_float_to_half(image->pixels[i]));
}

static otx_exr_options
options_of(bool tiled, bool full_float)
{
    otx_exr_options options = otx_exr_options_default();

    options.tiled = tiled;
    options.full_float = full_float;
    return options;
}

static void
test_pixels_come_back(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.exr");

    (void)state;
    for (int i = 0; i < SIZE_COUNT * 8; ++i)
    {
        const int32_t *size = sizes[i / 8];
        const otx_exr_options options = options_of(i & 1, i & 2);
        otx_image image = test_noise(run, size[0], size[1], i & 4 ? 4 : 3);
        otx_picture picture;

        assert_int_equal(
            test_write_exr(run, path, &image, &options), OSDTEX_OK);
        picture = test_read(run, path);
        if (!options.full_float)
            round_to_half(&image);
        test_same_image(&picture.image, &image, 0.0);
        assert_int_equal(picture.kind, OTX_PICTURE_EXR);
        assert_int_equal(picture.bits, options.full_float ? 32 : 16);
        assert_int_equal(picture.has_alpha, image.channels == 4);
        assert_true(picture.is_float);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* Takes all levels of a.exr out, as 0.exr, 1.exr, ..., with one process. */
static void
extract_levels(const test_folder *folder, int32_t count)
{
    char command[2048] = "oiiotool";
    size_t used = strlen(command);

    for (int32_t l = 0; l < count; ++l)
        used += (size_t)snprintf(
            command + used, sizeof command - used,
            " a.exr --selectmip %d -o %d.exr", l, l);
    assert_int_equal(test_shell(folder, command), 0);
}

/* The levels of a file we wrote, each taken out by oiiotool, are the levels of
 * our pyramid rounded to half. */
static void
test_oiio_reads_every_level(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_exr_options options = otx_exr_options_default();

    (void)state;
    if (!test_has_tool("oiiotool"))
    {
        print_message("skipped: oiiotool is not installed\n");
        skip();
    }
    for (int s = 0; s < SIZE_COUNT; ++s)
    {
        const otx_image image =
            test_noise(run, sizes[s][0], sizes[s][1], s % 2 ? 4 : 3);
        otx_pyramid pyramid;

        assert_int_equal(
            test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
            OSDTEX_OK);
        assert_int_equal(
            otx_pyramid_build(run, run->arena, &image, &pyramid), OSDTEX_OK);
        extract_levels(&folder, pyramid.count);
        for (int32_t l = 0; l < pyramid.count; ++l)
        {
            char name[32];
            otx_picture level;

            snprintf(name, sizeof name, "%d.exr", l);
            level = test_read(run, test_path(&folder, name));
            round_to_half(&pyramid.levels[l]);
            test_same_image(&level.image, &pyramid.levels[l], 0.0);
        }
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
assert_exrheader_says(otx_run *run, const test_folder *folder)
{
    static const char *const expected[] = {
        "type (type string): \"tiledimage\"",
        "compression (type compression): zip, multi-scanline blocks",
        "tile size 64 by 64 pixels",
        "level sizes rounded down",
        "wrapmodes (type string): \"periodic,clamp\"",
        "textureformat (type string): \"Plain Texture\"",
        "Software (type string): \"osdtex ",
        "oiio:ColorSpace (type string): \"ACEScg\"",
        "colorInteropID (type string): \"lin_ap1_scene\"",
        "osdtex:seed (type int): 7",
        "osdtex:scale (type float): 0.5",
        "osdtex:a_name_of_more_than_31_bytes (type string): \"x\""};
    const char *text;
    size_t bytes;

    if (!test_has_tool("exrheader"))
    {
        print_message("skipped: exrheader is not installed\n");
        return;
    }
    assert_int_equal(test_shell(folder, "exrheader a.exr"), 0);
    text = (const char *)test_read_bytes(
        run, test_path(folder, "log.txt"), &bytes);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i)
        if (!strstr(text, expected[i]))
            fail_msg("no line \"%s\" in:\n%s", expected[i], text);
    assert_null(strstr(text, "capDate"));
}

static void
test_header_says_what_is_asked(void **state)
{
    const otx_exr_attribute attributes[] = {
        {.name = "osdtex:seed", .kind = OTX_EXR_INTEGER, .integer = 7},
        {.name = "osdtex:scale", .kind = OTX_EXR_REAL, .real = 0.5f},
        {.name = "osdtex:a_name_of_more_than_31_bytes", .text = "x"}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 100, 70, 3);
    otx_exr_options options = otx_exr_options_default();
    otx_picture picture;

    (void)state;
    options.wrap_x = true;
    options.color_space = "ACEScg";
    options.interop_id = "lin_ap1_scene";
    options.has_chromaticities = true;
    for (int i = 0; i < 8; ++i)
        options.chromaticities[i] = 0.1f * (float)(i + 1);
    options.attributes = attributes;
    options.attribute_count = 3;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    picture = test_read(run, test_path(&folder, "a.exr"));
    assert_string_equal(picture.oiio_space, "ACEScg");
    assert_string_equal(picture.interop_id, "lin_ap1_scene");
    assert_true(picture.has_chromaticities);
    assert_memory_equal(
        picture.chromaticities, options.chromaticities,
        sizeof picture.chromaticities);
    assert_exrheader_says(run, &folder);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_same_input_gives_same_bytes(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 130, 67, 4);
    const otx_exr_options options = otx_exr_options_default();
    size_t a_bytes, b_bytes;
    const uint8_t *a, *b;

    (void)state;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "b.exr"), &image, &options),
        OSDTEX_OK);
    a = test_read_bytes(run, test_path(&folder, "a.exr"), &a_bytes);
    b = test_read_bytes(run, test_path(&folder, "b.exr"), &b_bytes);
    assert_int_equal(a_bytes, b_bytes);
    assert_memory_equal(a, b, a_bytes);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* A picture put in pieces, each from a buffer of its own, gives the bytes of
 * the picture written as a whole. */
static void
test_streaming_gives_the_same_bytes(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 100, 70, 3);
    const otx_exr_options options = options_of(false, false);
    const otx_exr_size size = {100, 70, 3};
    otx_atomic_file_set *set;
    otx_exr_writer *writer;
    size_t a_bytes, b_bytes;
    const uint8_t *a, *b;
    otx_exr_chunk chunk = {0};

    (void)state;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    assert_int_equal(otx_atomic_file_begin(run, run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_exr_begin(
            run, set, test_path(&folder, "b.exr"), size, &options, &writer),
        OSDTEX_OK);
    chunk.bytes = OTX_NEW(run->scratch, uint8_t, otx_exr_packed_bytes(writer));
    for (int32_t y = 0; y < 5; ++y)
    {
        const int32_t rows = y < 4 ? 16 : 6;
        const int32_t lowest = 70 - 16 * y - rows;
        float piece[16 * 300];

        memcpy(
            piece, otx_image_at(&image, 0, lowest),
            (size_t)rows * 300 * sizeof(float));
        otx_exr_pack(writer, 0, 0, 0, y, piece, 300, &chunk);
        assert_int_equal(otx_exr_put(writer, 0, 0, y, &chunk), OSDTEX_OK);
    }
    assert_int_equal(otx_exr_end(writer), OSDTEX_OK);
    assert_int_equal(otx_atomic_file_commit(run, set, false), OSDTEX_OK);
    a = test_read_bytes(run, test_path(&folder, "a.exr"), &a_bytes);
    b = test_read_bytes(run, test_path(&folder, "b.exr"), &b_bytes);
    assert_int_equal(a_bytes, b_bytes);
    assert_memory_equal(a, b, a_bytes);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_chunks_out_of_order_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_exr_options options = otx_exr_options_default();
    const otx_exr_size size = {100, 70, 3};
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_atomic_file_set *set;
    otx_exr_writer *writer;

    (void)state;
    assert_int_equal(otx_atomic_file_begin(run, run->scratch, &set), OSDTEX_OK);
    assert_int_equal(
        otx_exr_begin(
            run, set, test_path(&folder, "a.exr"), size, &options, &writer),
        OSDTEX_OK);
    assert_int_equal(
        otx_exr_put(writer, 0, 1, 0, &(otx_exr_chunk){0}),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(otx_exr_end(writer), OSDTEX_ERROR_ARGUMENT);
    otx_arena_release(run->scratch, mark);
    assert_int_not_equal(access(test_path(&folder, "a.exr"), F_OK), 0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* A tiled texture must not be averaged across its tiles: the caller's levels
 * are written as they are. */
static void
test_levels_of_the_caller_are_written(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 8, 4, 3);
    otx_image levels[3] = {
        test_noise(run, 4, 2, 3), test_noise(run, 2, 1, 3),
        test_noise(run, 1, 1, 3)};
    otx_exr_options options = options_of(true, true);
    otx_picture picture;

    (void)state;
    levels[1].pixels[0] = 42.0f;
    options.levels = levels;
    options.level_count = 3;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    if (test_has_tool("oiiotool"))
    {
        assert_int_equal(
            test_shell(&folder, "oiiotool a.exr --selectmip 2 -o level.exr"),
            0);
        picture = test_read(run, test_path(&folder, "level.exr"));
        test_same_image(&picture.image, &levels[1], 0.0);
    }
    options.level_count = 2;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "b.exr"), &image, &options),
        OSDTEX_ERROR_ARGUMENT);
    options.level_count = 3;
    levels[2].channels = 4;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "b.exr"), &image, &options),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_not_equal(access(test_path(&folder, "b.exr"), F_OK), 0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_values_beyond_half_are_clamped(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    otx_image image = test_noise(run, 2, 1, 3);
    const otx_exr_options options = options_of(false, false);
    otx_picture picture;

    (void)state;
    image.pixels[0] = 1e6f;
    image.pixels[4] = -65519.0f;
    image.pixels[5] = 65504.0f;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_OK);
    assert_non_null(strstr(test_last_message(run), "2 values"));
    picture = test_read(run, test_path(&folder, "a.exr"));
    assert_float_equal(picture.image.pixels[0], 65504.0, 0.0);
    assert_float_equal(picture.image.pixels[4], -65504.0, 0.0);
    assert_float_equal(picture.image.pixels[5], 65504.0, 0.0);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_bad_input_leaves_no_file(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    otx_image image = test_noise(run, 100, 70, 3);
    const otx_image two = test_noise(run, 4, 4, 2);
    const otx_exr_options options = otx_exr_options_default();
    const otx_exr_attribute twice[2] = {
        {.name = "a", .text = "x"}, {.name = "", .text = "y"}};
    otx_exr_options bad_options = options;

    (void)state;
    bad_options.attributes = twice;
    bad_options.attribute_count = 2;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &two, &options),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &bad_options),
        OSDTEX_ERROR_ARGUMENT);
    image.pixels[100 * 70 * 3 - 1] = NAN;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_ERROR_NUMERIC);
    assert_int_equal(
        test_write_exr(
            run, test_path(&folder, "no/folder/a.exr"), &image, &options),
        OSDTEX_ERROR_IO);
    assert_int_equal(rmdir(folder.path), 0);
    test_run_destroy(run);
}

static bool
never(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    (void)fraction;
    return false;
}

static void
test_cancelling_leaves_no_file(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, 100, 70, 3);
    const otx_exr_options options = otx_exr_options_default();

    (void)state;
    run->progress = never;
    assert_int_equal(
        test_write_exr(run, test_path(&folder, "a.exr"), &image, &options),
        OSDTEX_ERROR_CANCELLED);
    assert_int_equal(rmdir(folder.path), 0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pixels_come_back),
        cmocka_unit_test(test_oiio_reads_every_level),
        cmocka_unit_test(test_header_says_what_is_asked),
        cmocka_unit_test(test_same_input_gives_same_bytes),
        cmocka_unit_test(test_streaming_gives_the_same_bytes),
        cmocka_unit_test(test_chunks_out_of_order_are_refused),
        cmocka_unit_test(test_levels_of_the_caller_are_written),
        cmocka_unit_test(test_values_beyond_half_are_clamped),
        cmocka_unit_test(test_bad_input_leaves_no_file),
        cmocka_unit_test(test_cancelling_leaves_no_file),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_jpeg_file.c -- JPEG files made here with libjpeg: grey, colour,
 * progressive, CMYK, and cut short. */
#include "picture_support.h"

#include <jpeglib.h>

enum
{
    WIDTH = 40,
    HEIGHT = 24
};

typedef struct jpeg_kind
{
    J_COLOR_SPACE space;
    int components;
    bool progressive;
    int orientation; /* of EXIF; 0 none */
} jpeg_kind;

/* A smooth ramp, which JPEG keeps nearly as it is. */
static int
ramp(int x, int y_down, int c)
{
    return c == 0 ? 6 * x : c == 1 ? 10 * y_down : 100;
}

static void
write_exif(struct jpeg_compress_struct *jpeg, int orientation)
{
    JOCTET bytes[] = "Exif\0\0II*\0\10\0\0\0\1\0\22\1\3\0\1\0\0\0?\0\0\0\0\0\0";

    bytes[24] = (JOCTET)orientation;
    jpeg_write_marker(jpeg, JPEG_APP0 + 1, bytes, sizeof bytes);
}

static void
write_jpeg(const char *path, jpeg_kind kind)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    FILE *file = fopen(path, "wb");

    assert_non_null(file);
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_stdio_dest(&jpeg, file);
    jpeg.image_width = WIDTH;
    jpeg.image_height = HEIGHT;
    jpeg.input_components = kind.components;
    jpeg.in_color_space = kind.space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    for (int c = 0; c < kind.components; ++c)
        jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    if (kind.progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    if (kind.orientation > 0)
        write_exif(&jpeg, kind.orientation);
    for (int y = 0; y < HEIGHT; ++y)
    {
        JSAMPLE row[WIDTH * 4];
        JSAMPROW rows[1] = {row};

        for (int i = 0; i < WIDTH * kind.components; ++i)
            row[i] = (JSAMPLE)ramp(i / kind.components, y, i % kind.components);
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    fclose(file);
}

static void
test_ramps_come_back(void **state)
{
    const jpeg_kind kinds[] = {
        {JCS_GRAYSCALE, 1, false, 0},
        {JCS_RGB, 3, false, 0},
        {JCS_RGB, 3, true, 0}};
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");

    (void)state;
    for (int k = 0; k < 3; ++k)
    {
        const bool gray = kinds[k].components == 1;
        otx_picture picture;

        write_jpeg(path, kinds[k]);
        picture = test_read(run, path);
        assert_int_equal(picture.kind, OTX_PICTURE_JPEG);
        assert_int_equal(picture.bits, 8);
        assert_int_equal(picture.is_gray, gray);
        assert_int_equal(picture.image.channels, 3);
        for (int y = 0; y < HEIGHT; ++y)
            for (int i = 0; i < WIDTH * 3; ++i)
                assert_float_equal(
                    otx_picture_row(&picture, y)[i],
                    ramp(i / 3, y, gray ? 0 : i % 3) / 255.0, 3.0 / 255.0);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_cmyk_is_not_read(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");
    otx_picture picture;

    (void)state;
    write_jpeg(path, (jpeg_kind){JCS_CMYK, 4, false, 0});
    assert_int_equal(
        otx_picture_read(run, path, &picture), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "CMYK"));
    test_folder_remove(&folder);
    test_run_destroy(run);
}

static void
test_orientation_is_told(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");

    (void)state;
    write_jpeg(path, (jpeg_kind){JCS_RGB, 3, false, 1});
    test_read(run, path);
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 0);
    write_jpeg(path, (jpeg_kind){JCS_RGB, 3, false, 6});
    test_read(run, path);
    assert_non_null(strstr(
        test_last_message(run),
        "the JPEG asks viewers to turn or mirror it (orientation 6)"));
    test_folder_remove(&folder);
    test_run_destroy(run);
}

/* libjpeg itself would give grey for what is missing. */
static void
test_cut_files_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.jpg");

    (void)state;
    for (int progressive = 0; progressive < 2; ++progressive)
    {
        write_jpeg(path, (jpeg_kind){JCS_RGB, 3, progressive, 0});
        test_prefixes_fail(run, &folder, path, 0);
    }
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ramps_come_back),
        cmocka_unit_test(test_orientation_is_told),
        cmocka_unit_test(test_cmyk_is_not_read),
        cmocka_unit_test(test_cut_files_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

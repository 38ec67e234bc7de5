/* test_openexr.c -- what the C++ library reads: the rows that were written, in
 * order, and a sentence where there is no picture. */
#include "unit/file/exr_support.h"

#include "bridge/openexr.h"

#include <math.h>

enum
{
    WIDTH = 37,
    HEIGHT = 23
};

typedef struct rows
{
    const otx_image *image;
    int32_t next, count;
    bool swapped; /* R is read from B */
} rows;

/* Rows count from the top; those of an image from the bottom. */
static void
take(void *user, int32_t y, const float *row, int32_t x_min, int32_t width)
{
    rows *r = user;

    assert_int_equal(y, r->next++);
    assert_int_equal(x_min, 0);
    assert_int_equal(width, WIDTH);
    ++r->count;
    for (int32_t x = 0; x < WIDTH; ++x)
    {
        const float *p = otx_image_at(r->image, x, HEIGHT - 1 - y);

        for (int c = 0; c < 3; ++c)
            assert_float_equal(
                row[4 * x + c], p[r->swapped ? 2 - c : c],
                1e-3 * (1.0 + fabs((double)p[c])));
        assert_float_equal(row[4 * x + 3], 1.0, 0.0);
    }
}

static void
rows_are_those_that_were_written(void **state)
{
    otx_run *run = *state;
    const test_folder folder = test_folder_create();
    const otx_image image = test_noise(run, WIDTH, HEIGHT, 3);
    const otx_exr_options options = otx_exr_options_default();
    otx_openexr_picture picture = {
        .path = test_path(&folder, "a.exr"),
        .channels = {"R", "G", "B", NULL},
        .y_max = HEIGHT - 1};
    char reason[OTX_OPENEXR_REASON_BYTES];
    rows r = {.image = &image};

    assert_int_equal(
        test_write_exr(run, picture.path, &image, &options), OSDTEX_OK);
    assert_int_equal(otx_openexr_read(&picture, take, &r, reason), OSDTEX_OK);
    assert_int_equal(r.count, HEIGHT);
    /* Some of them, and channels in another order. */
    picture.y_min = r.next = 5;
    picture.y_max = 9;
    picture.channels[0] = "B";
    picture.channels[2] = "R";
    r.swapped = true;
    r.count = 0;
    assert_int_equal(otx_openexr_read(&picture, take, &r, reason), OSDTEX_OK);
    assert_int_equal(r.count, 5);
    test_folder_remove(&folder);
}

static void
what_is_no_picture_is_said(void **state)
{
    const otx_openexr_picture picture = {
        .path = "CMakeLists.txt", .channels = {"R", "G", "B", NULL}};
    char reason[OTX_OPENEXR_REASON_BYTES] = "";

    (void)state;
    assert_int_equal(
        otx_openexr_read(&picture, take, NULL, reason), OSDTEX_ERROR_FORMAT);
    assert_true(strlen(reason) > 5);
    assert_null(strchr(reason, '\n'));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(rows_are_those_that_were_written),
        test_with_run(what_is_no_picture_is_said),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

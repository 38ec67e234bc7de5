/* test_lettering.c -- letters stand where they are asked for, within the
 * picture. */
#include "image/lettering.h"
#include "support.h"

static int32_t
count_bright(const otx_image *image)
{
    int32_t count = 0;

    for (int32_t i = 0; i < image->width * image->height; ++i)
        count += image->pixels[(size_t)(4 * i)] > 0.5f;
    return count;
}

static void
an_i_is_nine_squares(void **state)
{
    otx_run *run = test_run_create();
    otx_image image;

    (void)state;
    assert_int_equal(
        otx_image_create(run, run->arena, 40, 30, 4, &image), OSDTEX_OK);
    memset(image.pixels, 0, 40 * 30 * 4 * sizeof(float));
    otx_lettering_write(&image, 10, 20, 2, "i");
    assert_int_equal(count_bright(&image), 9 * 4);
    assert_true(otx_image_at(&image, 10, 19)[0] > 0.5f);
    assert_true(otx_image_at(&image, 10, 17)[0] < 0.1f);
    /* Beyond the edges it is cut off. */
    otx_lettering_write(&image, -50, 400, 9, "beyond 09");
    otx_lettering_write(&image, 38, 2, 3, "z");
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_i_is_nine_squares),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

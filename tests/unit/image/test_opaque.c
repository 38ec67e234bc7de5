/* test_opaque.c -- the largest rectangle without transparent texels. */
#include "support.h"

#include "base/random.h"
#include "image/opaque.h"

/* Against all rectangles, on small pictures with holes at random. */
static void
test_as_by_all_rectangles(void **state)
{
    enum
    {
        W = 9,
        H = 7
    };
    otx_run *run = *state;
    otx_image image;

    otx_image_create(run, run->arena, W, H, 4, &image);
    for (uint64_t n = 0; n < 60; ++n)
    {
        int32_t best = 0, holes = 0;
        otx_opaque found;

        for (int32_t i = 0; i < W * H; ++i)
        {
            const bool hole =
                otx_random_unit(n, 0, (uint64_t)i) < (double)n / 90.0;

            image.pixels[4 * i + 3] = hole ? 0.0f : 0.25f;
            holes += hole;
        }
        for (int32_t i = 0; i < W * H * W * H; ++i)
        {
            const int32_t x0 = i % W, y0 = i / W % H, x1 = i / (W * H) % W,
                          y1 = i / (W * H * W);
            bool opaque = x1 >= x0 && y1 >= y0;

            for (int32_t y = y0; opaque && y <= y1; ++y)
                for (int32_t x = x0; x <= x1; ++x)
                    opaque &= otx_image_at(&image, x, y)[3] > 0.0f;
            if (opaque && (x1 - x0 + 1) * (y1 - y0 + 1) > best)
                best = (x1 - x0 + 1) * (y1 - y0 + 1);
        }
        assert_true(otx_opaque_find(run->arena, &image, &found));
        assert_int_equal(found.width * found.height, best);
        assert_float_equal(found.transparent, (double)holes / (W * H), 1e-12);
        for (int32_t y = found.y; y < found.y + found.height; ++y)
            for (int32_t x = found.x; x < found.x + found.width; ++x)
                assert_true(otx_image_at(&image, x, y)[3] > 0.0f);
    }
}

static void
test_no_alpha_is_opaque(void **state)
{
    otx_run *run = *state;
    otx_opaque found;
    otx_image image;

    otx_image_create(run, run->arena, 5, 4, 3, &image);
    assert_true(otx_opaque_find(run->arena, &image, &found));
    assert_true(found.transparent == 0.0);
    assert_int_equal(found.width, 5);
    assert_int_equal(found.height, 4);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            test_as_by_all_rectangles, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            test_no_alpha_is_opaque, test_run_setup, test_run_teardown)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_feature_mask.c -- features that were painted are found. */
#include "support.h"

#include "base/random.h"
#include "stack/feature_mask.h"

#include <math.h>

enum
{
    SIDE = 128,
    TEXELS = SIDE * SIDE
};

static bool
is_spot(int32_t x, int32_t y)
{
    return hypot((x % 32) - 16, (y % 32) - 16) < 8.0;
}

static bool
is_joint(int32_t x, int32_t y)
{
    return x % 32 < 3 || y % 16 < 3;
}

/* Dark or light features in grain; shaded from side to side where asked for. */
static void
paint(
    otx_run *run, bool (*feature)(int32_t, int32_t), double contrast,
    double shade, otx_image *lab)
{
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, lab), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            float *v = otx_image_at(lab, x, y);
            const double noise =
                8.0 * otx_random_unit(3, 1, (uint64_t)(y * SIDE + x));
            const double slow = shade * sin(2.0 * OTX_PI * x / SIDE);

            v[0] =
                (float)((feature(x, y) ? 50.0 + contrast : 50.0) + noise + slow);
            v[1] = v[2] = 0.0f;
        }
}

static double
overlap(const uint8_t *mask, bool (*feature)(int32_t, int32_t))
{
    int32_t both = 0, any = 0;

    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const bool is = feature(i % SIDE, i / SIDE);

        both += mask[i] && is;
        any += mask[i] || is;
    }
    return (double)both / any;
}

static void
spots_are_found(void **state)
{
    otx_run *run = test_run_create();
    otx_image lab;
    otx_feature_mask mask;

    (void)state;
    paint(run, is_spot, -30.0, 0.0, &lab);
    assert_int_equal(
        otx_feature_mask_find(run, &lab, OTX_FEATURE_SPOTS, &mask), OSDTEX_OK);
    assert_true(overlap(mask.texels, is_spot) > 0.9);
    assert_true(mask.clarity > 0.8 && mask.clarity <= 1.0);
    test_run_destroy(run);
}

/* Dark ones and light ones, where the light changes over the picture, too. */
static void
joints_are_found_in_shade(void **state)
{
    otx_run *run = test_run_create();
    otx_image lab;
    otx_feature_mask mask;

    (void)state;
    for (int i = -1; i <= 1; i += 2)
    {
        paint(run, is_joint, 30.0 * i, 12.0, &lab);
        assert_int_equal(
            otx_feature_mask_find(run, &lab, OTX_FEATURE_JOINTS, &mask),
            OSDTEX_OK);
        assert_true(overlap(mask.texels, is_joint) > 0.8);
    }
    test_run_destroy(run);
}

static void
nothing_is_found_in_one_colour(void **state)
{
    otx_run *run = test_run_create();
    otx_image lab;
    otx_feature_mask mask;

    (void)state;
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &lab), OSDTEX_OK);
    for (int32_t i = 0; i < 3 * TEXELS; ++i)
        lab.pixels[i] = 50.0f;
    for (int f = 0; f < 2; ++f)
    {
        assert_int_equal(
            otx_feature_mask_find(run, &lab, (otx_feature_kind)f, &mask),
            OSDTEX_OK);
        assert_float_equal(mask.share, 0.0, 0.0);
        assert_float_equal(mask.clarity, 0.0, 0.0);
    }
    test_run_destroy(run);
}

/* An island over the corner of the torus is one piece. */
static void
crumbs_are_counted_and_cleaned(void **state)
{
    otx_run *run = test_run_create();
    uint8_t mask[TEXELS] = {0};
    int32_t count;

    (void)state;
    for (int32_t y = 40; y < 60; ++y)
        for (int32_t x = 40; x < 60; ++x)
            mask[y * SIDE + x] = 1;
    mask[50 * SIDE + 50] = 0;
    mask[0] = mask[SIDE - 1] = mask[TEXELS - SIDE] = 1;
    assert_int_equal(
        otx_feature_mask_crumbs(run, mask, SIDE, SIDE, 16, &count), OSDTEX_OK);
    assert_int_equal(count, 2);
    assert_int_equal(
        otx_feature_mask_clean(run, mask, SIDE, SIDE, 16), OSDTEX_OK);
    assert_int_equal(mask[0] + mask[SIDE - 1] + mask[TEXELS - SIDE], 0);
    assert_int_equal(mask[50 * SIDE + 50], 1);
    assert_float_equal(
        otx_feature_mask_share(mask, TEXELS), 400.0 / (double)TEXELS, 1e-12);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spots_are_found),
        cmocka_unit_test(joints_are_found_in_shade),
        cmocka_unit_test(nothing_is_found_in_one_colour),
        cmocka_unit_test(crumbs_are_counted_and_cleaned),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

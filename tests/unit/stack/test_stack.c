/* test_stack.c -- what is known of a picture's texels goes where they go. */
#include "support.h"

#include "base/random.h"
#include "stack/stack.h"

#include <math.h>

enum
{
    SIDE = 64,
    TEXELS = SIDE * SIDE,
    SLICES = 4
};

static bool
in_spot(int32_t i, double radius)
{
    return hypot(i % SIDE % 16 - 8, i / SIDE % 16 - 8) < radius;
}

/* Spots on grain. Its maps are a normal, which is flat, and a height that is
 * the red of the colour. */
static void
paint(otx_run *run, double radius, otx_exemplar *out)
{
    *out = (otx_exemplar){.wrap_x = true, .wrap_y = true};
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &out->linear),
        OSDTEX_OK);
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &out->lab), OSDTEX_OK);
    assert_int_equal(
        otx_image_create(
            run, run->arena, SIDE, SIDE, 4, &out->companions.image),
        OSDTEX_OK);
    out->companions.maps[OTX_COMPANION_NORMAL].is_there = true;
    out->companions.maps[OTX_COMPANION_HEIGHT] =
        (otx_companion){.is_there = true, .first = 3};
    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const double grain = otx_random_unit(3, 1, (uint64_t)i);
        const double light = (in_spot(i, radius) ? 0.2 : 0.7) + 0.1 * grain;

        for (int c = 0; c < 3; ++c)
        {
            out->linear.pixels[3 * i + c] = (float)(light - 0.05 * c);
            out->lab.pixels[3 * i + c] = c == 0 ? (float)(100.0 * light) : 0.0f;
        }
        otx_companion_neutral(
            OTX_COMPANION_NORMAL, out->companions.image.pixels + 4 * i);
        out->companions.image.pixels[4 * i + 3] = (float)light;
    }
}

/* Height of a texel of a slice, as the two ends have it where they are shown.
 */
static double
mixed_height(const otx_stack_slice *slice, const otx_exemplar *ends, int32_t i)
{
    double sum = 0.0;

    for (int k = 0; k < 2; ++k)
        if (slice->texels[k])
            sum += (k ? slice->weight : 1.0 - slice->weight) *
                   (double)ends[k]
                       .companions.image.pixels[4 * slice->texels[k][i] + 3];
    return sum;
}

/* Ends are the ends. Between them higher is higher, and nothing lies beyond
 * what the ends have. */
static void
check_heights(const otx_stack_slice *slice, const otx_exemplar *ends)
{
    const bool is_end = !slice->texels[0] || !slice->texels[1];

    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const double height = (double)slice->maps.pixels[4 * i + 3];
        const int32_t other = (i * 37 + 11) % TEXELS;
        const double above =
            mixed_height(slice, ends, i) - mixed_height(slice, ends, other);

        assert_true(height >= 0.2 - 1e-6 && height <= 0.8 + 1e-6);
        if (is_end)
            assert_float_equal(height, mixed_height(slice, ends, i), 1e-6);
        if (above > 1e-4)
            assert_true(
                height >= (double)slice->maps.pixels[4 * other + 3] - 1e-6);
    }
}

static void
maps_follow(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar ends[2];
    uint8_t masks[2][TEXELS];
    otx_stack_key keys[2];
    otx_stack stack;

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        paint(run, 4.0 + k, &ends[k]);
        for (int32_t i = 0; i < TEXELS; ++i)
            masks[k][i] = in_spot(i, 4.0 + k);
        keys[k] = (otx_stack_key){&ends[k], masks[k]};
    }
    assert_int_equal(
        otx_stack_make(
            run, keys, 2, &(otx_stack_options){SLICES, OTX_MORPH_LINEAR, 1},
            &stack),
        OSDTEX_OK);
    assert_int_equal(stack.count, SLICES);
    for (int32_t m = 0; m < SLICES; ++m)
    {
        const otx_stack_slice *slice = &stack.slices[m];

        assert_int_equal(slice->maps.channels, 4);
        for (int32_t i = 0; i < TEXELS; ++i)
        {
            const float *maps = slice->maps.pixels + 4 * i;

            assert_float_equal(maps[0], 0.0, 1e-6);
            assert_float_equal(maps[2], 1.0, 1e-6);
        }
        check_heights(slice, ends);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_follow),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_mixture.c -- means and contrast of what is mixed. */
#include "support.h"

#include "base/random.h"
#include "stack/mixture.h"

#include <math.h>

enum
{
    SIDE = 32,
    TEXELS = SIDE * SIDE
};

static void
paint(otx_run *run, uint64_t seed, double low, double high, otx_image *out)
{
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, out), OSDTEX_OK);
    for (int32_t i = 0; i < 3 * TEXELS; ++i)
        out->pixels[i] =
            (float)(low + (high - low) * otx_random_unit(seed, 1, (uint64_t)i));
}

static void
moments(const otx_image *image, int32_t channel, double *mean, double *spread)
{
    double sum = 0.0, squares = 0.0;

    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const double v = (double)image->pixels[3 * i + channel];

        sum += v;
        squares += v * v;
    }
    *mean = sum / TEXELS;
    *spread = sqrt(squares / TEXELS - *mean * *mean);
}

static void
contrast_is_kept(void **state)
{
    otx_run *run = test_run_create();
    int32_t same[TEXELS];
    otx_image a, b, out;

    (void)state;
    for (int32_t i = 0; i < TEXELS; ++i)
        same[i] = i;
    paint(run, 1, 0.2, 0.4, &a);
    paint(run, 2, 0.5, 0.9, &b);
    assert_int_equal(
        otx_mixture_make(
            run,
            &(otx_mixture){
                &a, &b, .from_texels = same, .to_texels = same, .weight = 0.25},
            &out),
        OSDTEX_OK);
    for (int32_t c = 0; c < 3; ++c)
    {
        double ma, sa, mb, sb, m, s;

        moments(&a, c, &ma, &sa);
        moments(&b, c, &mb, &sb);
        moments(&out, c, &m, &s);
        assert_float_equal(m, 0.75 * ma + 0.25 * mb, 1e-3);
        assert_float_equal(s, 0.75 * sa + 0.25 * sb, 2e-3);
    }
    test_run_destroy(run);
}

static void
an_end_is_a_copy(void **state)
{
    otx_run *run = test_run_create();
    int32_t turned[TEXELS];
    otx_image a, b, out;

    (void)state;
    for (int32_t i = 0; i < TEXELS; ++i)
        turned[i] = TEXELS - 1 - i;
    paint(run, 1, 0.0, 1.0, &a);
    paint(run, 2, 0.0, 1.0, &b);
    assert_int_equal(
        otx_mixture_make(
            run, &(otx_mixture){&a, &b, .from_texels = turned}, &out),
        OSDTEX_OK);
    for (int32_t i = 0; i < TEXELS; ++i)
        assert_memory_equal(
            out.pixels + 3 * i, a.pixels + 3 * turned[i], 3 * sizeof(float));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrast_is_kept),
        cmocka_unit_test(an_end_is_a_copy),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

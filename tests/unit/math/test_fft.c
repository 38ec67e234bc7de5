/* test_fft.c -- the correlation is the sum it says it is. */
#include "support.h"

#include "base/random.h"
#include "math/fft.h"

#include <math.h>

/* sum over planes and x of f(x) g(x + x0), toroidal. */
static double
direct(
    const float *f, const float *g, int32_t planes, int32_t width,
    int32_t height, int32_t x0, int32_t y0)
{
    double sum = 0.0;

    for (int32_t p = 0; p < planes; ++p)
        for (int32_t y = 0; y < height; ++y)
            for (int32_t x = 0; x < width; ++x)
            {
                const int32_t i = (x + x0) % width;
                const int32_t j = (y + y0) % height;

                sum += (double)f[(p * height + y) * width + x] *
                       (double)g[(p * height + j) * width + i];
            }
    return sum;
}

static void
check_size(int32_t width, int32_t height, int32_t rows)
{
    enum
    {
        PLANES = 3
    };
    otx_run *run = test_run_create();
    const size_t count = (size_t)PLANES * (size_t)width * (size_t)height;
    float *f = OTX_ZNEW(run->arena, float, count);
    float *g = OTX_ZNEW(run->arena, float, count);
    float *planes[PLANES], *spectra[PLANES], *scratch;
    otx_fft *fft;

    assert_int_equal(
        otx_fft_create(run, run->arena, width, height, &fft), OSDTEX_OK);
    const size_t stride = otx_fft_stride(fft);

    scratch = OTX_NEW(run->arena, float, otx_fft_scratch_floats(fft));
    for (size_t i = 0; i < count; ++i)
    {
        const int32_t y = (int32_t)(i / (size_t)width) % height;

        f[i] = y < rows ? (float)otx_random_unit(1, 1, i) - 0.5f : 0.0f;
        g[i] = (float)otx_random_unit(1, 2, i) - 0.5f;
    }
    for (int32_t p = 0; p < PLANES; ++p)
    {
        float *plane = OTX_ZNEW(run->arena, float, (size_t)height *stride);

        planes[p] = OTX_ZNEW(run->arena, float, (size_t)rows *stride);
        spectra[p] = OTX_NEW(run->arena, float, otx_fft_spectrum_floats(fft));
        for (int32_t y = 0; y < height; ++y)
            for (int32_t x = 0; x < width; ++x)
            {
                const int32_t at = (p * height + y) * width + x;

                plane[(size_t)y * stride + (size_t)x] = g[at];
                if (y < rows)
                    planes[p][(size_t)y * stride + (size_t)x] = f[at];
            }
        otx_fft_forward(
            fft, 1.0f / (float)(width * height), plane, scratch, spectra[p]);
    }
    float *out = OTX_NEW(run->arena, float, (size_t)height *stride);

    otx_fft_correlate(
        fft, PLANES, rows, planes, (const float *const *)spectra, scratch, out);
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            assert_true(
                fabs(
                    (double)out[(size_t)y * stride + (size_t)x] -
                    direct(f, g, PLANES, width, height, x, y)) <
                1e-5 * sqrt((double)(PLANES * width * rows)));
    test_run_destroy(run);
}

static void
correlation_equals_the_sum_at_any_size(void **state)
{
    (void)state;
    check_size(1, 1, 1);
    check_size(2, 3, 2);
    check_size(8, 8, 8);
    check_size(16, 5, 3);
    check_size(9, 14, 14);
    check_size(37, 11, 4);
    check_size(30, 30, 17);
}

static void
good_sizes_are_even_and_smooth(void **state)
{
    (void)state;
    assert_int_equal(otx_fft_good_size(1), 2);
    assert_int_equal(otx_fft_good_size(128), 128);
    assert_int_equal(otx_fft_good_size(333), 336);
    assert_int_equal(otx_fft_good_size(127), 128);
    for (int32_t n = 1; n < 2000; ++n)
    {
        const int32_t good = otx_fft_good_size(n);

        assert_true(good >= n && good % 2 == 0);
        assert_int_equal(otx_fft_good_size(good), good);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(correlation_equals_the_sum_at_any_size),
        cmocka_unit_test(good_sizes_are_even_and_smooth),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

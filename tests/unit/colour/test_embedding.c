/* test_embedding.c -- distance means what it should. */
#include "colour/embedding.h"
#include "support.h"

#include <math.h>

/* Hue in turns, saturation, value. */
static void
rgb_of_hsv(double h, double s, double v, float rgb[3])
{
    for (int k = 0; k < 3; ++k)
    {
        const double t = fmod(h * 6.0 + (double[]){5.0, 3.0, 1.0}[k], 6.0);
        rgb[k] = (float)(v - v * s * fmax(0.0, fmin(fmin(t, 4.0 - t), 1.0)));
    }
}

static double
distance(otx_embedding e, const float a[3], const float b[3])
{
    float p[3];
    float q[3];

    otx_embedding_map(e, a, p);
    otx_embedding_map(e, b, q);
    return sqrt(
        pow((double)p[0] - (double)q[0], 2) +
        pow((double)p[1] - (double)q[1], 2) +
        pow((double)p[2] - (double)q[2], 2));
}

static void
test_cone_is_hsv(void **state)
{
    (void)state;
    for (int i = 0; i < 360; ++i)
    {
        const double h = i / 360.0;
        float rgb[3];
        float point[3];

        rgb_of_hsv(h, 0.7, 0.8, rgb);
        otx_embedding_map(OTX_EMBEDDING_HSV_CONE, rgb, point);
        assert_true(
            fabs((double)point[0] - 0.56 * cos(2.0 * OTX_PI * h)) < 1e-6);
        assert_true(
            fabs((double)point[1] - 0.56 * sin(2.0 * OTX_PI * h)) < 1e-6);
        assert_true(fabs((double)point[2] - 0.8) < 1e-6);
        otx_embedding_map(OTX_EMBEDDING_HSV_CYLINDER, rgb, point);
        assert_true(
            fabs((double)point[0] - 0.7 * cos(2.0 * OTX_PI * h)) < 1e-6);
    }
}

static void
test_red_does_not_wrap(void **state)
{
    float a[3];
    float b[3];
    float c[3];
    (void)state;

    rgb_of_hsv(0.99, 1.0, 1.0, a);
    rgb_of_hsv(0.01, 1.0, 1.0, b);
    rgb_of_hsv(0.03, 1.0, 1.0, c);
    for (int e = 0; e < OTX_EMBEDDING_LAB; ++e)
    {
        const double across = distance((otx_embedding)e, a, b);

        assert_true(fabs(across - 2.0 * sin(0.02 * OTX_PI)) < 1e-5);
        assert_true(fabs(across - distance((otx_embedding)e, b, c)) < 1e-5);
    }
}

/* Small changes of colour are small in the embedding, at grey and black too,
 * where hue turns through all its values. */
static void
test_continuity(void **state)
{
    static const float centres[][3] = {{0.0F, 0.0F, 0.0F}, {0.5F, 0.5F, 0.5F},
                                       {1.0F, 1.0F, 1.0F}, {1.0F, 0.0F, 0.0F},
                                       {0.3F, 0.3F, 0.0F}, {0.2F, 0.7F, 0.7F}};
    static const otx_embedding smooth[] = {
        OTX_EMBEDDING_HSV_CONE, OTX_EMBEDDING_LAB, OTX_EMBEDDING_RGB};
    const double bound[] = {3.0, 1000.0, 1.0001};
    (void)state;

    for (size_t i = 0; i < sizeof centres / sizeof centres[0]; ++i)
        for (int d = 0; d < 27; ++d)
            for (size_t e = 0; e < 3; ++e)
            {
                const float h = 1e-3F;
                float near[3];
                double step = 0.0;

                for (int k = 0; k < 3; ++k)
                {
                    const int sign = d / (k == 0 ? 1 : k == 1 ? 3 : 9) % 3 - 1;
                    near[k] = centres[i][k] + h * (float)sign;
                    step += sign * sign;
                }
                assert_true(
                    distance(smooth[e], centres[i], near) <=
                    bound[e] * (double)h * sqrt(step) + 1e-6);
            }
}

static void
test_lab_values(void **state)
{
    static const float red[3] = {1.0F, 0.0F, 0.0F};
    float grey[3] = {0.5F, 0.5F, 0.5F};
    float point[3];
    (void)state;

    otx_embedding_map(OTX_EMBEDDING_LAB, red, point);
    assert_true(fabsf(point[0] - 53.24F) < 0.02F);
    assert_true(fabsf(point[1] - 80.09F) < 0.05F);
    assert_true(fabsf(point[2] - 67.20F) < 0.05F);
    for (int i = 0; i <= 100; ++i)
    {
        grey[0] = grey[1] = grey[2] = (float)i / 100.0F;
        otx_embedding_map(OTX_EMBEDDING_LAB, grey, point);
        assert_true(fabsf(point[1]) < 1e-3F && fabsf(point[2]) < 1e-3F);
    }
    assert_true(fabsf(point[0] - 100.0F) < 1e-3F);
}

static void
test_clamped(void **state)
{
    static const float wild[3] = {8.0F, -0.5F, 0.25F};
    static const float tame[3] = {1.0F, 0.0F, 0.25F};
    (void)state;

    for (int e = 0; e < OTX_EMBEDDING_COUNT; ++e)
    {
        assert_true(distance((otx_embedding)e, wild, tame) == 0.0);
        assert_true(otx_embedding_name((otx_embedding)e)[0] != '\0');
    }
}

static void
test_shape(void **state)
{
    static const float peaks[] = {0.5F, 1.0F, 1.1F, 4.0F, 100.0F, 1e6F};
    (void)state;

    for (size_t p = 0; p < sizeof peaks / sizeof peaks[0]; ++p)
    {
        float last = -1.0F;

        for (int i = 0; i <= 1000; ++i)
        {
            const float m = peaks[p] * (float)i / 1000.0F;
            const float in[3] = {m, 0.5F * m, -0.1F * m};
            float out[3];

            otx_embedding_shape(peaks[p], in, out);
            assert_true(out[0] >= last - 1e-6F && out[0] <= 1.000001F);
            if (m <= 0.75F || peaks[p] <= 1.0F)
                assert_true(out[0] == m);
            if (m > 0.0F)
                assert_true(fabsf(out[1] / out[0] - 0.5F) < 1e-5F);
            last = out[0];
        }
        assert_true(fabsf(last - fminf(1.0F, peaks[p])) < 1e-5F);
    }
}

static void
test_curve(void **state)
{
    (void)state;
    assert_true(fabsf(otx_embedding_encode(0.2140411F) - 0.5F) < 1e-6F);
    for (int i = -100; i <= 100; ++i)
    {
        const float x = (float)i / 100.0F;
        assert_true(
            fabsf(otx_embedding_decode(otx_embedding_encode(x)) - x) < 1e-6F);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cone_is_hsv),
        cmocka_unit_test(test_red_does_not_wrap),
        cmocka_unit_test(test_continuity),
        cmocka_unit_test(test_lab_values),
        cmocka_unit_test(test_clamped),
        cmocka_unit_test(test_shape),
        cmocka_unit_test(test_curve),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

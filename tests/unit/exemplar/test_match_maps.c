/* test_match_maps.c -- what is compared tells apart what the maps tell apart.
 */
#include "exemplar/match_maps.h"

#include "base/random.h"
#include "exemplar/statistics.h"
#include "support.h"

#include <math.h>

enum
{
    SIDE = 32
};

static double
noise(int32_t i, uint64_t stage)
{
    return otx_random_unit(7, stage, (uint64_t)i) - 0.5;
}

/* Colours are noise in three channels; so are heights, and normals lean by
 * noise to all sides. Maps are twice as large, each texel four times. */
static otx_exemplar
made(otx_run *run)
{
    otx_exemplar e = {.source_path = "a.png"};
    otx_image *maps = &e.companions.image;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &e.match), OSDTEX_OK);
    assert_int_equal(
        otx_image_create(run, run->arena, 2 * SIDE, 2 * SIDE, 4, maps),
        OSDTEX_OK);
    for (int32_t i = 0; i < 3 * SIDE * SIDE; ++i)
        e.match.pixels[i] = (float)(noise(i, 1) * (i % 3 == 0 ? 1.0 : 0.02));
    for (int32_t y = 0; y < 2 * SIDE; ++y)
        for (int32_t x = 0; x < 2 * SIDE; ++x)
        {
            const int32_t i = y / 2 * SIDE + x / 2;
            float *p = otx_image_at(maps, x, y);

            p[0] = (float)noise(i, 2);
            p[1] = (float)noise(i, 3);
            p[2] = 1.0f;
            p[3] = 5.0f * (float)noise(i, 4);
        }
    e.companions.maps[OTX_COMPANION_NORMAL] = (otx_companion){.is_there = true};
    e.companions.maps[OTX_COMPANION_HEIGHT] =
        (otx_companion){.is_there = true, .first = 3};
    e.lab = e.match;
    assert_int_equal(otx_exemplar_measure(run, &e), OSDTEX_OK);
    return e;
}

static double
square(const otx_image *image, int32_t a, int32_t b)
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        const double d =
            (double)image->pixels[3 * a + k] - (double)image->pixels[3 * b + k];

        sum += d * d;
    }
    return sum;
}

static void
test_colour_alone_is_left(void **state)
{
    otx_run *run = test_run_create();
    const otx_match_weights none = {0}, color = {.color = 1.0};
    otx_exemplar e = made(run);
    const float *pixels = e.match.pixels;

    (void)state;
    assert_int_equal(otx_match_maps_mix(run, &none, &e), OSDTEX_OK);
    assert_int_equal(otx_match_maps_mix(run, &color, &e), OSDTEX_OK);
    assert_ptr_equal(e.match.pixels, pixels);
    assert_false(e.mixes_maps);
    test_run_destroy(run);
}

/* Distances are those of colours and heights together, by their weights. */
static void
test_distances(void **state)
{
    otx_run *run = test_run_create();
    otx_match_weights weights = {.color = 1.0};
    const otx_exemplar before = made(run);
    otx_exemplar e = made(run);
    double worst = 0.0, sum = 0.0;

    (void)state;
    weights.maps[OTX_COMPANION_HEIGHT] = 2.0;
    assert_int_equal(otx_match_maps_mix(run, &weights, &e), OSDTEX_OK);
    assert_true(e.mixes_maps);
    assert_float_equal(e.match_sigma, before.match_sigma, 0.01);
    for (int32_t i = 0; i + 1 < SIDE * SIDE; ++i)
    {
        const double height = 5.0 * (noise(i, 4) - noise(i + 1, 4));
        /* Both spreads are those of uniform noise. */
        const double wanted =
            (square(&before.match, i, i + 1) + 4.0 * height * height / 25.0) /
            5.0;

        worst = fmax(worst, fabs(square(&e.match, i, i + 1) - wanted));
        sum += wanted / (SIDE * SIDE);
    }
    /* The weakest colours are what three channels leave out. */
    assert_true(worst < 0.1 * sum);
    test_run_destroy(run);
}

/* A patch that is turned turns its normals: they count by their tilt. */
static void
test_normals_count_by_tilt(void **state)
{
    otx_run *run = test_run_create();
    otx_match_weights weights = {0};
    otx_exemplar e = made(run), turned = made(run);
    double worst = 0.0;

    (void)state;
    weights.maps[OTX_COMPANION_NORMAL] = 1.0;
    for (int32_t i = 0; i < 4 * SIDE * SIDE; ++i)
    {
        float *p = turned.companions.image.pixels + 4 * i;
        const float x = p[0];

        p[0] = -p[1];
        p[1] = x;
    }
    assert_int_equal(otx_match_maps_mix(run, &weights, &e), OSDTEX_OK);
    assert_int_equal(otx_match_maps_mix(run, &weights, &turned), OSDTEX_OK);
    for (int32_t i = 0; i < 3 * SIDE * SIDE; ++i)
        worst = fmax(
            worst,
            fabs((double)e.match.pixels[i] - (double)turned.match.pixels[i]));
    assert_true(worst < 1e-6);
    assert_true(e.match_sigma > 0.1);
    test_run_destroy(run);
}

static void
test_refusals(void **state)
{
    otx_run *run = test_run_create();
    otx_match_weights weights = {.color = 1.0};
    otx_exemplar e = made(run);

    (void)state;
    weights.maps[OTX_COMPANION_ROUGHNESS] = 1.0;
    assert_int_equal(
        otx_match_maps_mix(run, &weights, &e), OSDTEX_ERROR_ARGUMENT);
    weights = (otx_match_weights){.color = NAN};
    assert_int_equal(
        otx_match_maps_mix(run, &weights, &e), OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_colour_alone_is_left),
        cmocka_unit_test(test_distances),
        cmocka_unit_test(test_normals_count_by_tilt),
        cmocka_unit_test(test_refusals),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

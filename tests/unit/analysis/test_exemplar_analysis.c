/* test_exemplar_analysis.c -- structure is seen in the space that colours are
 * compared in, where lightness does not show it. */
#include "support.h"

#include "analysis/exemplar_analysis.h"
#include "base/random.h"

enum
{
    SIDE = 256,
    CELL = 32
};

typedef enum paint
{
    NOISE,
    DISCS
} paint;

static void
fill(otx_image *image, int channel, paint what, double range)
{
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const double u = x % CELL - 15.5, v = y % CELL - 15.5;
            const double noise =
                otx_random_unit(5, (uint64_t)channel, (uint64_t)(y * SIDE + x));
            const double disc = u * u + v * v < 100.0 ? 1.0 : 0.0;

            otx_image_at(image, x, y)[channel] =
                (float)(range * (what == DISCS ? 0.8 * disc + 0.2 * noise : noise));
        }
}

/* Lightness, and channels 0 and 2 of what colours are compared in. */
static otx_exemplar
make(otx_run *run, paint light, paint first, paint last)
{
    otx_exemplar e = {.wrap_x = true, .wrap_y = true};

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &e.lab), OSDTEX_OK);
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &e.match), OSDTEX_OK);
    memset(e.lab.pixels, 0, sizeof(float) * 3 * SIDE * SIDE);
    memset(e.match.pixels, 0, sizeof(float) * 3 * SIDE * SIDE);
    fill(&e.lab, 0, light, 60.0);
    fill(&e.match, 0, first, 1.0);
    fill(&e.match, 2, last, 1.0);
    return e;
}

static void
assert_lattice(const otx_analysis *a)
{
    assert_int_equal(a->kind, OTX_ANALYSIS_LATTICE);
    assert_float_equal(a->generators[0].x, CELL, 0.5);
    assert_float_equal(a->generators[0].y, 0.0, 0.5);
    assert_float_equal(a->generators[1].x, 0.0, 0.5);
    assert_float_equal(a->generators[1].y, CELL, 0.5);
}

static void
what_lightness_shows_is_all_that_is_asked(void **state)
{
    const otx_exemplar e = make(*state, DISCS, NOISE, NOISE);
    otx_analysis a, of_light;

    assert_int_equal(otx_exemplar_analysis(*state, &e, &a), OSDTEX_OK);
    assert_lattice(&a);
    assert_int_equal(
        otx_analysis_run(*state, &e.lab, true, true, &of_light), OSDTEX_OK);
    assert_memory_equal(&a, &of_light, sizeof a);
}

/* Discs as light as what is around them. */
static void
what_only_colour_shows_is_seen(void **state)
{
    const otx_exemplar first = make(*state, NOISE, DISCS, NOISE);
    const otx_exemplar last = make(*state, NOISE, NOISE, DISCS);
    otx_analysis a;

    assert_int_equal(otx_exemplar_analysis(*state, &first, &a), OSDTEX_OK);
    assert_lattice(&a);
    assert_int_equal(otx_exemplar_analysis(*state, &last, &a), OSDTEX_OK);
    assert_lattice(&a);
}

static void
noise_stays_noise(void **state)
{
    const otx_exemplar e = make(*state, NOISE, NOISE, NOISE);
    otx_analysis a;

    assert_int_equal(otx_exemplar_analysis(*state, &e, &a), OSDTEX_OK);
    assert_int_equal(a.kind, OTX_ANALYSIS_ISOTROPIC);
}

/* A channel that says what lightness says, or little of anything. */
static void
what_tells_nothing_new_is_not_looked_at(void **state)
{
    otx_exemplar e = make(*state, NOISE, NOISE, NOISE);
    otx_image channel;

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        e.match.pixels[3 * i] = 0.01f * e.lab.pixels[3 * i];
        e.match.pixels[3 * i + 2] *= 0.1f;
    }
    assert_false(otx_exemplar_analysis_channel(&e, &channel));
    e.match.width /= 2;
    assert_false(otx_exemplar_analysis_channel(&e, &channel));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_lightness_shows_is_all_that_is_asked),
        test_with_run(what_only_colour_shows_is_seen),
        test_with_run(noise_stays_noise),
        test_with_run(what_tells_nothing_new_is_not_looked_at),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

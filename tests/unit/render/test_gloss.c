/* test_gloss.c -- light is neither made nor, by what is smooth, lost. */
#include "support.h"

#include "base/random.h"
#include "render/gloss.h"

#include <math.h>

static const otx_vec3 UP = {0.0, 0.0, 1.0};

static otx_vec3
tilted(double degrees)
{
    const double a = degrees * OTX_PI / 180.0;

    return (otx_vec3){sin(a), 0.0, cos(a)};
}

/* All that a mirror of F0 1 sends to the eye under a sky of 1: the mean over
 * directions as likely as their cosine, by which a light's share is told. */
static double
under_a_white_sky(otx_vec3 eye, double roughness)
{
    enum
    {
        N = 200000
    };
    double sum = 0.0;

    for (int i = 0; i < N; ++i)
    {
        const double r_sq = otx_random_unit(1, 1, (uint64_t)i);
        const double turn = 2.0 * OTX_PI * otx_random_unit(1, 2, (uint64_t)i);
        const otx_vec3 to = {
            sqrt(r_sq) * cos(turn), sqrt(r_sq) * sin(turn), sqrt(1.0 - r_sq)};
        const otx_gloss g = otx_gloss_light(UP, to, eye, roughness);

        if (to.z > 1e-6)
            sum += (g.facing + g.grazing) / to.z;
    }
    return sum / N;
}

static void
no_light_is_made(void **state)
{
    (void)state;
    for (int d = 0; d <= 75; d += 25)
    {
        assert_true(under_a_white_sky(tilted(d), 0.4) < 1.01);
        assert_true(under_a_white_sky(tilted(d), 1.0) < 1.01);
    }
    assert_true(under_a_white_sky(tilted(0.0), 0.4) > 0.95);
}

static void
light_and_eye_may_change_places(void **state)
{
    (void)state;
    for (int d = 5; d < 85; d += 20)
        for (int e = 5; e < 85; e += 20)
        {
            const otx_vec3 a = tilted(d), b = tilted(-e);
            const otx_gloss there = otx_gloss_light(UP, a, b, 0.5);
            const otx_gloss back = otx_gloss_light(UP, b, a, 0.5);

            assert_true(fabs(there.facing / a.z - back.facing / b.z) < 1e-9);
            assert_true(fabs(there.grazing / a.z - back.grazing / b.z) < 1e-9);
        }
}

/* The fit for the sky is near what the lights add up to. */
static void
the_sky_is_all_lights(void **state)
{
    (void)state;
    for (int d = 0; d <= 60; d += 30)
    {
        const otx_gloss sky = otx_gloss_sky(UP, tilted(d), 0.6);

        assert_true(
            fabs(sky.facing + sky.grazing - under_a_white_sky(tilted(d), 0.6)) <
            0.06);
    }
}

static void
what_lies_behind_is_not_mirrored(void **state)
{
    const otx_gloss g = otx_gloss_light(UP, tilted(120.0), tilted(10.0), 0.5);

    (void)state;
    assert_true(g.facing == 0.0 && g.grazing == 0.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_light_is_made),
        cmocka_unit_test(light_and_eye_may_change_places),
        cmocka_unit_test(the_sky_is_all_lights),
        cmocka_unit_test(what_lies_behind_is_not_mirrored),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

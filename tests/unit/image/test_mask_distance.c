/* test_mask_distance.c -- against all pairs of texels. */
#include "support.h"

#include "base/random.h"
#include "image/image.h"
#include "image/mask_distance.h"

#include <math.h>

enum
{
    WIDTH = 37,
    HEIGHT = 23,
    TEXELS = WIDTH * HEIGHT
};

static double
nearest_other(const uint8_t *mask, int32_t i)
{
    double best = (double)INFINITY;

    for (int32_t k = 0; k < TEXELS; ++k)
    {
        int32_t dx = abs(k % WIDTH - i % WIDTH);
        int32_t dy = abs(k / WIDTH - i / WIDTH);

        dx = dx > WIDTH - dx ? WIDTH - dx : dx;
        dy = dy > HEIGHT - dy ? HEIGHT - dy : dy;
        if (mask[k] != mask[i])
            best = fmin(best, hypot(dx, dy));
    }
    return best;
}

static void
check(otx_run *run, const uint8_t *mask)
{
    float out[TEXELS];

    assert_int_equal(
        otx_mask_distance(run, mask, WIDTH, HEIGHT, out), OSDTEX_OK);
    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const double d = nearest_other(mask, i) - 0.5;

        assert_float_equal(out[i], (mask[i] ? d : -d), 1e-5);
    }
}

static void
it_agrees_with_all_pairs(void **state)
{
    otx_run *run = test_run_create();
    uint8_t mask[TEXELS];

    (void)state;
    for (uint64_t seed = 0; seed < 6; ++seed)
    {
        const double share = seed < 3 ? 0.5 : 0.02;

        for (int32_t i = 0; i < TEXELS; ++i)
            mask[i] = otx_random_unit(seed, 1, (uint64_t)i) < share;
        check(run, mask);
    }
    test_run_destroy(run);
}

/* One texel, near the corner: distances go round. */
static void
a_single_texel_is_seen_over_the_border(void **state)
{
    otx_run *run = test_run_create();
    uint8_t mask[TEXELS] = {0};

    (void)state;
    mask[WIDTH + 1] = 1;
    check(run, mask);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_agrees_with_all_pairs),
        cmocka_unit_test(a_single_texel_is_seen_over_the_border),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

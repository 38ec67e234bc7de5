/* test_sharpen.c -- what bilinear lookups into sharpened texels give. */
#include "support.h"

#include "bake/sharpen.h"

#include <math.h>
#include <string.h>

enum
{
    SIDE = 32
};

typedef struct picture
{
    float in[SIDE * SIDE], out[SIDE * SIDE];
    int32_t owners[SIDE * SIDE];
} picture;

static void
sharpen(picture *p)
{
    const otx_sharpen_grid grid = {SIDE, SIDE, 1, p->in, p->owners};

    otx_sharpen_texels(&grid, 0, 0, SIDE, SIDE, p->out);
}

static void
fill(picture *p, float (*value)(int32_t x, int32_t y))
{
    memset(p->owners, 0, sizeof p->owners);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        p->in[i] = value(i % SIDE, i / SIDE);
}

static float
slope(int32_t x, int32_t y)
{
    return 0.25f * (float)x - 0.5f * (float)y;
}

static float
bowl(int32_t x, int32_t y)
{
    return 0.01f * (float)(x * x + y * y);
}

static float
step(int32_t x, int32_t y)
{
    (void)y;
    return x < 13 ? 0.0f : 1.0f;
}

static void
planes_stay(void **state)
{
    picture p;

    (void)state;
    fill(&p, slope);
    sharpen(&p);
    assert_memory_equal(p.in, p.out, sizeof p.in);
}

/* The mean of the bilinear surface over a square of texels is that of the
 * function: chords of x^2 are a sixth too high in the mean, and the texels a
 * sixth too low. */
static void
means_of_a_bowl_are_right(void **state)
{
    picture p;

    (void)state;
    fill(&p, bowl);
    sharpen(&p);
    for (int32_t y = 1; y + 2 < SIDE; ++y)
        for (int32_t x = 1; x + 2 < SIDE; ++x)
        {
            const float *q = p.out + y * SIDE + x;
            const double mean =
                0.25 * ((double)q[0] + q[1] + q[SIDE] + q[SIDE + 1]);
            const double right =
                0.01 * (x * x + x + 1.0 / 3.0 + y * y + y + 1.0 / 3.0);

            assert_true(fabs(mean - right) < 1e-5 * (1.0 + right));
        }
}

static void
an_edge_gets_no_rim(void **state)
{
    picture p;

    (void)state;
    fill(&p, step);
    sharpen(&p);
    assert_memory_equal(p.in, p.out, sizeof p.in);
}

/* Texels of another chart have no say, those beyond a rim do. */
static void
charts_are_kept_apart(void **state)
{
    picture p;

    (void)state;
    fill(&p, bowl);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        if (i % SIDE >= 20)
        {
            p.in[i] = 1000.0f;
            p.owners[i] = 1;
        }
    sharpen(&p);
    for (int32_t y = 1; y + 1 < SIDE; ++y)
    {
        const float *q = p.out + y * SIDE;

        assert_true(fabsf(q[19] - (bowl(19, y) - 0.01f / 6.0f)) < 1e-4f);
        assert_true(q[20] == 1000.0f);
    }
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        p.owners[i] = i % SIDE >= 20 ? -1 : 0;
    sharpen(&p);
    assert_true(p.out[SIDE + 19] < bowl(19, 1) - 0.01f);
}

/* A block with its apron gives what the whole gives. */
static void
blocks_are_parts_of_the_whole(void **state)
{
    picture p;
    float part[8 * 8];
    const otx_sharpen_grid grid = {SIDE, 10, 1, p.in + 4 * SIDE, p.owners};

    (void)state;
    fill(&p, bowl);
    sharpen(&p);
    otx_sharpen_texels(&grid, 5, 1, 8, 8, part);
    for (int32_t y = 0; y < 8; ++y)
        assert_memory_equal(
            part + 8 * y, p.out + (5 + y) * SIDE + 5, 8 * sizeof(float));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_stay),
        cmocka_unit_test(means_of_a_bowl_are_right),
        cmocka_unit_test(an_edge_gets_no_rim),
        cmocka_unit_test(charts_are_kept_apart),
        cmocka_unit_test(blocks_are_parts_of_the_whole),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_slices.c -- copies of the picture that show the mask. */
#include "support.h"

#include "stack/slices.h"

#include "base/random.h"

#include <math.h>

enum
{
    SIDE = 96,
    TEXELS = SIDE * SIDE,
    COUNT = 3
};

typedef struct scene
{
    otx_run *run;
    otx_image lab;
    uint8_t masks[COUNT][TEXELS];
    const uint8_t *list[COUNT];
    int32_t *made[COUNT];
} scene;

static bool
in_spot(int32_t i, double radius)
{
    return hypot(i % SIDE % 24 - 12, i / SIDE % 24 - 12) < radius;
}

/* Spots that grow from slice to slice, or stay. */
static scene *
set(int32_t threads, double growth)
{
    otx_run *run = test_run_create_with(NULL, threads);
    scene *s = OTX_ZNEW(run->arena, scene, 1);

    s->run = run;
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &s->lab), OSDTEX_OK);
    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const double grain =
            6.0 *
            otx_random_unit(2, 1, (uint64_t)(i / SIDE / 2 * 48 + i % SIDE / 2));

        s->lab.pixels[3 * i] = (float)((in_spot(i, 6.0) ? 20.0 : 70.0) + grain);
        s->lab.pixels[3 * i + 1] = (float)(0.5 * grain);
        s->lab.pixels[3 * i + 2] = in_spot(i, 6.0) ? 30.0f : 0.0f;
        for (int32_t m = 0; m < COUNT; ++m)
            s->masks[m][i] = in_spot(i, 6.0 + growth * m);
    }
    for (int32_t m = 0; m < COUNT; ++m)
        s->list[m] = s->masks[m];
    assert_int_equal(
        otx_slices_make(
            run, &(otx_slices_input){&s->lab, s->list, COUNT, 4.0, 0.8, 1},
            s->made),
        OSDTEX_OK);
    return s;
}

/* What is looked up in the mask of the picture is the mask that was asked for.
 */
static void
slices_show_their_masks(void **state)
{
    scene *s = set(2, 1.0);

    (void)state;
    for (int32_t m = 0; m < COUNT; ++m)
    {
        int32_t both = 0, any = 0;

        for (int32_t i = 0; i < TEXELS; ++i)
        {
            const int32_t from = s->made[m][i];

            assert_in_range(from, 0, TEXELS - 1);
            both += s->masks[0][from] && s->masks[m][i];
            any += s->masks[0][from] || s->masks[m][i];
        }
        assert_true((double)both / any >= 0.9);
    }
    test_run_destroy(s->run);
}

static void
what_does_not_change_stays(void **state)
{
    scene *s = set(2, 0.0);

    (void)state;
    for (int32_t m = 0; m < COUNT; ++m)
        for (int32_t i = 0; i < TEXELS; ++i)
            assert_int_equal(s->made[m][i], i);
    test_run_destroy(s->run);
}

/* How far two places are, along the axis along which they are farther. */
static int32_t
apart(int32_t a, int32_t b)
{
    int32_t dx = abs(a % SIDE - b % SIDE), dy = abs(a / SIDE - b / SIDE);

    dx = dx > SIDE / 2 ? SIDE - dx : dx;
    dy = dy > SIDE / 2 ? SIDE - dy : dy;
    return dx > dy ? dx : dy;
}

/* Slices that vary show the one mask by texels from elsewhere: 9 away, of which
 * the last step may take 3 back. */
static void
slices_that_vary_are_from_elsewhere(void **state)
{
    scene *s = set(2, 0.0);
    int32_t *varied[COUNT];

    (void)state;
    assert_int_equal(
        otx_slices_vary(
            s->run, &(otx_slices_input){&s->lab, s->list, COUNT, 4.0, 0.8, 1},
            varied),
        OSDTEX_OK);
    for (int32_t m = 1; m < COUNT; ++m)
    {
        int32_t near = 0, wrong = 0;

        for (int32_t i = 0; i < TEXELS; ++i)
        {
            for (int32_t k = 0; k < m; ++k)
                near += apart(varied[m][i], varied[k][i]) < 6;
            wrong += s->masks[0][varied[m][i]] != s->masks[0][i];
        }
        assert_true(near < TEXELS / 50);
        assert_true(wrong < TEXELS / 50);
    }
    test_run_destroy(s->run);
}

static void
the_same_on_any_number_of_threads(void **state)
{
    scene *one = set(1, 1.0), *many = set(4, 1.0);

    (void)state;
    for (int32_t m = 0; m < COUNT; ++m)
        assert_memory_equal(
            one->made[m], many->made[m], TEXELS * sizeof(int32_t));
    test_run_destroy(one->run);
    test_run_destroy(many->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slices_show_their_masks),
        cmocka_unit_test(what_does_not_change_stays),
        cmocka_unit_test(slices_that_vary_are_from_elsewhere),
        cmocka_unit_test(the_same_on_any_number_of_threads),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

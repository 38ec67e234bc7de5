/* test_slice_figures.c -- figures of slices that are known. */
#include "support.h"

#include "base/random.h"
#include "exemplar/statistics.h"
#include "stack/slice_figures.h"

#include <math.h>
#include <string.h>

enum
{
    SIDE = 32,
    TEXELS = SIDE * SIDE,
    COUNT = 3
};

/* A picture of which the left half is the feature, lighter by 40; two keys of
 * it, and slices that show it as it is. */
typedef struct scene
{
    otx_run *run;
    otx_exemplar picture;
    uint8_t masks[COUNT][TEXELS];
    int32_t same[TEXELS];
    otx_stack_key keys[2];
    otx_stack_slice slices[COUNT];
    otx_exemplar labs[COUNT];
    otx_stack stack;
} scene;

static scene *
create(void)
{
    otx_run *run = test_run_create();
    scene *s = OTX_ZNEW(run->arena, scene, 1);

    s->run = run;
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &s->picture.lab),
        OSDTEX_OK);
    s->picture.match = s->picture.lab;
    for (int32_t i = 0; i < TEXELS; ++i)
    {
        const bool inside = i % SIDE < SIDE / 2;

        s->same[i] = i;
        for (int m = 0; m < COUNT; ++m)
            s->masks[m][i] = inside;
        s->picture.lab.pixels[3 * i] =
            (float)((inside ? 70.0 : 30.0) + 10.0 * otx_random_unit(1, 1, (uint64_t)i));
    }
    assert_int_equal(otx_exemplar_measure(run, &s->picture), OSDTEX_OK);
    for (int m = 0; m < COUNT; ++m)
    {
        s->labs[m] = s->picture;
        s->slices[m] = (otx_stack_slice){
            .keys = {0, 1},
            .weight = 0.5 * m,
            .mask = s->masks[m],
            .texels = {m < 2 ? s->same : NULL, m > 0 ? s->same : NULL}};
    }
    s->keys[0] = s->keys[1] = (otx_stack_key){&s->picture, s->masks[0]};
    s->stack = (otx_stack){SIDE, SIDE, COUNT, s->slices, NULL};
    return s;
}

static otx_slice_figures
take(const scene *s)
{
    otx_slice_figures figures;

    assert_int_equal(
        otx_slice_figures_take(s->run, &s->stack, s->keys, s->labs, &figures),
        OSDTEX_OK);
    return figures;
}

static void
what_stays_is_perfect(void **state)
{
    scene *s = create();
    const otx_slice_figures f = take(s);

    (void)state;
    assert_float_equal(f.lookup, 1.0, 0.0);
    assert_float_equal(f.contrast_least, 1.0, 1e-9);
    assert_float_equal(f.contrast_most, 1.0, 1e-9);
    assert_float_equal(f.sharpness, 1.0, 1e-9);
    assert_float_equal(f.step, 1.0, 0.0);
    assert_float_equal(f.still, 0.0, 0.0);
    assert_float_equal(f.colours, 0.0, 0.0);
    test_run_destroy(s->run);
}

/* Two of the columns beside the feature are asked for in the middle slice, and
 * not shown: 16 of 18 are there, and what is outside looks as it did. */
static void
a_mask_that_is_not_shown(void **state)
{
    scene *s = create();
    otx_slice_figures f;

    (void)state;
    for (int32_t i = 0; i < TEXELS; ++i)
        s->masks[1][i] = i % SIDE < SIDE / 2 + 2;
    f = take(s);
    assert_float_equal(f.lookup, 16.0 / 18.0, 1e-9);
    assert_true(f.colours > 2.0 && f.colours < 6.0);
    /* They change there and back: as many from slice to slice. */
    assert_float_equal(f.flips_least, 1.0, 1e-9);
    assert_float_equal(f.flips_most, 1.0, 1e-9);
    test_run_destroy(s->run);
}

/* The last slice is another picture all over: one step is twice the median of
 * two, and it changes where no mask does. */
static void
a_jump(void **state)
{
    scene *s = create();
    otx_slice_figures f;
    otx_image jumped;

    (void)state;
    assert_int_equal(
        otx_image_create(s->run, s->run->arena, SIDE, SIDE, 3, &jumped),
        OSDTEX_OK);
    for (int32_t i = 0; i < 3 * TEXELS; ++i)
        jumped.pixels[i] = s->picture.lab.pixels[i] + 4.0f;
    s->labs[2].lab = jumped;
    f = take(s);
    assert_float_equal(f.step, 2.0, 1e-6);
    assert_float_equal(f.still, 4.0 * sqrt(3.0), 1e-4);
    test_run_destroy(s->run);
}

/* Half the contrast and half the step of the picture. */
static void
a_flat_slice(void **state)
{
    scene *s = create();
    otx_slice_figures f;

    (void)state;
    s->labs[1].lab_sigma *= 0.5;
    s->labs[1].lab_step *= 0.25;
    f = take(s);
    assert_float_equal(f.contrast_least, 0.5, 1e-9);
    assert_float_equal(f.contrast_most, 1.0, 1e-9);
    assert_float_equal(f.sharpness, 0.25, 1e-9);
    test_run_destroy(s->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stays_is_perfect),
        cmocka_unit_test(a_mask_that_is_not_shown),
        cmocka_unit_test(a_jump),
        cmocka_unit_test(a_flat_slice),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_morph.c -- both ends are met, and equally much changes on the way. */
#include "support.h"

#include "stack/morph.h"

#include <math.h>

enum
{
    SIDE = 64,
    TEXELS = SIDE * SIDE
};

static void
paint_spots(uint8_t *mask)
{
    for (int32_t i = 0; i < TEXELS; ++i)
        mask[i] = hypot(i % SIDE % 16 - 8, i / SIDE % 16 - 8) < 4.5;
}

static void
paint_stripes(uint8_t *mask)
{
    for (int32_t i = 0; i < TEXELS; ++i)
        mask[i] = (i % SIDE + i / SIDE) % 16 < 6;
}

static const otx_morph_kind KINDS[] = {
    OTX_MORPH_AUTO, OTX_MORPH_ADVECT, OTX_MORPH_RELAX, OTX_MORPH_LINEAR};

static otx_morph
make(otx_run *run, otx_morph_kind kind, const uint8_t *a, const uint8_t *b)
{
    otx_morph morph;

    assert_int_equal(
        otx_morph_make(
            run, a, b, SIDE, SIDE,
            &(otx_morph_options){.kind = kind, .slices = 6}, &morph),
        OSDTEX_OK);
    return morph;
}

static void
ends_are_exact_and_steps_even(void **state)
{
    otx_run *run = test_run_create();
    uint8_t a[TEXELS], b[TEXELS];

    (void)state;
    paint_spots(a);
    paint_stripes(b);
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; ++k)
    {
        const otx_morph m = make(run, KINDS[k], a, b);

        assert_int_equal(m.slices, 6);
        assert_memory_equal(m.masks[0], a, TEXELS);
        assert_memory_equal(m.masks[5], b, TEXELS);
        /* In a picture this small a step moves much. */
        assert_true((double)m.flips_most <= 1.5 * m.flips_mean);
    }
    test_run_destroy(run);
}

/* What is published sweeps by the first mask's distances, and stays behind. */
static void
the_sweep_by_the_target_leaves_fewer_crumbs(void **state)
{
    otx_run *run = test_run_create();
    otx_morph_options options = {.kind = OTX_MORPH_ADVECT, .slices = 6};
    uint8_t a[TEXELS], b[TEXELS];
    otx_morph ours, printed;

    (void)state;
    paint_spots(a);
    paint_stripes(b);
    assert_int_equal(
        otx_morph_make(run, a, b, SIDE, SIDE, &options, &ours), OSDTEX_OK);
    options.sweep_by_first = options.whole_steps = true;
    assert_int_equal(
        otx_morph_make(run, a, b, SIDE, SIDE, &options, &printed), OSDTEX_OK);
    assert_true(ours.crumbs <= printed.crumbs);
    assert_memory_equal(printed.masks[5], b, TEXELS);
    test_run_destroy(run);
}

static void
the_same_on_any_number_of_threads(void **state)
{
    otx_run *one = test_run_create_with(NULL, 1);
    otx_run *many = test_run_create_with(NULL, 4);
    uint8_t a[TEXELS], b[TEXELS];

    (void)state;
    paint_spots(a);
    paint_stripes(b);
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; ++k)
    {
        const otx_morph p = make(one, KINDS[k], a, b);
        const otx_morph q = make(many, KINDS[k], a, b);

        for (int32_t m = 0; m < 6; ++m)
            assert_memory_equal(p.masks[m], q.masks[m], TEXELS);
    }
    test_run_destroy(one);
    test_run_destroy(many);
}

static void
masks_without_a_feature_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_morph_options options = {.slices = 4};
    uint8_t a[TEXELS], empty[TEXELS] = {0};
    otx_morph m;

    (void)state;
    paint_spots(a);
    assert_int_equal(
        otx_morph_make(run, a, empty, SIDE, SIDE, &options, &m),
        OSDTEX_ERROR_FORMAT);
    memset(empty, 1, sizeof empty);
    assert_int_equal(
        otx_morph_make(run, empty, a, SIDE, SIDE, &options, &m),
        OSDTEX_ERROR_FORMAT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_are_exact_and_steps_even),
        cmocka_unit_test(the_sweep_by_the_target_leaves_fewer_crumbs),
        cmocka_unit_test(the_same_on_any_number_of_threads),
        cmocka_unit_test(masks_without_a_feature_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

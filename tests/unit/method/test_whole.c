/* test_whole.c -- what is pasted of an exemplar of squares is whole squares. */
#include "unit/method/pastes.h"

#include "method/lapped/whole.h"

enum
{
    FACES = 24,
    STEP = 16 /* from square to square, texels */
};

/* A sheet on which one square lies beside the other. */
static paste_bench *
squares(otx_run *run, int32_t mode)
{
    paste_bench *b = paste_bench_create(
        run, sheet_create(run, FACES, FACES, SHEET_FLAT), 6.0);
    float *lab = b->exemplar->lab.pixels;

    for (int32_t i = 0; i < 64 * 64; ++i)
    {
        const bool joint = i % STEP < 4 || i / 64 % STEP < 4;

        lab[3 * i] = joint ? 20.0f : 70.0f;
        lab[3 * i + 1] = lab[3 * i + 2] = 0.0f;
    }
    b->l.settings = (otx_lapped_settings){.radius = 30.0, .mode = mode};
    assert_int_equal(
        otx_lapped_find_features(&b->l, OTX_ANALYSIS_ISOTROPIC), OSDTEX_OK);
    return b;
}

static otx_lapped_paste
choose(paste_bench *b, double size, const int32_t *uses)
{
    const double reach = otx_lapped_whole_reach(&b->l);
    const otx_radial outline = paste_circle(reach, 2.0);
    const otx_lapped_try attempt = {7, size, 0.0, uses};
    otx_lapped_paste p = {.chart = paste_unfold(b, 12 * FACES + 12, &outline)};

    assert_int_equal(
        otx_lapped_choose_features(&b->l, b->run->arena, &attempt, &p),
        OSDTEX_OK);
    return p;
}

static void
the_mode_follows_what_is_shown(void **state)
{
    paste_bench *b = squares(*state, OTX_LAPPED_AUTO);

    assert_int_equal(b->l.settings.mode, OTX_LAPPED_PACKING);
    assert_int_equal(b->l.features.count, 16);
    for (int32_t i = 0; i < 16; ++i)
    {
        assert_true(b->l.feature_cuts[i].least > 5.0f);
        assert_true(b->l.feature_cuts[i].most < 12.0f);
    }
    b = squares(*state, OTX_LAPPED_AUTO);
    b->l.settings.mode = OTX_LAPPED_AUTO;
    assert_int_equal(
        otx_lapped_find_features(&b->l, OTX_ANALYSIS_LATTICE), OSDTEX_OK);
    assert_int_equal(b->l.settings.mode, OTX_LAPPED_SPLOTCH);
}

/* Middles of pieces are middles of squares, and none is named twice. */
static void
pieces_are_whole_features(void **state)
{
    static const int32_t uses[16] = {0};
    static const double sizes[] = {1.0, 0.5};

    for (int i = 0; i < 2; ++i)
    {
        paste_bench *b = squares(*state, OTX_LAPPED_PACKING);
        const otx_lapped_paste p = choose(b, sizes[i], uses);

        assert_true(p.piece_count >= 1);
        for (int32_t k = 0; k < p.piece_count; ++k)
        {
            const otx_vec2 at = otx_vec2_add(p.centre, p.pieces[k].middle);
            const double x = at.x - STEP * floor(at.x / STEP);
            const double y = at.y - STEP * floor(at.y / STEP);

            assert_float_equal(x, 10.0, 1.5);
            assert_float_equal(y, 10.0, 1.5);
            for (int32_t m = 0; m < k; ++m)
                assert_true(
                    otx_vec2_length(otx_vec2_sub(
                        p.pieces[k].middle, p.pieces[m].middle)) > 12.0);
        }
    }
}

/* Where all is taken stones do not fit; leaves do. */
static void
stones_leave_others_alone(void **state)
{
    static const int32_t uses[16] = {0};

    for (int i = 0; i < 2; ++i)
    {
        paste_bench *b =
            squares(*state, i ? OTX_LAPPED_CLUMPS : OTX_LAPPED_PACKING);

        memset(
            b->l.samples.covered, 1, (size_t)b->l.samples.first[FACES * FACES]);
        /* Only the seed's face is open. */
        memset(
            b->l.samples.covered + b->l.samples.first[12 * FACES + 12], 0,
            (size_t)otx_samples_count(&b->l.samples, 12 * FACES + 12));
        assert_int_equal(choose(b, 1.0, uses).piece_count > 0, i);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(the_mode_follows_what_is_shown),
        test_with_run(pieces_are_whole_features),
        test_with_run(stones_leave_others_alone),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

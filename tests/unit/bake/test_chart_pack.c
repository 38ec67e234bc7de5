/* test_chart_pack.c -- charts that are apart by their margins, on their tiles,
 * as large as they were asked for. */
#include "support.h"

#include "bake/chart_pack.h"
#include "base/random.h"

enum
{
    CHARTS = 40,
    SIDES = 5,
    SIDE = 512,
    MARGIN = 8
};

static otx_chart_rims
polygons(otx_run *run)
{
    int32_t *first = OTX_NEW(run->arena, int32_t, CHARTS + 1);
    otx_vec2 *ends = OTX_NEW(run->arena, otx_vec2, 2 * CHARTS * SIDES);

    for (int32_t i = 0; i <= CHARTS; ++i)
        first[i] = SIDES * i;
    for (int32_t i = 0; i < CHARTS; ++i)
        for (int32_t k = 0; k < SIDES; ++k)
        {
            const double size = 0.5 + 4.0 * otx_random_unit(1, 0, (uint64_t)i);

            for (int32_t e = 0; e < 2; ++e)
                ends[2 * (SIDES * i + k) + e] = otx_vec2_scale(
                    size, otx_vec2_polar(
                              2.0 * OTX_PI * ((k + e) % SIDES) / SIDES + i));
        }
    return (otx_chart_rims){CHARTS, first, ends};
}

static otx_vec2
placed(
    const otx_chart_rims *rims, const otx_chart_packing *packing, int32_t chart,
    int32_t k)
{
    const otx_chart_place *place = &packing->places[chart];

    return otx_vec2_add(
        place->shift,
        otx_vec2_scale(
            packing->scale,
            otx_vec2_mul(
                place->turn, rims->ends[2 * (rims->first[chart] + k)])));
}

/* Points along two rims are farther apart than a margin, and neither contains
 * the other: the middles are apart by more than the smaller radius. */
static double
gap(const otx_chart_rims *rims, const otx_chart_packing *packing, int32_t a,
    int32_t b)
{
    double least = INFINITY;

    for (int32_t i = 0; i < 20 * SIDES; ++i)
        for (int32_t j = 0; j < 20 * SIDES; ++j)
        {
            const otx_vec2 p = otx_vec2_lerp(
                placed(rims, packing, a, i / 20),
                placed(rims, packing, a, (i / 20 + 1) % SIDES), i % 20 / 20.0);
            const otx_vec2 q = otx_vec2_lerp(
                placed(rims, packing, b, j / 20),
                placed(rims, packing, b, (j / 20 + 1) % SIDES), j % 20 / 20.0);

            least = fmin(least, otx_vec2_length(otx_vec2_sub(p, q)));
        }
    return least;
}

static void
check(const otx_chart_rims *rims, const otx_chart_packing *packing)
{
    for (int32_t a = 0; a < CHARTS; ++a)
    {
        assert_in_range(packing->places[a].tile, 0, packing->tile_count - 1);
        for (int32_t k = 0; k < SIDES; ++k)
        {
            const otx_vec2 p = placed(rims, packing, a, k);

            assert_true(fmin(p.x, p.y) > MARGIN - 1e-6);
            assert_true(fmax(p.x, p.y) < SIDE - MARGIN + 1e-6);
        }
        for (int32_t b = 0; b < a; ++b)
            if (packing->places[a].tile == packing->places[b].tile)
                assert_true(gap(rims, packing, a, b) > 1.5 * MARGIN);
    }
}

static void
charts_keep_their_margins(void **state)
{
    otx_run *run = test_run_create();
    const otx_chart_rims rims = polygons(run);
    otx_chart_packing one, many;

    (void)state;
    assert_int_equal(
        otx_chart_pack(run, &rims, SIDE, MARGIN, 0.0, &one), OSDTEX_OK);
    assert_int_equal(one.tile_count, 1);
    check(&rims, &one);
    assert_int_equal(
        otx_chart_pack(run, &rims, SIDE, MARGIN, 2.0 * one.scale, &many),
        OSDTEX_OK);
    assert_true(many.tile_count >= 3 && many.scale == 2.0 * one.scale);
    check(&rims, &many);
    /* One that is larger than a tile. */
    assert_int_equal(
        otx_chart_pack(run, &rims, SIDE, MARGIN, 1000.0, &many),
        OSDTEX_ERROR_LIMIT);
    test_run_destroy(run);
}

/* The four edges of a square about the origin. */
static void
put_square(otx_vec2 *ends, double side)
{
    static const double corners[][2] = {
        {-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

    for (int32_t k = 0; k < 4; ++k)
        for (int32_t e = 0; e < 2; ++e)
            ends[2 * k + e] = (otx_vec2){
                side * corners[(k + e) % 4][0], side * corners[(k + e) % 4][1]};
}

/* A frame that fills a tile, and what fits into it. */
static void
holes_are_filled(void **state)
{
    static const int32_t first[] = {0, 8, 12, 16, 20, 24};
    otx_run *run = test_run_create();
    otx_vec2 ends[2 * 24];
    const otx_chart_rims rims = {5, first, ends};
    otx_chart_packing packing;

    (void)state;
    put_square(ends, 10.0);
    put_square(ends + 8, 6.0);
    for (int32_t i = 0; i < 4; ++i)
        put_square(ends + 16 + 8 * i, 2.0);
    assert_int_equal(
        otx_chart_pack(run, &rims, SIDE, MARGIN, 48.0, &packing), OSDTEX_OK);
    assert_int_equal(packing.tile_count, 1);
    /* Inside of the frame by both margins. */
    for (int32_t i = 1; i < 5; ++i)
    {
        const otx_vec2 d =
            otx_vec2_sub(packing.places[i].shift, packing.places[0].shift);

        assert_true(fmax(fabs(d.x), fabs(d.y)) < 48.0 * (3.0 - 1.0) - MARGIN);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(charts_keep_their_margins),
        cmocka_unit_test(holes_are_filled),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

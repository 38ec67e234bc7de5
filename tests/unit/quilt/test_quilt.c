/* test_quilt.c -- seams are the cheapest there are, and never become dearer. */
#include "support.h"

#include "base/random.h"
#include "quilt/quilt.h"

enum
{
    SIDE = 4,
    TEXELS = SIDE * SIDE,
    SHEETS = 3
};

/* Sheets of texels of random colours, of which sheet 0 covers all. */
typedef struct fixture
{
    otx_run *run;
    otx_exemplar exemplar;
    otx_texel_pool pool;
    otx_quilt quilt;
} fixture;

static void
begin(fixture *f, uint64_t seed)
{
    f->run = test_run_create();
    f->exemplar = (otx_exemplar){0};
    assert_int_equal(
        otx_image_create(
            f->run, f->run->arena, SIDE, SHEETS * SIDE, 3, &f->exemplar.lab),
        OSDTEX_OK);
    for (int32_t i = 0; i < 3 * SHEETS * TEXELS; ++i)
        f->exemplar.lab.pixels[i] =
            (float)(100.0 * otx_random_unit(seed, 0, (uint64_t)i));
    f->exemplar.linear = f->exemplar.match = f->exemplar.lab;
    assert_int_equal(
        otx_texel_pool_create(
            f->run, f->run->arena, &f->exemplar, &f->exemplar.lab, 0, &f->pool),
        OSDTEX_OK);
    assert_int_equal(
        otx_quilt_create(
            f->run, f->run->arena, &f->pool, SIDE, SIDE, &f->quilt),
        OSDTEX_OK);
    for (int32_t s = 0; s < SHEETS; ++s)
    {
        otx_texel_map map;

        assert_int_equal(
            otx_texel_map_create(f->run, f->run->arena, SIDE, SIDE, &map),
            OSDTEX_OK);
        for (int32_t i = 0; i < TEXELS; ++i)
            map.texels[i] = s * TEXELS + i;
        assert_int_equal(otx_quilt_add(&f->quilt, 0, 0, map), s);
    }
}

static void
lock(fixture *f, int32_t x, int32_t sheet)
{
    for (int32_t y = 0; y < SIDE; ++y)
        f->quilt.locks[otx_quilt_at(&f->quilt, x, y)] = (uint8_t)sheet;
}

static int64_t
price(otx_quilt *quilt)
{
    otx_quilt_price(quilt);
    return quilt->cost;
}

/* The left column is sheet 0 and the right one sheet 1: all ways to divide the
 * eight texels between them. */
static void
an_expansion_is_the_cheapest_cut(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; ++seed)
    {
        fixture f;
        int64_t least = INT64_MAX;

        begin(&f, seed);
        lock(&f, 0, 0);
        lock(&f, SIDE - 1, 1);
        for (int32_t y = 0; y < SIDE; ++y)
            f.quilt.labels[otx_quilt_at(&f.quilt, SIDE - 1, y)] = 1;
        for (int32_t choice = 0; choice < 1 << 2 * SIDE; ++choice)
        {
            int64_t cost;

            for (int32_t i = 0; i < 2 * SIDE; ++i)
                f.quilt.labels[otx_quilt_at(&f.quilt, 1 + i % 2, i / 2)] =
                    choice >> i & 1;
            cost = price(&f.quilt);
            least = cost < least ? cost : least;
        }
        otx_quilt_fill(&f.quilt, 0);
        for (int32_t y = 0; y < SIDE; ++y)
            f.quilt.labels[otx_quilt_at(&f.quilt, SIDE - 1, y)] = 1;
        otx_quilt_price(&f.quilt);
        assert_int_equal(otx_quilt_expand(f.run, &f.quilt, 1), OSDTEX_OK);
        assert_true(price(&f.quilt) == least);
        test_run_destroy(f.run);
    }
}

static void
no_move_costs_and_locks_hold(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; ++seed)
    {
        fixture f;
        int64_t cost;

        begin(&f, seed);
        lock(&f, 0, 2);
        lock(&f, SIDE - 1, 1);
        for (int32_t i = 0; i < TEXELS; ++i)
            f.quilt.labels[i] = (uint8_t)(i % SIDE == 0          ? 2
                                          : i % SIDE == SIDE - 1 ? 1
                                                                 : i % SHEETS);
        cost = price(&f.quilt);
        for (int32_t s = 0; s < SHEETS; ++s)
        {
            const int64_t before = cost;

            assert_int_equal(otx_quilt_expand(f.run, &f.quilt, s), OSDTEX_OK);
            cost = price(&f.quilt);
            assert_true(cost <= before);
        }
        assert_int_equal(otx_quilt_settle(f.run, &f.quilt, 4), OSDTEX_OK);
        assert_true(f.quilt.cost <= cost);
        assert_true(f.quilt.cost == price(&f.quilt));
        for (int32_t y = 0; y < SIDE; ++y)
        {
            assert_int_equal(
                otx_quilt_texel(&f.quilt, 0, y), 2 * TEXELS + y * SIDE);
            assert_int_equal(
                otx_quilt_texel(&f.quilt, SIDE - 1, y),
                TEXELS + y * SIDE + SIDE - 1);
        }
        test_run_destroy(f.run);
    }
}

/* What is alike on both sheets can be cut for nothing. */
static void
equal_sheets_have_no_seams(void **state)
{
    fixture f;

    (void)state;
    begin(&f, 1);
    memcpy(
        f.quilt.sheets[1].map.texels, f.quilt.sheets[0].map.texels,
        TEXELS * sizeof(int32_t));
    for (int32_t i = 0; i < TEXELS; ++i)
        f.quilt.labels[i] = (uint8_t)(i * 7 % 3 == 0);
    assert_true(price(&f.quilt) == 0);
    assert_float_equal(otx_quilt_measure(&f.quilt).mean, 0.0, 0.0);
    test_run_destroy(f.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_expansion_is_the_cheapest_cut),
        cmocka_unit_test(no_move_costs_and_locks_hold),
        cmocka_unit_test(equal_sheets_have_no_seams),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_patch_search.c -- what was copied is found, turned any way; seams only
 * become cheaper. */
#include "quilt/patchwork.h"

#include "base/random.h"
#include "support.h"

enum
{
    SIDE = 96,
    SIZE = 24
};

static void
set_color(otx_texel_pool *pool, int32_t texel, const float color[3])
{
    memcpy(pool->colors + 3 * (size_t)texel, color, 3 * sizeof *color);
}

/* Blobs, so that low frequencies tell places apart, and grain. */
static otx_texel_pool
make_pool(otx_run *run, otx_exemplar *exemplar)
{
    const size_t count = (size_t)SIDE * SIDE;
    otx_texel_pool pool = {
        .exemplar = exemplar,
        .width = SIDE,
        .height = SIDE,
        .count = SIDE * SIDE,
        .capacity = SIDE * SIDE,
        .colors = OTX_NEW(run->arena, float, 3 * 2 * count),
    };

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const int32_t x = i % SIDE, y = i / SIDE;
        const uint64_t blob = (uint64_t)(x / 5 + 1000 * (y / 5));
        const float color[3] = {
            (float)(60.0 * otx_random_unit(1, 1, blob) + 5.0 * otx_random_unit(1, 2, (uint64_t)i)),
            (float)(20.0 * otx_random_unit(1, 3, blob)),
            (float)(20.0 * otx_random_unit(1, 4, blob))};

        set_color(&pool, i, color);
    }
    return pool;
}

static otx_patch_search
make_search(otx_run *run, const otx_texel_pool *pool)
{
    const otx_patch_bounds all = {0, 0, SIDE - SIZE + 1, SIDE - SIZE + 1};
    otx_patch_search search;

    assert_int_equal(
        otx_patch_search_create(run, pool, SIZE, &all, 1, &search), OSDTEX_OK);
    return search;
}

/* The picture is a copy under other numbers: what is there already is left
 * out. */
static void
test_copies_are_found(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar exemplar = {0};
    otx_texel_pool pool = make_pool(run, &exemplar);
    const otx_patch_search search = make_search(run, &pool);

    (void)state;
    for (int32_t turns = 0; turns < 4; ++turns)
    {
        const otx_texel_window window = {31 + turns, 7 + 3 * turns, turns};
        otx_texel_window found[3];
        otx_texel_map map;

        assert_int_equal(
            otx_texel_map_create(run, run->arena, SIZE, SIZE, &map), OSDTEX_OK);
        otx_texel_pool_lay(&pool, window, &map);
        for (int32_t i = 0; i < SIZE * SIZE; ++i)
        {
            set_color(&pool, pool.count + i, pool.colors + 3 * map.texels[i]);
            map.texels[i] = pool.count + i;
        }
        assert_int_equal(otx_patch_search_find(&search, &map, 3, found), 3);
        assert_memory_equal(&found[0], &window, sizeof window);
        otx_texel_pool_lay(&pool, window, &map);
        assert_true(otx_patch_search_find(&search, &map, 3, found) > 0);
        assert_memory_not_equal(&found[0], &window, sizeof window);
    }
    test_run_destroy(run);
}

/* Two halves of other places side by side. */
static void
test_seams_become_cheaper(void **state)
{
    const otx_patchwork_options options = {.spots = 20, .patches = 3};
    otx_run *run = test_run_create();
    otx_exemplar exemplar = {0};
    const otx_texel_pool pool = make_pool(run, &exemplar);
    const otx_patch_search search = make_search(run, &pool);
    otx_quilt *quilt = OTX_NEW(run->arena, otx_quilt, 1);
    int64_t before, after;

    (void)state;
    assert_int_equal(
        otx_quilt_create(run, run->arena, &pool, 48, 48, quilt), OSDTEX_OK);
    for (int32_t i = 0; i < 2; ++i)
    {
        otx_texel_map map;

        assert_int_equal(
            otx_texel_map_create(run, run->arena, 48, 48, &map), OSDTEX_OK);
        otx_texel_pool_lay(
            &pool, (otx_texel_window){3 + 40 * i, 11 * i, i}, &map);
        otx_quilt_add(quilt, 0, 0, map);
    }
    for (int32_t i = 0; i < 48 * 48; ++i)
    {
        quilt->labels[i] = i % 48 < 24 ? 0 : 1;
        if (i % 48 < 4 || i % 48 >= 44)
            quilt->locks[i] = quilt->labels[i];
    }
    otx_quilt_price(quilt);
    before = quilt->cost;
    assert_int_equal(
        otx_patchwork_mend(run, &search, &options, quilt), OSDTEX_OK);
    after = quilt->cost;
    assert_true(after < before / 2);
    otx_quilt_price(quilt);
    assert_int_equal(quilt->cost, after);
    for (int32_t i = 0; i < 48 * 48; ++i)
        if (quilt->locks[i] != OTX_QUILT_FREE)
            assert_int_equal(quilt->labels[i], quilt->locks[i]);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_copies_are_found),
        cmocka_unit_test(test_seams_become_cheaper),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

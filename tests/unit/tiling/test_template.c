/* test_template.c -- corners and edges are made of the exemplar's texels. */
#include "tiles.h"

static void
check_map(const tiles *t, const otx_texel_map *map)
{
    for (int32_t i = 0; i < map->width * map->height; ++i)
        if (map->texels[i] != OTX_TEXEL_NONE)
            assert_in_range(map->texels[i], 0, t->pool.count - 1);
}

static void
pieces_are_in_the_pool(void **state)
{
    tiles *t = tiles_prepare(2, 21);
    const int32_t strips =
        4 * t->kit.boundary_count * t->kit.corner_count * t->kit.corner_count;

    (void)state;
    assert_true(t->pool.count <= t->pool.capacity);
    for (int32_t i = 0; i < t->kit.corner_count; ++i)
        check_map(t, &t->kit.corners[i].map);
    for (int32_t i = 0; i < strips; ++i)
        check_map(t, &t->kit.strips[i].map);
    test_run_destroy(t->run);
}

static void
threads_do_not_matter(void **state)
{
    tiles *t[2] = {tiles_prepare(1, 22), tiles_prepare(3, 22)};

    (void)state;
    assert_int_equal(t[0]->pool.count, t[1]->pool.count);
    for (int32_t i = 0; i < t[0]->kit.corner_count; ++i)
    {
        const otx_texel_map *a = &t[0]->kit.corners[i].map;
        const otx_texel_map *b = &t[1]->kit.corners[i].map;

        assert_int_equal(a->width, b->width);
        assert_memory_equal(
            a->texels, b->texels,
            sizeof *a->texels * (size_t)(a->width * a->height));
    }
    for (int k = 0; k < 2; ++k)
        test_run_destroy(t[k]->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_in_the_pool),
        cmocka_unit_test(threads_do_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

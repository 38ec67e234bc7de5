/* test_window_search.c -- a window is found where it was cut from. */
#include "quilt/window_search.h"

#include "grid.h"

enum
{
    WIDTH = 120,
    HEIGHT = 96,
    WINDOW = 24
};

typedef struct scene
{
    otx_run *run;
    otx_texel_pool pool;
    otx_window_search search;
    otx_texel_map map;
} scene;

static scene *
begin(bool wrap)
{
    otx_run *run = test_run_create();
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    const otx_exemplar *e =
        test_exemplar_create(run->arena, WIDTH, HEIGHT, wrap, 9);

    assert_int_equal(
        otx_texel_pool_create(run, run->arena, e, &e->match, 0, &s->pool),
        OSDTEX_OK);
    assert_int_equal(
        otx_window_search_create(run, run->arena, &s->pool, WINDOW, &s->search),
        OSDTEX_OK);
    assert_int_equal(
        otx_texel_map_create(run, run->arena, WINDOW, WINDOW, &s->map),
        OSDTEX_OK);
    s->run = run;
    return s;
}

static void
a_window_is_found_where_it_was_cut(void **state)
{
    static const otx_texel_window places[] = {
        {0, 0, 0}, {31, 17, 0}, {WIDTH - WINDOW, 40, 0}};
    scene *s = begin(false);

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        otx_texel_window found[4];
        int32_t count;

        otx_texel_pool_lay(&s->pool, places[i], &s->map);
        assert_int_equal(
            otx_window_search_find(
                s->run, &s->search, &s->map, 4, found, &count),
            OSDTEX_OK);
        assert_in_range(count, 1, 4);
        assert_memory_equal(&found[0], &places[i], sizeof found[0]);
        for (int32_t k = 0; k < count; ++k)
        {
            assert_in_range(found[k].x, 0, WIDTH - WINDOW);
            assert_in_range(found[k].y, 0, HEIGHT - WINDOW);
        }
    }
    test_run_destroy(s->run);
}

static void
holes_do_not_count(void **state)
{
    const otx_texel_window place = {52, 33, 0};
    scene *s = begin(true);
    otx_texel_window found;
    int32_t count;

    (void)state;
    otx_texel_pool_lay(&s->pool, place, &s->map);
    for (int32_t i = 0; i < WINDOW * WINDOW / 3; ++i)
        s->map.texels[i] = OTX_TEXEL_NONE;
    assert_int_equal(
        otx_window_search_find(s->run, &s->search, &s->map, 1, &found, &count),
        OSDTEX_OK);
    assert_int_equal(count, 1);
    assert_memory_equal(&found, &place, sizeof found);
    test_run_destroy(s->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_window_is_found_where_it_was_cut),
        cmocka_unit_test(holes_do_not_count),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

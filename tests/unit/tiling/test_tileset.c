/* test_tileset.c -- options are judged before anything is made, and a picture
 * of one colour makes tiles of that colour. */
#include "tiles.h"

static void
check_refusal(
    otx_run *run, const otx_tileset_options *options, const char *words)
{
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 24, 24, false, 1);
    otx_tileset made;

    assert_int_not_equal(
        otx_tileset_make(run, exemplar, options, &made), OSDTEX_OK);
    if (!strstr(test_last_message(run), words))
        fail_msg("'%s' lacks '%s'", test_last_message(run), words);
}

static void
bad_options_are_refused(void **state)
{
    const otx_tileset_options good = {
        .boundaries = 1, .corners = 1, .cell = 16, .gutter = 2};
    const otx_tileset_edge edge = {{2.0, 2.0}, 0.0, 0.0};
    otx_run *run = test_run_create();
    otx_tileset_options o = good;

    (void)state;
    o.boundaries = 4;
    check_refusal(run, &o, "1, 2 or 3 boundaries");
    o = good;
    o.cell = 24;
    check_refusal(run, &o, "power of two");
    o = good;
    o.cell = 64;
    check_refusal(run, &o, "larger picture");
    o = good;
    o.gutter = 4;
    check_refusal(run, &o, "8 gutters");
    o = good;
    o.edge_count = 1;
    o.edges = &edge;
    check_refusal(run, &o, "edge template 1");
    test_run_destroy(run);
}

static void
one_colour_makes_tiles_of_it(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 16, .gutter = 2};
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, 48, 48, true, 1);
    otx_tile_layout planned;
    otx_tileset made;

    (void)state;
    for (int32_t i = 0; i < 48 * 48 * 3; ++i)
        e->linear.pixels[i] = e->match.pixels[i] = 0.25f * (float)(i % 3 + 1);
    assert_int_equal(otx_tileset_plan(run, e, &options, &planned), OSDTEX_OK);
    assert_int_equal(otx_tileset_make(run, e, &options, &made), OSDTEX_OK);
    assert_int_equal(made.layout.cell, planned.cell);
    for (int32_t y = 0; y < made.linear.height; ++y)
        for (int32_t x = 0; x < made.linear.width; ++x)
            for (int32_t c = 0; c < 3; ++c)
                assert_true(
                    otx_image_at(&made.linear, x, y)[c] ==
                    0.25f * (float)(c + 1));
    assert_true(made.corner_seam == 0.0 && made.strip_seam == 0.0);
    assert_true(made.inner_seam == 0.0 && made.random_pair == 0.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(one_colour_makes_tiles_of_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

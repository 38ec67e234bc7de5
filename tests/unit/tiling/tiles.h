/* tiles.h -- a small exemplar and what a set of tiles is made of. */
#ifndef OTX_TESTS_TILES_H
#define OTX_TESTS_TILES_H

#include "grid.h"

#include "tiling/template.h"

typedef struct tiles
{
    otx_run *run;
    otx_exemplar *exemplar;
    otx_tileset_options options;
    otx_tile_layout layout;
    otx_texel_pool pool;
    otx_frame_kit kit;
} tiles;

/* Corners and strips of a set of one boundary and two corners. */
static inline tiles *
tiles_prepare(int32_t threads, uint64_t seed)
{
    otx_run *run = test_run_create_with(NULL, threads);
    tiles *t = OTX_ZNEW(run->arena, tiles, 1);

    t->run = run;
    t->exemplar = test_exemplar_create(run->arena, 64, 64, true, seed);
    t->options = (otx_tileset_options){
        .boundaries = 1, .corners = 2, .cell = 16, .gutter = 2};
    assert_int_equal(
        otx_tileset_plan(run, t->exemplar, &t->options, &t->layout), OSDTEX_OK);
    t->kit.sizes = otx_tileset_sizes(&t->layout);
    t->kit.boundary_count = t->layout.boundaries;
    t->kit.corner_count = t->layout.corners;
    assert_int_equal(
        otx_texel_pool_create(
            run, run->arena, t->exemplar, &t->exemplar->match,
            otx_template_extra(&t->kit.sizes, &t->options), &t->pool),
        OSDTEX_OK);
    assert_int_equal(
        otx_template_kit(run, &t->pool, NULL, &t->options, &t->layout, &t->kit),
        OSDTEX_OK);
    return t;
}

#endif

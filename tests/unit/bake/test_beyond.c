/* test_beyond.c -- facets that are unfolded once are where walks end. */
#include "unit/bake/flat.h"

#include "bake/block.h"

enum
{
    SIDE = 256,
    MARGIN = 8,
    STEPS = 96
};

/* A bent sheet, so that the way matters around its vertices. */
static otx_surface *
bent(otx_run *run)
{
    otx_surface *surface = flat_surface(run, 3, 2);
    const otx_level *leaf = otx_surface_leaf(surface);
    float *points = OTX_NEW(run->arena, float, 3 * leaf->vert_count);

    for (int32_t v = 0; v < leaf->vert_count; ++v)
    {
        const float *p = surface->points + 3 * v;

        points[3 * v] = p[0];
        points[3 * v + 1] = p[1];
        points[3 * v + 2] = 0.3f * (float)sin(2.0 * p[0]) * p[1];
    }
    surface->points = points;
    return surface;
}

static double
difference(const otx_walk *walk, const otx_mip_facet *placed, otx_vec2 at)
{
    double largest = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        largest = fmax(
            largest, fabs(walk->at[k] - otx_mip_facet_weight(placed, k, at)));
        largest = fmax(largest, fabs(walk->dx[k] - placed->dx[k]));
        largest = fmax(largest, fabs(walk->dy[k] - placed->dy[k]));
    }
    return largest;
}

/* Texels around each rim, which its facet goes on to. */
static void
they_are_where_walks_end(void **state)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    otx_run *run = *state;
    const otx_surface *surface = bent(run);
    const otx_mapping *mapping = flat_mapping(run, surface, 3);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    otx_mip mip = {.layout = &layout};
    int32_t found = 0, ended = 0;
    otx_block block;
    otx_bake bake;

    assert_int_equal(
        otx_bake_create(
            run, mapping, flat_ramp(run, 64), &layout, &color, &bake),
        OSDTEX_OK);
    assert_int_equal(
        otx_mip_find_rims(
            run, run->arena, &layout, 0, &mip.rims, &mip.rim_count),
        OSDTEX_OK);
    assert_int_equal(otx_mip_build(run, run->arena, &mip), OSDTEX_OK);
    assert_true(
        otx_block_draw(&bake.source, NULL, &mip, 0, 0, run->arena, &block));
    for (int32_t i = 0; i < 40 * mip.rim_count; ++i)
    {
        const otx_mip_rim *rim = &mip.rims[i % mip.rim_count];
        const otx_mip_facet *root = otx_block_rim_piece(&block, rim);
        const double angle = 6.3 * otx_random_unit(1, 1, (uint64_t)i);
        const double way = 12.0 * otx_random_unit(1, 2, (uint64_t)i);
        otx_vec2 ends[2], at;
        otx_walk walk;

        otx_mip_ends(&mip, rim, ends);
        at = otx_vec2_add(ends[0], otx_vec2_scale(way, otx_vec2_polar(angle)));
        walk = otx_mip_facet_place(root, at);
        otx_walk_on(surface, layout.covered, STEPS, &walk);

        const otx_mip_facet *placed = otx_block_beyond(&block, root, at);

        ended += placed == NULL;
        if (!placed)
            continue;
        ++found;
        assert_int_equal(placed->facet.face, walk.facet.face);
        assert_int_equal(placed->facet.index, walk.facet.index);
        assert_true(difference(&walk, placed, at) < 1e-9);
    }
    assert_true(found > 20 * mip.rim_count);
    assert_true(ended > 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(they_are_where_walks_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_seam_edge.c -- an edge shows the same, from whichever side it is asked.
 */
#include "unit/bake/noise.h"

#include "bake/mip_level.h"
#include "bake/seam_edge.h"

enum
{
    N = 3,
    SIDE = 256,
    MARGIN = 8
};

typedef struct trial
{
    otx_layout layout;
    otx_bake bake;
    otx_mip mip;
    otx_sharpen_grid grid;
    otx_seam_fit fit;
} trial;

static trial *
make_trial(otx_run *run)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    trial *t = OTX_ZNEW(run->arena, trial, 1);
    const otx_surface *surface = flat_surface(run, N, 1);
    const otx_mapping *mapping = flat_mapping(run, surface, N);

    t->layout = flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    assert_int_equal(
        otx_bake_create(
            run, mapping, flat_noise(run, 64), &t->layout, &color, &t->bake),
        OSDTEX_OK);
    t->mip = (otx_mip){.layout = &t->layout};
    assert_int_equal(
        otx_mip_find_rims(
            run, run->arena, &t->layout, 0, &t->mip.rims, &t->mip.rim_count),
        OSDTEX_OK);
    assert_int_equal(otx_mip_build(run, run->arena, &t->mip), OSDTEX_OK);
    t->grid = (otx_sharpen_grid){.channels = 3};
    t->fit = (otx_seam_fit){
        .mapping = mapping,
        .show = &t->bake.source.show,
        .textures = t->bake.source.textures,
        .mip = &t->mip,
        .grid = &t->grid,
        .low = t->bake.source.low,
        .high = t->bake.source.high};
    return t;
}

/* The rim that is the same edge from its other side; -1 where there is none. */
static int32_t
other_side(const trial *t, int32_t rim)
{
    const otx_level *leaf = otx_surface_leaf(t->layout.surface);
    const otx_mip_rim *a = &t->mip.rims[rim];
    const int32_t edge = leaf->face_edges[leaf->face_first[a->face] + a->edge];

    for (int32_t i = 0; i < t->mip.rim_count; ++i)
    {
        const otx_mip_rim *b = &t->mip.rims[i];

        if (i != rim &&
            leaf->face_edges[leaf->face_first[b->face] + b->edge] == edge)
            return i;
    }
    return -1;
}

static void
both_sides_show_the_same(void **state)
{
    trial *t = make_trial(*state);
    int32_t shared = 0;

    for (int32_t rim = 0; rim < t->mip.rim_count; ++rim)
    {
        const int32_t across = other_side(t, rim);
        otx_seam_fit_edge here = {.rim = -1}, there = {.rim = -1};

        otx_seam_edge_set(&t->fit, rim, &here);
        assert_int_equal(here.goes_on, across >= 0);
        assert_false(otx_seam_edge_is_sharp(&t->fit, &here, 0.5));
        if (across < 0)
            continue;
        ++shared;
        otx_seam_edge_set(&t->fit, across, &there);
        for (int s = 0; s <= 8; ++s)
        {
            float a[3], b[3];

            otx_seam_edge_show(&t->fit, &here, s / 8.0, a);
            otx_seam_edge_show(&t->fit, &there, 1.0 - s / 8.0, b);
            for (int c = 0; c < 3; ++c)
                assert_float_equal(a[c], b[c], 1e-6);
        }
    }
    assert_int_equal(shared, 2 * 2 * 2 * N * (N - 1));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(both_sides_show_the_same),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

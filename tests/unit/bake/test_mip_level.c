/* test_mip_level.c -- a block's lists hold all that can be seen in it. */
#include "unit/bake/flat.h"

enum
{
    N = 3,
    SIDE = 512
};

typedef struct scene
{
    otx_run *run;
    otx_mapping *mapping;
    otx_layout layout;
    otx_mip mip;
} scene;

/* A sheet in an atlas, torn into two patches at x = N / 2. */
static scene
make(int32_t level)
{
    scene s = {.run = test_run_create()};
    const otx_surface *surface = flat_surface(s.run, N, 2);
    const otx_level *leaf = otx_surface_leaf(surface);

    s.mapping = flat_mapping(s.run, surface, N);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        s.mapping->face_patch[f] =
            surface->points[3 * leaf->face_verts[4 * f]] > 0.49 * N;
    s.layout = flat_layout(s.run, s.mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    s.mip.level = level;
    s.mip.blend = 4.0;
    return s;
}

/* The layout is the scene's own, which must not move any more. */
static void
build(scene *s)
{
    otx_mip *mip = &s->mip;
    otx_run *run = s->run;

    mip->layout = &s->layout;
    assert_int_equal(
        otx_mip_find_rims(
            run, run->arena, &s->layout, 0, &mip->rims, &mip->rim_count),
        OSDTEX_OK);
    assert_int_equal(
        otx_mip_find_seams(
            run, run->arena, &s->layout, s->mapping->face_patch, 0, &mip->seams,
            &mip->seam_count),
        OSDTEX_OK);
    assert_int_equal(otx_mip_build(run, run->arena, mip), OSDTEX_OK);
}

static void
rims_and_seams_are_counted(void **state)
{
    scene s = make(0);

    (void)state;
    build(&s);
    /* Each of the N x N blocks has four sides of four leaves. */
    assert_int_equal(s.mip.rim_count, N * N * 4 * 4);
    /* One line of 4 N leaf edges, from both sides. */
    assert_int_equal(s.mip.seam_count, 2 * 4 * N);
    test_run_destroy(s.run);
}

static bool
lists(const otx_bin *bin, int32_t block, int32_t item)
{
    for (int64_t i = bin->first[block]; i < bin->first[block + 1]; ++i)
        if (bin->items[i] == item)
            return true;
    return false;
}

/* The block, counted from the top, at a place that may be beyond the mip level.
 */
static int32_t
block_at(const otx_mip *mip, double x, double y)
{
    const double most = mip->side - 1e-6;
    const double right = fmin(fmax(x, 0.0), most);
    const double down = fmin(fmax(mip->side - y, 0.0), most);

    return (int32_t)(down / OTX_MIP_BLOCK) * mip->columns +
           (int32_t)(right / OTX_MIP_BLOCK);
}

static void
blocks_list_what_is_near(void **state)
{
    (void)state;
    for (int32_t level = 0; level < 10; ++level)
    {
        scene s = make(level);
        const otx_mip *mip = &s.mip;
        const otx_level *leaf;

        build(&s);
        leaf = otx_surface_leaf(s.layout.surface);
        assert_int_equal(mip->side, SIDE >> level);
        assert_int_equal(mip->gutter, level == 0 ? 8 : 4);
        for (int32_t i = 0; i < s.layout.tile_first[1]; ++i)
            for (int32_t c = leaf->face_first[s.layout.tile_faces[i]], k = 0;
                 k < 4; ++k)
            {
                const otx_vec2 p = otx_mip_texel(mip, c + k);

                assert_true(lists(&mip->faces, block_at(mip, p.x, p.y), i));
            }
        for (int32_t i = 0; i < mip->rim_count; ++i)
        {
            const double r = mip->gutter;
            otx_vec2 p[2];

            otx_mip_ends(mip, &mip->rims[i], p);
            for (int k = 0; k < 4; ++k)
                assert_true(lists(
                    &mip->near_rims,
                    block_at(
                        mip, p[k / 2].x + (k % 2 ? r : -r),
                        p[k / 2].y + (k % 2 ? r : -r)),
                    i));
        }
        for (int32_t i = 0; i < mip->columns * mip->columns; ++i)
            assert_true(
                mip->far_rim[i] >= 0 && mip->far_rim[i] < mip->rim_count);
        test_run_destroy(s.run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rims_and_seams_are_counted),
        cmocka_unit_test(blocks_list_what_is_near),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

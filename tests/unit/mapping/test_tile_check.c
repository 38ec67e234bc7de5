/* test_tile_check.c -- a planted step between two tiles is measured. */
#include "grid.h"

#include "mapping/tile_check.h"

enum
{
    SIDE = 64
};

/* A picture of two colours, left and right. */
static otx_image
halves(otx_run *run)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &image), OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE * 3; ++i)
        image.pixels[i] = i / 3 % SIDE < SIDE / 2 ? 0.25f : 0.75f;
    return image;
}

/* Two faces side by side, each a tile, whose lower left corners show the given
 * places; tiles are a tenth of the picture. */
static otx_mapping
two_tiles(otx_run *run, double left, double right)
{
    const otx_surface *surface = test_grid_create(run->arena, 2, 1, 1.0);
    otx_mapping m = {
        .surface = surface,
        .scale = 1.0,
        .uvs = OTX_NEW(run->arena, float, 16),
        .face_patch = OTX_NEW(run->arena, int32_t, 2),
        .patch_count = 2};

    for (int32_t c = 0; c < 8; ++c)
    {
        const int32_t k = c % 4;

        m.uvs[2 * c] =
            (float)((c < 4 ? left : right) + (k == 1 || k == 2 ? 0.1 : 0.0));
        m.uvs[2 * c + 1] = k >= 2 ? 0.5f : 0.4f;
    }
    m.face_patch[0] = 0;
    m.face_patch[1] = 1;
    return m;
}

static void
a_planted_step_is_measured(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = halves(run);

    (void)state;
    for (int apart = 0; apart < 2; ++apart)
    {
        const otx_mapping m = two_tiles(run, 0.1, apart ? 0.7 : 0.3);
        otx_tile_match match;

        assert_int_equal(
            otx_tile_check_match(run, &m, &image, 5, &match), OSDTEX_OK);
        assert_true(match.edge == 0.5 * apart);
        assert_true(match.corner == 0.5 * apart);
    }
    test_run_destroy(run);
}

static void
one_patch_has_no_edge(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = halves(run);
    otx_mapping m = two_tiles(run, 0.1, 0.7);
    otx_tile_match match;

    (void)state;
    m.face_patch[1] = 0;
    m.patch_count = 1;
    assert_int_equal(
        otx_tile_check_match(run, &m, &image, 5, &match), OSDTEX_OK);
    assert_true(match.edge == 0.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_planted_step_is_measured),
        cmocka_unit_test(one_patch_has_no_edge),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_charts.c -- coordinates of charts lie on tiles, turn no face over, and
 * are shared where a chart hangs together. */
#include "unit/bake/flat.h"

#include "bake/charts.h"

enum
{
    SIDE = 512
};

static const char *const CAGES[] = {
    "models/cages/jack.obj", "models/cages/ngons_and_triangles.obj",
    "models/cages/loop_open.obj", "models/cages/hole.obj"};

static otx_atlas
charts_of(otx_run *run, const char *path, double density, otx_surface *surface)
{
    const otx_atlas_options options = {
        .side = SIDE, .texels_per_unit = density};
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_atlas atlas;

    assert_int_equal(mesh_cage_from_file(run, path, cage), OSDTEX_OK);
    *surface = mesh_refine(run, cage, 1);
    assert_int_equal(
        otx_charts_make(run, surface, &options, &atlas), OSDTEX_OK);
    return atlas;
}

static double
area_of(const otx_level *level, const otx_atlas *atlas, int32_t face)
{
    const int32_t first = level->face_first[face];
    const int32_t n = otx_level_face_size(level, face);
    double sum = 0.0;

    for (int32_t k = 0; k < n; ++k)
    {
        const float *a = atlas->corner_uvs + 2 * (first + k);
        const float *b = atlas->corner_uvs + 2 * (first + (k + 1) % n);

        sum += 0.5 * ((double)a[0] * b[1] - (double)a[1] * b[0]);
    }
    return sum;
}

static void
check_corners(const otx_level *level, const otx_atlas *atlas)
{
    for (int32_t c = 0; c < level->corner_count; ++c)
    {
        const int32_t i = atlas->corner_index[c];

        assert_true(i >= 0 && i < atlas->uv_count);
        assert_memory_equal(
            atlas->corner_uvs + 2 * c, atlas->uvs + 2 * i,
            2 * sizeof *atlas->uvs);
    }
}

/* With a margin to the tile's rim, all the same way round. */
static void
faces_lie_on_their_tile(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof CAGES / sizeof *CAGES; ++i)
    {
        otx_run *run = test_run_create();
        otx_surface surface;
        const otx_atlas atlas = charts_of(run, CAGES[i], 0.0, &surface);
        const otx_level *level = &surface.levels[0];
        const double rim = (double)atlas.margin / SIDE - 1e-6;
        double use = 0.0;

        assert_int_equal(atlas.tile_count, 1);
        assert_true(atlas.uv_count <= level->corner_count);
        check_corners(level, &atlas);
        for (int32_t f = 0; f < level->face_count; ++f)
        {
            if (level->face_hole[f])
                continue;
            assert_true(area_of(level, &atlas, f) > 0.0);
            use += area_of(level, &atlas, f);
            for (int32_t c = level->face_first[f]; c < level->face_first[f + 1];
                 ++c)
                for (int32_t k = 0; k < 2; ++k)
                {
                    const double at = (double)atlas.corner_uvs[2 * c + k];

                    assert_true(at >= rim && at <= 1.0 - rim);
                }
        }
        /* A chart alone uses what its outline lets it. */
        assert_true(use > (i == 2 ? 0.3 : 0.45) && use < 1.0);
        test_run_destroy(run);
    }
}

static void
what_does_not_fit_goes_to_further_tiles(void **state)
{
    otx_run *run = test_run_create();
    otx_surface surface;
    const otx_atlas one = charts_of(run, CAGES[0], 0.0, &surface);
    const otx_atlas more =
        charts_of(run, CAGES[0], 2.0 * one.texels_per_unit, &surface);

    (void)state;
    assert_true(more.tile_count > 1);
    assert_true(fabs(more.texels_per_unit / one.texels_per_unit - 2.0) < 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_lie_on_their_tile),
        cmocka_unit_test(what_does_not_fit_goes_to_further_tiles),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

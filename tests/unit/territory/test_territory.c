/* test_territory.c -- every face is somebody's, and lies in the plane without a
 * fold, on limbs that a core goes around, too. */
#include "grid.h"
#include "unit/surface/meshes.h"

#include "territory/territory.h"

enum
{
    SIDE = 64 /* texels of the exemplar */
};

static otx_territory
territory_of(otx_run *run, const otx_surface *surface, double side)
{
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, SIDE, SIDE, true, 1);
    const otx_mapping *mapping =
        test_mapping_create(run->arena, surface, exemplar, 1.0, 0.0);
    const otx_territory_options options = {
        .texels = 1.0, .side = side, .collar = 0.2 * side};
    otx_territory territory;

    assert_int_equal(
        otx_territory_build(run, mapping, &options, &territory), OSDTEX_OK);
    return territory;
}

/* Twice the area that a face has in its chart. */
static double
area_in(const otx_chart *chart, int32_t slot)
{
    const int32_t *corners = chart->corners + chart->first[slot];
    const int32_t size = chart->first[slot + 1] - chart->first[slot];
    double area = 0.0;

    for (int32_t k = 0; k < size; ++k)
        area += otx_vec2_cross(
            chart->flat[corners[k]], chart->flat[corners[(k + 1) % size]]);
    return area;
}

static void
every_face_has_an_owner(void **state)
{
    static const double sides[] = {0.5, 1.5, 4.0};

    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof *sides; ++i)
    {
        otx_run *run = test_run_create();
        otx_cage cage;
        otx_surface surface;
        otx_territory t;
        double width;

        assert_int_equal(
            mesh_cage_from_file(run, "models/cages/creature.obj", &cage),
            OSDTEX_OK);
        surface = mesh_refine(run, &cage, 2);
        width = sqrt(surface.area / 6.0);
        t = territory_of(run, &surface, sides[i] * width);
        for (int32_t f = 0; f < otx_surface_leaf(&surface)->face_count; ++f)
        {
            assert_in_range(t.owner[f], 0, t.count - 1);

            const otx_chart *chart = &t.charts[t.owner[f]];

            assert_true(t.slot[f] < chart->core_count);
            assert_int_equal(chart->faces[t.slot[f]], f);
            assert_true(area_in(chart, t.slot[f]) > 0.0);
        }
        test_run_destroy(run);
    }
}

static void
cores_are_as_wide_as_asked(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 16, 16, 4.0);
    const otx_territory t = territory_of(run, surface, 32.0);

    (void)state;
    assert_in_range(t.count, 3, 6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_face_has_an_owner),
        cmocka_unit_test(cores_are_as_wide_as_asked),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_dual.c -- all levels measure the same surface. */
#include "unit/cluster/sheets.h"

static void
areas_of_every_level_add_up(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, "models/cages/creature.obj", 2);

    (void)state;
    for (int32_t l = 0; l < s.level_count; ++l)
    {
        const otx_dual dual = sheet_dual(run, &s, l);
        double area = 0.0;

        for (int32_t f = 0; f < dual.level->face_count; ++f)
            area += dual.areas[f];
        assert_true(fabs(area / s.area - 1.0) < 1e-6);
    }
    test_run_destroy(run);
}

static void
holes_have_no_area(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, "models/cages/hole.obj", 1);
    const otx_dual dual = sheet_dual(run, &s, 1);
    int32_t holes = 0;

    (void)state;
    for (int32_t f = 0; f < dual.level->face_count; ++f)
    {
        assert_int_equal(dual.areas[f] == 0.0, dual.level->face_hole[f] != 0);
        holes += dual.level->face_hole[f];
    }
    assert_int_equal(holes, 8);
    test_run_destroy(run);
}

static void
a_step_is_longer_where_the_surface_bends(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 4, 1, SHEET_FOLDED);
    const otx_dual dual = sheet_dual(run, &s, 0);

    (void)state;
    assert_true(fabs(dual.normals[0].z - 1.0) < 1e-6);
    assert_true(fabs(dual.normals[3].x - 1.0) < 1e-6);
    assert_true(fabs(otx_dual_step(&dual, 0, 1, 1.0) - 1.0) < 1e-6);
    /* The normals turn by a right angle: 1 + bend. */
    assert_true(fabs(otx_dual_step(&dual, 1, 2, 3.0) - 4.0 * sqrt(0.5)) < 1e-6);
    assert_true(
        otx_dual_step(&dual, 1, 2, 1.0) == otx_dual_step(&dual, 2, 1, 1.0));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_of_every_level_add_up),
        cmocka_unit_test(holes_have_no_area),
        cmocka_unit_test(a_step_is_longer_where_the_surface_bends),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

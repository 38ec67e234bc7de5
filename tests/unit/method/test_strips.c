/* test_strips.c -- strips of courses, for any number of threads. */
#include "materials.h"

static void
courses_do_not_depend_on_threads(void **state)
{
    otx_run *runs[2];
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        otx_figures figures;

        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 3);

        otx_exemplar *e = OTX_NEW(runs[i]->arena, otx_exemplar, 1);
        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);

        *e = make_bricks(runs[i]);
        assert_int_equal(
            map_courses(runs[i], &s->surface, e, 2.0, &m[i], &figures),
            OSDTEX_OK);
        check(&m[i], e);
    }
    assert_memory_equal(
        m[0].uvs, m[1].uvs,
        2 * sizeof(float) *
            (size_t)otx_surface_leaf(m[0].surface)->corner_count);
    for (int i = 0; i < 2; ++i)
        test_run_destroy(runs[i]);
}

static void
courses_that_are_not_there_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, false);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 3);
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_courses(run, &s->surface, &e, 1.5, &m, &figures),
        OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "courses"));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(courses_do_not_depend_on_threads),
        cmocka_unit_test(courses_that_are_not_there_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

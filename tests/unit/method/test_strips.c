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
    assert_same_uvs(&m[0], &m[1]);
    for (int i = 0; i < 2; ++i)
        test_run_destroy(runs[i]);
}

static otx_status
lay(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    otx_mapping *out)
{
    otx_figures figures;

    return map_courses(run, surface, exemplar, 1.5, out, &figures);
}

static void
courses_that_are_not_there_are_refused(void **state)
{
    (void)state;
    assert_unsupported(lay, "courses");
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

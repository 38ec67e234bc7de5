/* test_direction.c -- smoothness, pins, pulls, and Poincare-Hopf. */
#include "field/attract.h"
#include "field/singularity.h"
#include "unit/field/test_field.h"

static void
refining_keeps_directions(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_direction_request q = {.symmetry = 4};
    otx_connection coarse;
    otx_direction field, fine;

    (void)state;
    assert_int_equal(
        otx_connection_build(run, &s->surface, 2, &coarse), OSDTEX_OK);
    assert_int_equal(otx_direction_solve(run, &coarse, &q, &field), OSDTEX_OK);
    assert_int_equal(
        otx_direction_refine(run, &field, &s->connection, &fine), OSDTEX_OK);
    for (int32_t f = 0; f < s->connection.level->face_count; ++f)
    {
        const otx_vec2 z = fine.powers[f];

        assert_true(fabs(otx_vec2_length(z) - 1.0) < 1e-9);
    }
    test_run_destroy(run);
}

static void
bad_requests_get_a_sentence(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 3);
    const int32_t hole = 4;
    const field_surface *s;
    const otx_direction_pin pins[] = {
        {99, {1, 0, 0}},
        {4, {1, 0, 0}},
        {0, {NAN, 0, 0}},
        {0, {0, 0, 1}},
        {0, {0, 0, 0}}};
    otx_direction field;

    (void)state;
    in.hole_faces = &hole;
    in.hole_count = 1;
    s = field_from_input(run, &in, 0);
    for (int i = 0; i < COUNT(pins); ++i)
    {
        const otx_direction_request q = {
            .symmetry = 1, .pins = &pins[i], .pin_count = 1};

        assert_int_equal(
            otx_direction_solve(run, &s->connection, &q, &field),
            OSDTEX_ERROR_ARGUMENT);
        assert_non_null(strstr(test_last_message(run), "constraint 1"));
    }
    assert_int_equal(
        otx_direction_solve(
            run, &s->connection, &(otx_direction_request){.symmetry = 3},
            &field),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refining_keeps_directions),
        cmocka_unit_test(bad_requests_get_a_sentence),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

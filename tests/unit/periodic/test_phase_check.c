/* test_phase_check.c -- coordinates as they are solved for are sound, with one
 * sense and with two, and each way of spoiling them is found. */
#include "unit/field/test_field.h"

#include "periodic/phase_check.h"

typedef struct fixture
{
    otx_run *run;
    otx_phase phase;
} fixture;

static fixture
make(int32_t symmetry)
{
    fixture f = {.run = test_run_create()};
    const otx_cage_input in = field_torus(f.run, 12, 8);
    const field_surface *s = field_from_input(f.run, &in, 2);
    const otx_direction_request q = {.symmetry = symmetry};
    otx_direction *field = OTX_NEW(f.run->arena, otx_direction, 1);
    const otx_phase_request request = {
        .field = field,
        .log_scale =
            OTX_ZNEW(f.run->arena, double, s->connection.level->vert_count),
        .gradient = {{4.0, 0}, {0, 4.0}},
        .cancel = 0.3};

    assert_int_equal(
        otx_direction_solve(f.run, &s->connection, &q, field), OSDTEX_OK);
    assert_int_equal(otx_phase_solve(f.run, &request, &f.phase), OSDTEX_OK);
    return f;
}

static void
what_is_solved_for_is_sound(void **state)
{
    (void)state;
    for (int32_t symmetry = 1; symmetry <= 2; ++symmetry)
    {
        fixture f = make(symmetry);
        const char *wrong = otx_phase_check(&f.phase);

        if (wrong)
            fail_msg("%s", wrong);
        test_run_destroy(f.run);
    }
}

static void
what_is_spoilt_is_found(void **state)
{
    fixture f = make(1);
    int32_t face = 0;

    (void)state;
    ++f.phase.defect_count;
    assert_non_null(strstr(otx_phase_check(&f.phase), "counted"));
    --f.phase.defect_count;
    while (f.phase.defect[face])
        ++face;
    f.phase.cells[f.phase.connection->level->face_first[face]].x += 0.25;
    assert_non_null(strstr(otx_phase_check(&f.phase), "parts of cells"));
    f.phase.cells[0].y = NAN;
    assert_non_null(strstr(otx_phase_check(&f.phase), "finite"));
    test_run_destroy(f.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_solved_for_is_sound),
        cmocka_unit_test(what_is_spoilt_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

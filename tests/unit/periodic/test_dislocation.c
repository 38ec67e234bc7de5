/* test_dislocation.c -- dislocations meet within their reach, the fewer are
 * left the farther it is, and what is left are whole cells. */
#include "unit/field/test_field.h"

#include "periodic/phase_check.h"

static otx_phase
solve(otx_run *run, double cancel)
{
    const otx_cage_input in = field_torus(run, 16, 8);
    const field_surface *s = field_from_input(run, &in, 3);
    const otx_direction_request q = {.symmetry = 1};
    otx_direction *field = OTX_NEW(run->arena, otx_direction, 1);
    const otx_phase_request request = {
        .field = field,
        .log_scale =
            OTX_ZNEW(run->arena, double, s->connection.level->vert_count),
        .gradient = {{2.5, 0}, {0, 2.5}},
        .cancel = cancel};
    otx_phase phase;

    assert_int_equal(
        otx_direction_solve(run, &s->connection, &q, field), OSDTEX_OK);
    assert_int_equal(otx_phase_solve(run, &request, &phase), OSDTEX_OK);
    assert_null(otx_phase_check(&phase));
    return phase;
}

static void
the_farther_the_fewer_are_left(void **state)
{
    static const double reach[] = {0.0, 0.6, 4.0};
    int32_t defects[3], cancelled[3];

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        otx_run *run = test_run_create();
        const otx_phase phase = solve(run, reach[i]);

        defects[i] = phase.defect_count;
        cancelled[i] = phase.cancelled;
        test_run_destroy(run);
    }
    assert_int_equal(cancelled[0], 0);
    assert_true(defects[0] > 0);
    assert_true(cancelled[1] <= cancelled[2]);
    assert_true(defects[2] < defects[0]);
    assert_true(defects[1] <= defects[0]);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_farther_the_fewer_are_left),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

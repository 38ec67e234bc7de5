/* test_nested.c -- the quick way to a field leads to about the same field. */
#include "field/attract.h"
#include "field/nested.h"
#include "field/singularity.h"
#include "unit/field/test_field.h"

/* The energy of [Knoeppel13] that a field has. */
static double
energy(const otx_direction *field)
{
    const otx_connection *c = field->connection;
    double sum = 0.0;

    for (int32_t e = 0; e < c->level->edge_count; ++e)
        if (c->inner[e])
        {
            const double turn = field->symmetry * otx_direction_turn(field, e);

            sum += c->weights[e] * (2.0 - 2.0 * cos(turn));
        }
    return sum;
}

/* Above the number of faces that are solved directly. */
static field_surface *
fine_torus(otx_run *run)
{
    const otx_cage_input in = field_torus(run, 48, 34);

    return field_from_input(run, &in, 2);
}

static void
it_is_about_as_smooth(void **state)
{
    (void)state;
    for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
    {
        otx_run *run = test_run_create();
        const field_surface *s = fine_torus(run);
        const otx_direction_request q = {.symmetry = symmetry};
        otx_singularity_list list;
        otx_direction direct, nested;

        assert_true(s->connection.level->face_count > 24000);
        assert_int_equal(
            otx_direction_solve(run, &s->connection, &q, &direct), OSDTEX_OK);
        assert_int_equal(
            otx_nested_solve(run, &s->connection, &q, &nested), OSDTEX_OK);
        assert_true(energy(&nested) < 1.05 * energy(&direct) + 1e-6);
        assert_int_equal(otx_singularity_find(run, &nested, &list), OSDTEX_OK);
        assert_int_equal(list.count, 0);
        test_run_destroy(run);
    }
}

static void
pins_and_pulls_hold(void **state)
{
    otx_run *run = test_run_create();
    const field_surface *s = fine_torus(run);
    const otx_direction_pin pin = {100, {0.3, 1.0, 0.2}};
    otx_direction_request q = {
        .symmetry = 1, .pins = &pin, .pin_count = 1, .pull_length = 0.2};
    const otx_vec2 wanted =
        otx_connection_project(&s->connection, 100, otx_vec3_unit(pin.vector));
    otx_direction field;
    otx_vec2 *pull;
    double sum = 0.0;

    (void)state;
    assert_int_equal(
        otx_attract_axis(run, &s->connection, 1, (otx_vec3){0, 1, 0}, &pull),
        OSDTEX_OK);
    q.pull = pull;
    assert_int_equal(
        otx_nested_solve(run, &s->connection, &q, &field), OSDTEX_OK);
    assert_true(
        fabs(otx_vec2_cross(
            field.powers[100],
            otx_vec2_scale(1.0 / otx_vec2_length(wanted), wanted))) < 1e-9);
    for (int32_t f = 0; f < s->connection.level->face_count; ++f)
        sum += s->connection.areas[f] * otx_vec2_dot(field.powers[f], pull[f]);
    assert_true(sum > 0.55 * s->connection.area);
    test_run_destroy(run);
}

static void
threads_do_not_change_a_bit(void **state)
{
    otx_run *one = test_run_create_with(NULL, 1);
    otx_run *many = test_run_create_with(NULL, 8);
    const otx_direction_request q = {.symmetry = 2};
    const field_surface *a = fine_torus(one), *b = fine_torus(many);
    otx_direction x, y;

    (void)state;
    assert_int_equal(otx_nested_solve(one, &a->connection, &q, &x), OSDTEX_OK);
    assert_int_equal(otx_nested_solve(many, &b->connection, &q, &y), OSDTEX_OK);
    assert_memory_equal(
        x.powers, y.powers,
        (size_t)a->connection.level->face_count * sizeof *x.powers);
    test_run_destroy(one);
    test_run_destroy(many);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_about_as_smooth),
        cmocka_unit_test(pins_and_pulls_hold),
        cmocka_unit_test(threads_do_not_change_a_bit),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_direction_solve.c -- smoothness, pins, pulls, and Poincare-Hopf. */
#include "field/attract.h"
#include "field/singularity.h"
#include "unit/field/test_field.h"

static otx_direction
solve(otx_run *run, const field_surface *s, const otx_direction_request *q)
{
    otx_direction field;

    if (otx_direction_solve(run, &s->connection, q, &field) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return field;
}

static const otx_vec2 *
pull_along(
    otx_run *run, const field_surface *s, int32_t symmetry, otx_vec3 axis)
{
    otx_vec2 *pull;

    assert_int_equal(
        otx_attract_axis(run, &s->connection, symmetry, axis, &pull),
        OSDTEX_OK);
    return pull;
}

static int32_t
index_sum(otx_run *run, const otx_direction *field, int32_t *count)
{
    otx_singularity_list list;
    int32_t sum = 0;

    assert_int_equal(otx_singularity_find(run, field, &list), OSDTEX_OK);
    for (int32_t i = 0; i < list.count; ++i)
        sum += list.items[i].turns;
    *count = list.count;
    return sum;
}

static void
indices_sum_to_the_euler_characteristic(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input inputs[] = {
        mesh_cube(run), mesh_octahedron(run), field_torus(run, 12, 8)};
    const int32_t expected[] = {2, 2, 0};

    (void)state;
    for (int i = 0; i < 3; ++i)
        for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
        {
            const field_surface *s = field_from_input(run, &inputs[i], 3);
            const otx_direction_request q = {.symmetry = symmetry};
            const otx_direction field = solve(run, s, &q);
            int32_t count;

            assert_int_equal(
                index_sum(run, &field, &count), expected[i] * symmetry);
            /* No more than the shape asks for. */
            assert_int_equal(count, expected[i] * symmetry);
        }
    test_run_destroy(run);
}

static void
real_models_obey_poincare_hopf(void **state)
{
    static const char *const names[] = {
        "cages/spot_control_mesh.obj", "meshes/double_torus.obj",
        "cages/catmark_torus_creases0.obj", "cages/blub_control_mesh.obj"};

    (void)state;
    for (int i = 0; i < 4; ++i)
    {
        otx_run *run = test_run_create();
        char path[200];
        field_surface *s;

        snprintf(path, sizeof path, SHARED_DATA "/%s", names[i]);
        s = field_from_file(run, path, 1);
        if (!s)
        {
            print_message("skipped: %s is not there\n", path);
            test_run_destroy(run);
            skip();
        }
        for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
        {
            const otx_direction_request q = {.symmetry = symmetry};
            const otx_direction field = solve(run, s, &q);
            int32_t count;

            assert_int_equal(
                index_sum(run, &field, &count),
                symmetry * field_euler(s->connection.level));
        }
        test_run_destroy(run);
    }
}

static void
a_pull_on_a_plane_is_followed(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_direction_request q = {
        .symmetry = 1,
        .pull = pull_along(run, s, 1, (otx_vec3){3, 4, 1}),
        .pull_length = 1.0};
    const otx_direction field = solve(run, s, &q);

    (void)state;
    for (int32_t f = 0; f < s->connection.level->face_count; ++f)
    {
        const otx_vec3 d = otx_direction_vector(&field, f);

        assert_true(fabs(d.x - 0.6) + fabs(d.y - 0.8) < 1e-3);
    }
    test_run_destroy(run);
}

/* Between two pins the direction turns evenly. */
static void
pins_hold_and_are_interpolated(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 8);
    const field_surface *s = field_from_input(run, &in, 1);
    const otx_level *level = s->connection.level;
    otx_direction_pin pins[64];
    otx_direction_request q = {.symmetry = 1, .pins = pins};
    otx_direction field;

    (void)state;
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const double x = s->connection.centres[f].x;

        if (x < 0.5 || x > 7.5)
            pins[q.pin_count++] = (otx_direction_pin){
                f, x < 4.0 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0}};
    }
    field = solve(run, s, &q);
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const otx_vec3 d = otx_direction_vector(&field, f);
        const double x = s->connection.centres[f].x;
        const double angle = atan2(d.y, d.x) * 2.0 / OTX_PI;

        if (x < 0.5)
            assert_true(fabs(angle) < 1e-6);
        assert_true(fabs(angle - (x - 0.25) / 7.5) < 0.06);
    }
    test_run_destroy(run);
}

static void
an_edit_keeps_the_rest(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 8);
    const field_surface *s = field_from_input(run, &in, 1);
    const int32_t count = s->connection.level->face_count;
    otx_direction_request q = {
        .symmetry = 2,
        .pull = pull_along(run, s, 2, (otx_vec3){1, 0, 0}),
        .pull_length = 1.0};
    otx_direction field = solve(run, s, &q);
    const otx_direction_pin pin = {0, {1, 1, 0}};
    uint8_t *effect = OTX_ZNEW(run->arena, uint8_t, count);
    int32_t changed = 0;

    (void)state;
    for (int32_t f = 0; f < count; ++f)
        effect[f] = s->connection.centres[f].x < 2.0;
    q = (otx_direction_request){.symmetry = 2, .pins = &pin, .pin_count = 1};
    assert_int_equal(otx_direction_edit(run, &q, effect, &field), OSDTEX_OK);
    for (int32_t f = 0; f < count; ++f)
    {
        const bool turned = fabs(otx_direction_vector(&field, f).y) > 1e-3;

        assert_true(effect[f] || !turned);
        changed += turned;
    }
    assert_true(changed > 8);
    test_run_destroy(run);
}

static void
the_same_for_any_number_of_threads(void **state)
{
    otx_vec2 *first = NULL;
    otx_run *runs[2];
    int32_t count = 0;

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 4);

        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);
        const otx_direction_request q = {.symmetry = 2};
        const otx_direction field = solve(runs[i], s, &q);

        count = s->connection.level->face_count;
        if (i == 0)
            first = field.powers;
        else
            assert_memory_equal(
                first, field.powers, (size_t)count * sizeof *first);
    }
    test_run_destroy(runs[0]);
    test_run_destroy(runs[1]);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(indices_sum_to_the_euler_characteristic),
        cmocka_unit_test(real_models_obey_poincare_hopf),
        cmocka_unit_test(a_pull_on_a_plane_is_followed),
        cmocka_unit_test(pins_hold_and_are_interpolated),
        cmocka_unit_test(an_edit_keeps_the_rest),
        cmocka_unit_test(the_same_for_any_number_of_threads),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

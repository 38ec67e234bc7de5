/* test_constraint.c -- constraints tied to the cage, and effect areas. */
#include "field/constraint.h"
#include "unit/field/test_field.h"

static void
a_face_holds_all_its_leaves(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_constraint item = {
        .face = 4, .has_direction = true, .direction = {1, 2, 0}};
    const otx_constraint_set set = {.count = 1, .items = &item};
    otx_direction_request q = {.symmetry = 1};

    (void)state;
    assert_int_equal(
        otx_constraint_pins(run, &set, &s->connection, &q), OSDTEX_OK);
    assert_int_equal(q.pin_count, 16);
    for (int32_t i = 0; i < q.pin_count; ++i)
        assert_int_equal(s->connection.level->face_cage[q.pins[i].face], 4);
    test_run_destroy(run);
}

static void
a_point_holds_at_least_the_nearest_face(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_constraint item = {
        .face = -1,
        .point = {1.5, 1.5, 9},
        .has_direction = true,
        .direction = {1, 0, 0}};
    const otx_constraint_set set = {.count = 1, .items = &item};
    otx_direction_request q = {.symmetry = 1};

    (void)state;
    assert_int_equal(
        otx_constraint_pins(run, &set, &s->connection, &q), OSDTEX_OK);
    assert_int_equal(q.pin_count, 1);
    item.point.z = 0.0;
    item.radius = 0.5;
    assert_int_equal(
        otx_constraint_pins(run, &set, &s->connection, &q), OSDTEX_OK);
    assert_true(q.pin_count >= 8);
    test_run_destroy(run);
}

static void
scales_are_held_and_spread(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_constraint items[] = {
        {.face = 0, .scale = 2.0}, {.face = 8, .scale = 0.5}};
    const otx_constraint_set set = {.count = 2, .items = items};
    const otx_level *level = s->connection.level;
    double *f = OTX_ZNEW(run->arena, double, level->vert_count);

    (void)state;
    assert_int_equal(
        otx_constraint_scale(run, &set, &s->connection, f), OSDTEX_OK);
    for (int32_t i = 0; i < level->corner_count; ++i)
    {
        const int32_t face = level->face_cage[i / 4];
        const double value = f[level->face_verts[i]];

        assert_true(fabs(value) < log(2.0) + 1e-9);
        if (face == 0 || face == 8)
            assert_true(
                fabs(value - (face == 0 ? -log(2.0) : log(2.0))) < 1e-9);
    }
    test_run_destroy(run);
}

static void
effect_areas_grow_with_the_radius(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_constraint item = {.face = 0, .scale = 2.0};
    int32_t counts[3] = {0, 0, 0};
    const double radii[3] = {0.0, 1.0, INFINITY};

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        uint8_t *effect;

        assert_int_equal(
            otx_constraint_effect(
                run, &s->connection, &item, radii[i], &effect),
            OSDTEX_OK);
        for (int32_t f = 0; f < s->connection.level->face_count; ++f)
            counts[i] += effect[f];
    }
    assert_int_equal(counts[0], 16);
    assert_true(counts[1] > 30 && counts[1] < 100);
    assert_int_equal(counts[2], s->connection.level->face_count);
    test_run_destroy(run);
}

static void
what_cannot_be_held_is_refused(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 3);
    const int32_t hole = 4;
    const field_surface *s;
    const otx_constraint items[] = {
        {.face = 9, .scale = 1.0},
        {.face = 4, .scale = 1.0},
        {.face = -1, .point = {NAN, 0, 0}, .scale = 1.0},
        {.face = 0, .has_direction = true},
        {.face = 0, .has_direction = true, .direction = {0, 0, 1}},
        {.face = 0, .scale = NAN},
        {.face = 0, .scale = 1e9},
    };

    (void)state;
    in.hole_faces = &hole;
    in.hole_count = 1;
    s = field_from_input(run, &in, 1);
    for (int i = 0; i < COUNT(items); ++i)
    {
        const otx_constraint_set set = {.count = 1, .items = &items[i]};
        otx_direction_request q = {.symmetry = 1};

        assert_int_equal(
            otx_constraint_pins(run, &set, &s->connection, &q),
            OSDTEX_ERROR_ARGUMENT);
        assert_non_null(strstr(test_last_message(run), "constraint 1"));
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_face_holds_all_its_leaves),
        cmocka_unit_test(a_point_holds_at_least_the_nearest_face),
        cmocka_unit_test(scales_are_held_and_spread),
        cmocka_unit_test(effect_areas_grow_with_the_radius),
        cmocka_unit_test(what_cannot_be_held_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_scale.c -- the correction against polar coordinates, and locks. */
#include "field/scale.h"
#include "unit/field/test_field.h"

static otx_vec3
vertex(const field_surface *s, int32_t v)
{
    return otx_vec3_load(s->surface.points, v);
}

/* Rays from a point outside a plane piece: the gradient of ln r along r, so
 * f = -ln r up to a constant. */
static void
rays_shrink_like_the_radius(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *level = s->connection.level;
    otx_direction_pin *pins =
        OTX_NEW(run->arena, otx_direction_pin, level->face_count);
    const otx_vec3 eye = {-3, 1, 0};
    otx_direction_request q = {
        .symmetry = 2, .pins = pins, .pin_count = level->face_count};
    otx_direction field;
    double *f, low = INFINITY, high = -INFINITY;

    (void)state;
    for (int32_t i = 0; i < level->face_count; ++i)
        pins[i] =
            (otx_direction_pin){i, otx_vec3_sub(s->connection.centres[i], eye)};
    assert_int_equal(
        otx_direction_solve(run, &s->connection, &q, &field), OSDTEX_OK);
    assert_int_equal(otx_scale_solve(run, &field, 100.0, &f), OSDTEX_OK);
    for (int32_t v = 0; v < level->vert_count; ++v)
    {
        const double c =
            f[v] + log(otx_vec3_length(otx_vec3_sub(vertex(s, v), eye)));

        low = fmin(low, c);
        high = fmax(high, c);
    }
    assert_true(high - low < 0.02);
    test_run_destroy(run);
}

static void
the_limit_holds_and_the_mean_stays(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *level = s->connection.level;
    otx_direction field;
    double *f, low = INFINITY, high = -INFINITY, sum = 0.0;

    (void)state;
    assert_int_equal(
        otx_direction_solve(
            run, &s->connection, &(otx_direction_request){.symmetry = 1},
            &field),
        OSDTEX_OK);
    assert_int_equal(otx_scale_solve(run, &field, 0.3, &f), OSDTEX_OK);
    for (int32_t v = 0; v < level->vert_count; ++v)
    {
        low = fmin(low, f[v]);
        high = fmax(high, f[v]);
    }
    assert_true(high - low > 0.2 && high - low <= 0.6);
    for (int32_t i = 0; i < level->face_count; ++i)
    {
        double mean = 0.0;

        for (int32_t k = 0; k < 4; ++k)
            mean += f[level->face_verts[4 * i + k]] / 4;
        sum += s->connection.areas[i] * exp(2.0 * mean);
    }
    assert_true(fabs(sum / s->connection.area - 1.0) < 1e-9);
    assert_int_equal(otx_scale_solve(run, &field, 0.0, &f), OSDTEX_OK);
    assert_true(f[0] == 0.0);
    test_run_destroy(run);
}

static void
values_between_locks_are_harmonic(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 2);
    const int32_t count = s->connection.level->vert_count;
    otx_scale_lock *locks = OTX_NEW(run->arena, otx_scale_lock, count);
    double *values = OTX_ZNEW(run->arena, double, count);
    int32_t lock_count = 0;

    (void)state;
    for (int32_t v = 0; v < count; ++v)
    {
        const double x = vertex(s, v).x;

        if (x < 1e-6 || x > 4.0 - 1e-6)
            locks[lock_count++] = (otx_scale_lock){v, x};
    }
    assert_int_equal(
        otx_scale_smooth(
            run, &s->connection, locks, lock_count, 0.0, 3.0, 1.0, NULL,
            values),
        OSDTEX_OK);
    for (int32_t v = 0; v < count; ++v)
        assert_true(fabs(values[v] - fmin(vertex(s, v).x, 3.0)) < 0.02);
    locks[0].value = NAN;
    assert_int_equal(
        otx_scale_smooth(
            run, &s->connection, locks, lock_count, 0.0, 3.0, 1.0, NULL,
            values),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

static void
without_locks_the_fallback_holds(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    const int32_t count = s->connection.level->vert_count;
    double *values = OTX_ZNEW(run->arena, double, count);

    (void)state;
    assert_int_equal(
        otx_scale_smooth(
            run, &s->connection, NULL, 0, 0.0, 1.0, 0.25, NULL, values),
        OSDTEX_OK);
    for (int32_t v = 0; v < count; ++v)
        assert_true(fabs(values[v] - 0.25) < 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_shrink_like_the_radius),
        cmocka_unit_test(the_limit_holds_and_the_mean_stays),
        cmocka_unit_test(values_between_locks_are_harmonic),
        cmocka_unit_test(without_locks_the_fallback_holds),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

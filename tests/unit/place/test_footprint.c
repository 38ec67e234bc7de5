/* test_footprint.c -- pictures laid on surfaces of which it is known how they
 * lie flat. */
#include "bent.h"

static otx_footprint
lay(otx_run *run, const otx_footprint_ask *ask)
{
    const otx_footprint_space space = bent_space(run->scratch, ask->surface);
    const otx_level *leaf = otx_surface_leaf(ask->surface);
    otx_footprint f;

    assert_int_equal(
        otx_footprint_lay(run->scratch, ask, &space, &f), OSDTEX_OK);
    for (int32_t i = 0; i < leaf->face_count; ++i)
        assert_int_equal(space.face_slot[i], -1);
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        assert_int_equal(space.vert_slot[v], -1);
    return f;
}

/* Where a vertex of the surface lies in the plane. */
static otx_vec2
place_of(const otx_footprint *f, int32_t vert)
{
    for (int32_t v = 0; v < f->vert_count; ++v)
        if (f->verts[v] == vert)
            return f->flat[v];
    return (otx_vec2){NAN, NAN};
}

/* On a plane nothing moves, wherever it lies and however it is turned. */
static void
test_plane_stays_as_it_is(void **state)
{
    otx_run *run = *state;
    const otx_surface *surface = bent_create(run->arena, 0.0, false);
    const otx_vec3 point = {0.43, 0.52, 0.3};
    otx_footprint_ask ask = bent_ask(surface, point, 0.4);
    const otx_vec3 right = {0.8, 0.6, 0};
    otx_footprint f;

    assert_true(fabs(ask.spot.distance - 0.3) < 1e-6);
    ask.up = (otx_vec3){-0.6, 0.8, 0};
    f = lay(run, &ask);
    for (int32_t v = 0; v < f.vert_count; ++v)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(surface->points, f.verts[v]),
            (otx_vec3){point.x, point.y, 0});

        assert_true(fabs(f.flat[v].x - otx_vec3_dot(d, right) / 0.4) < 1e-5);
        assert_true(fabs(f.flat[v].y - otx_vec3_dot(d, ask.up) / 0.4) < 1e-5);
    }
    assert_true(f.stretch_p95 < 1.0 + 1e-5);
    assert_true(fabs(f.covered - 1.0) < 1e-6);
    assert_false(f.is_cut);
}

/* A roll is unrolled: distances around it are those of the plane. */
static void
test_roll_is_unrolled(void **state)
{
    otx_run *run = *state;
    const otx_surface *surface = bent_create(run->arena, 0.3, false);
    const otx_footprint_ask ask = bent_ask(surface, (otx_vec3){0, 0, 0}, 0.5);
    const otx_footprint f = lay(run, &ask);
    /* The middle vertex, and one four faces to its right. */
    const int32_t middle = BENT_FACES / 2 * (BENT_FACES + 1) + BENT_FACES / 2;
    const otx_vec2 d =
        otx_vec2_sub(place_of(&f, middle + 4), place_of(&f, middle));

    assert_true(f.stretch_p95 < 1.002);
    assert_true(fabs(d.x - 4.0 / BENT_FACES / 0.5) < 2e-3);
    assert_true(fabs(d.y) < 1e-3);
    assert_true(fabs(f.covered - 1.0) < 1e-3);
}

/* A ball cannot lie flat: what is small on it nearly does. */
static void
test_ball_stretches_what_is_large(void **state)
{
    otx_run *run = *state;
    const otx_surface *surface = bent_create(run->arena, 0.4, true);
    const otx_footprint_ask small = bent_ask(surface, (otx_vec3){0, 0, 0}, 0.2);
    const otx_footprint_ask large = bent_ask(surface, (otx_vec3){0, 0, 0}, 0.8);

    assert_true(lay(run, &small).stretch_p95 < 1.05);
    assert_true(lay(run, &large).stretch_p95 > 1.05);
    assert_true(lay(run, &large).stretch_p95 < 1.3);
}

/* At the rim of the surface a part hangs over; what is wider than a roll is
 * around would lie over itself. */
static void
test_what_has_no_room_is_found_out(void **state)
{
    otx_run *run = *state;
    const otx_surface *plane = bent_create(run->arena, 0.0, false);
    const otx_footprint_ask rim = bent_ask(plane, (otx_vec3){1, 0.5, 0}, 0.4);
    const otx_footprint f = lay(run, &rim);

    assert_true(fabs(f.covered - 0.5) < 1e-6);
    assert_false(f.is_cut);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(test_plane_stays_as_it_is),
        test_with_run(test_roll_is_unrolled),
        test_with_run(test_ball_stretches_what_is_large),
        test_with_run(test_what_has_no_room_is_found_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

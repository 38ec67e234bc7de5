/* test_lay_down.c -- pictures where they were asked for, and what is said where
 * that cannot be. */
#include "bent.h"

#include "place/place.h"

typedef struct stage
{
    otx_run *run;
    const otx_surface *surface;
    otx_place_item item;
    otx_lookups lookups;
    otx_place_figures figures;
} stage;

static stage
set(otx_run *run, const otx_surface *surface)
{
    return (stage){
        .run = run,
        .surface = surface,
        .item = {
            .number = 1,
            .face = -1,
            .point = {0.3, 0.6, 0},
            .width = 0.2,
            .opacity = 1.0,
            .anchor = {0.5, 0.5}}};
}

/* With a picture twice as wide as high. */
static otx_status
place(stage *s)
{
    const otx_exemplar *picture =
        test_exemplar_create(s->run->arena, 64, 32, false, 1);
    const otx_place_list list = {NULL, 1, &s->item, picture};

    return otx_place_all(s->run, s->surface, &list, &s->lookups, &s->figures);
}

/* u, v at a point of the plane, of the decal that lies there. */
static otx_vec2
uv_at(const stage *s, otx_vec3 point)
{
    const otx_spot spot = otx_spot_nearest(s->surface, point);
    const otx_lookup *items = s->lookups.items + s->lookups.first[spot.face];
    const int32_t first = otx_surface_leaf(s->surface)->face_first[spot.face];
    otx_vec2 uv = {0, 0};

    assert_true(s->lookups.first[spot.face + 1] > s->lookups.first[spot.face]);
    for (int k = 0; k < 3; ++k)
    {
        const float *at = items[spot.corners[k] - first].uv;

        uv = otx_vec2_add(
            uv, otx_vec2_scale(spot.at[k], (otx_vec2){at[0], at[1]}));
    }
    return uv;
}

static void
assert_uv(const stage *s, double x, double y, double u, double v)
{
    const otx_vec2 uv = uv_at(s, (otx_vec3){x, y, 0});

    assert_true(fabs(uv.x - u) < 1e-4 && fabs(uv.y - v) < 1e-4);
}

static void
test_lies_where_and_as_it_was_asked_for(void **state)
{
    stage s = set(*state, bent_create(((otx_run *)*state)->arena, 0, false));

    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.3, 0.6, 0.5, 0.5);
    assert_uv(&s, 0.38, 0.64, 0.9, 0.9);
    assert_int_equal(s.figures.count, 1);
    assert_true(s.figures.offset < 0.01);
    assert_true(s.figures.stretch_p95 < 1.0001);
    s.item.mirror = true;
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.38, 0.64, 0.1, 0.9);
    s.item.mirror = false;
    s.item.turn = 0.5 * OTX_PI; /* its top is to the left */
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.26, 0.68, 0.9, 0.9);
    s.item.turn = 0.0;
    s.item.anchor = (otx_vec2){0, 1};
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.38, 0.54, 0.4, 0.4);
    s.item.height = 0.2;
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.38, 0.54, 0.4, 0.7);
}

/* Mirrored, the anchor is still where it was asked for. */
static void
test_mirrored_about_its_anchor(void **state)
{
    stage s = set(*state, bent_create(((otx_run *)*state)->arena, 0, false));

    s.item.mirror = true;
    s.item.anchor = (otx_vec2){0.25, 0.5};
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_uv(&s, 0.3, 0.6, 0.25, 0.5);
    assert_uv(&s, 0.26, 0.6, 0.45, 0.5);
}

static void
test_what_cannot_be_is_said(void **state)
{
    otx_run *run = *state;
    stage s = set(run, bent_create(run->arena, 0, false));

    s.item.face = BENT_FACES * BENT_FACES;
    assert_int_equal(place(&s), OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "there is no face 576"));
    s.item.face = -1;
    s.item.has_up = true;
    s.item.up = (otx_vec3){0, 0, 1};
    assert_int_equal(place(&s), OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "straight out"));
    s.item.has_up = false;
    s.item.point = (otx_vec3){0, 0.5, 0};
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_non_null(strstr(test_last_message(run), "50.0 % of the picture"));
    s.item.point.z = 7;
    assert_int_equal(place(&s), OSDTEX_OK);
}

/* What is stretched is said with a width that is not; wider than a tube is
 * around, it would meet itself. */
static void
test_too_large_is_said(void **state)
{
    otx_run *run = *state;
    stage s = set(run, bent_create(run->arena, 0.4, true));

    s.item.point = (otx_vec3){0, 0, 0};
    s.item.width = 0.8;
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_non_null(strstr(test_last_message(run), "is stretched by"));
    assert_true(s.figures.stretch_p95 > 1.05);
}

/* Without overlap, undistorted, and the same again. */
static void
test_scattered(void **state)
{
    otx_run *run = *state;
    stage s = set(run, bent_create(run->arena, 0, false));
    int64_t items;

    s.item.scatter = 9;
    s.item.width = 0.1;
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_int_equal(s.figures.count, 9);
    assert_int_equal(s.lookups.fragment_count, 9);
    items = s.lookups.first[BENT_FACES * BENT_FACES];
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_int_equal(s.lookups.first[BENT_FACES * BENT_FACES], items);
    s.item.width = 0.6;
    assert_int_equal(place(&s), OSDTEX_OK);
    assert_true(s.figures.count < 9);
    assert_non_null(strstr(test_last_message(run), "there was room for"));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(test_lies_where_and_as_it_was_asked_for),
        test_with_run(test_mirrored_about_its_anchor),
        test_with_run(test_what_cannot_be_is_said),
        test_with_run(test_too_large_is_said),
        test_with_run(test_scattered),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

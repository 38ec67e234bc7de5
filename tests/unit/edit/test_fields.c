/* test_fields.c -- fields that are edited in an area and nowhere else. */
#include "edits.h"

static const double REACH = 0.6;

/* A place around a face of the cage that is asked for something. */
static otx_edit_place
place_of(edits *e, const otx_constraint_set *set, uint8_t **area)
{
    otx_edit_place p;

    *area = OTX_ZNEW(e->run->arena, uint8_t, e->leaf->face_count);
    assert_int_equal(
        otx_area_find(e->run, &e->surface, set, 1, REACH, *area), OSDTEX_OK);
    assert_int_equal(
        otx_edit_place_make(e->run, &e->surface, set, 1, *area, &p), OSDTEX_OK);
    return p;
}

static void
the_area_is_what_is_held_and_reached(void **state)
{
    edits *e = edits_open();
    const otx_constraint item = {.face = 5, .scale = 2.0, .edit = 1};
    const otx_constraint_set set = {.count = 1, .items = &item};
    uint8_t *area;
    int32_t count = 0;

    (void)state;
    place_of(e, &set, &area);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        if (e->leaf->face_cage[f] == 5)
            assert_true(area[f]);
        count += area[f];
    }
    assert_true(count > 16 && count < e->leaf->face_count / 2);
    test_run_destroy(e->run);
}

/* The direction is as asked where it is held, and as it was outside. */
static void
directions_change_in_the_area_alone(void **state)
{
    edits *e = edits_open();
    const otx_constraint item = {
        .face = 5,
        .has_direction = true,
        .direction = {1, 0.2, 0.1},
        .edit = 1};
    const otx_constraint_set set = {.count = 1, .items = &item};
    const otx_vec3 wanted = otx_vec3_unit(item.direction);
    const otx_guide *guide;
    otx_edit_place p;
    uint8_t *area;

    (void)state;
    p = place_of(e, &set, &area);
    assert_int_equal(otx_edit_guide(e->run, &p, &e->guide, &guide), OSDTEX_OK);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        const otx_vec3 d = guide->directions[f];
        otx_vec3 n, along;

        if (!area[f])
            assert_memory_equal(&d, &e->guide.directions[f], sizeof d);
        if (e->leaf->face_cage[f] != 5)
            continue;
        n = otx_vec3_unit(otx_dual_leaf_area(&e->surface, f, &along));
        along = otx_vec3_unit(
            otx_vec3_sub(wanted, otx_vec3_scale(otx_vec3_dot(wanted, n), n)));
        assert_true(fabs(otx_vec3_dot(along, d)) > 0.999);
    }
    test_run_destroy(e->run);
}

static void
sizes_change_in_the_area_alone(void **state)
{
    edits *e = edits_open();
    const otx_constraint item = {.face = 5, .scale = 2.0, .edit = 1};
    const otx_constraint_set set = {.count = 1, .items = &item};
    const float *density;
    otx_edit_place p;
    uint8_t *area;

    (void)state;
    p = place_of(e, &set, &area);
    assert_int_equal(otx_edit_density(e->run, &p, &density), OSDTEX_OK);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        for (int32_t c = e->leaf->face_first[f]; c < e->leaf->face_first[f + 1];
             ++c)
        {
            const float d = density[e->leaf->face_verts[c]];

            if (!area[f])
                assert_true(d == 1.0f);
            if (e->leaf->face_cage[f] == 5)
                assert_true(fabsf(d - 0.5f) < 1e-6f);
            assert_true(d >= 0.4999f && d <= 1.0001f);
        }
    test_run_destroy(e->run);
}

/* A constraint that holds faces elsewhere says nothing in the area. */
static void
earlier_constraints_hold_where_they_were(void **state)
{
    edits *e = edits_open();
    const otx_vec3 far =
        otx_vec3_load(e->surface.points, e->leaf->face_verts[0]);
    const otx_constraint items[] = {
        {.face = -1, .point = {-far.x, -far.y, -far.z}, .scale = 8.0},
        {.face = 0, .scale = 2.0, .edit = 1}};
    const otx_constraint_set set = {.count = 2, .items = items};
    const float *density;
    otx_edit_place p;
    uint8_t *area;

    (void)state;
    p = place_of(e, &set, &area);
    assert_int_equal(otx_edit_density(e->run, &p, &density), OSDTEX_OK);
    for (int32_t v = 0; v < e->leaf->vert_count; ++v)
        assert_true(density[v] > 0.49f);
    test_run_destroy(e->run);
}

static void
upright_directions_are_refused(void **state)
{
    edits *e = edits_open();
    const int32_t first = e->leaf->face_first[0];
    const otx_constraint item = {
        .face = -1,
        .point = otx_vec3_load(e->surface.points, e->leaf->face_verts[first]),
        .has_direction = true,
        .direction =
            otx_vec3_load(e->surface.normals, e->leaf->face_verts[first]),
        .edit = 1};
    const otx_constraint_set set = {.count = 1, .items = &item};
    const otx_guide *guide;
    otx_edit_place p;
    otx_status status;
    uint8_t *area;

    (void)state;
    p = place_of(e, &set, &area);
    status = otx_edit_guide(e->run, &p, &e->guide, &guide);
    /* The nearest face leans a little against the normal of its corner. */
    assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(e->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_area_is_what_is_held_and_reached),
        cmocka_unit_test(directions_change_in_the_area_alone),
        cmocka_unit_test(sizes_change_in_the_area_alone),
        cmocka_unit_test(earlier_constraints_hold_where_they_were),
        cmocka_unit_test(upright_directions_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

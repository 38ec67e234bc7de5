/* test_closest.c -- nearest points by the tree, against looking at all faces.
 */
#include "unit/cluster/sheets.h"

#include "base/random.h"
#include "surface/closest.h"

static otx_vec3
random_point(uint64_t i)
{
    otx_vec3 p;

    p.x = 4.0 * otx_random_unit(1, 0, 3 * i) - 2.0;
    p.y = 4.0 * otx_random_unit(1, 0, 3 * i + 1) - 2.0;
    p.z = 4.0 * otx_random_unit(1, 0, 3 * i + 2) - 2.0;
    return p;
}

static otx_vec3
facet_normal(const otx_vec3 t[3])
{
    return otx_vec3_unit(
        otx_vec3_cross(otx_vec3_sub(t[1], t[0]), otx_vec3_sub(t[2], t[0])));
}

/* Distance by looking at every facet that is meant. */
static double
distance_by_all(const otx_surface *surface, const otx_closest_ask *ask)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    double best = ask->reach;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = 0; i < otx_facet_count(leaf, f); ++i)
        {
            const otx_facet facet = otx_facet_at(leaf, f, i);
            otx_vec3 t[3];
            double at[3];

            otx_closest_corners(surface, facet.corners, t);
            if (ask->labels && ask->labels[f] != ask->label)
                continue;
            if (otx_vec3_length(ask->normal) > 0.0 &&
                otx_vec3_dot(facet_normal(t), ask->normal) < 0.5)
                continue;
            best = fmin(best, otx_closest_on(ask->point, t, at));
        }
    return best;
}

static void
compare(const otx_surface *surface, otx_closest_ask ask)
{
    otx_run *run = test_run_create();
    otx_closest tree;

    assert_int_equal(otx_closest_build(run, surface, &tree), OSDTEX_OK);
    for (uint64_t i = 0; i < 200; ++i)
    {
        otx_closest_place place;
        otx_vec3 t[3], at = {0, 0, 0};

        ask.point = random_point(i);
        place = otx_closest_find(&tree, &ask);
        assert_true(
            fabs(place.distance - distance_by_all(surface, &ask)) < 1e-12);
        if (place.face < 0)
            continue;
        otx_closest_corners(surface, place.corners, t);
        for (int k = 0; k < 3; ++k)
            at = otx_vec3_mix(1.0, at, place.at[k], t[k]);
        assert_true(
            fabs(
                otx_vec3_length(otx_vec3_sub(at, ask.point)) - place.distance) <
            1e-12);
    }
    test_run_destroy(run);
}

static void
the_tree_finds_what_all_faces_have(void **state)
{
    otx_run *run = test_run_create();
    otx_surface surface = sheet_from_file(run, "models/cages/torus.obj", 2);
    const int32_t faces = otx_surface_leaf(&surface)->face_count;
    int32_t *labels = OTX_NEW(run->arena, int32_t, faces);

    (void)state;
    for (int32_t f = 0; f < faces; ++f)
        labels[f] = f % 3;
    compare(&surface, (otx_closest_ask){.reach = (double)INFINITY});
    compare(&surface, (otx_closest_ask){.reach = 0.3});
    compare(
        &surface,
        (otx_closest_ask){.reach = 3.0, .labels = labels, .label = 2});
    compare(
        &surface,
        (otx_closest_ask){.reach = (double)INFINITY, .normal = {0, 1, 0}});
    test_run_destroy(run);
}

static void
a_triangle_without_area_still_has_sides(void **state)
{
    const otx_vec3 t[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    double at[3];

    (void)state;
    assert_true(
        fabs(otx_closest_on((otx_vec3){1.5, 2.0, 0.0}, t, at) - 2.0) < 1e-12);
    assert_false(otx_closest_below((otx_vec3){1.5, 2.0, 0.0}, t, at));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_finds_what_all_faces_have),
        cmocka_unit_test(a_triangle_without_area_still_has_sides),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

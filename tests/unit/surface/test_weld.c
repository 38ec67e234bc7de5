/* test_weld.c -- vertices that lie in one place. */
#include "meshes.h"

#include "base/random.h"
#include "math/vec.h"
#include "surface/weld.h"

/* Against all pairs: the smallest vertex that stays and is near enough. */
static void
test_as_by_all_pairs(void **state)
{
    enum
    {
        COUNT_POINTS = 400
    };
    static const double distances[] = {0.0, 1e-6, 0.03, 0.2};
    otx_run *run = test_run_create();
    float *points = OTX_NEW(run->arena, float, 3 * COUNT_POINTS);

    (void)state;
    for (int32_t i = 0; i < 3 * COUNT_POINTS; ++i)
        points[i] = i >= 900 ? points[i - 900]
                             : (float)otx_random_unit(7, 0, (uint64_t)i) - 0.5f;
    for (int32_t k = 0; k < COUNT(distances); ++k)
    {
        int32_t *first =
            otx_weld_find(run->arena, points, COUNT_POINTS, NULL, distances[k]);

        for (int32_t v = 0; v < COUNT_POINTS; ++v)
        {
            int32_t best = v;

            for (int32_t w = v - 1; w >= 0; --w)
                if (first[w] == w &&
                    otx_vec3_length(otx_vec3_sub(
                        otx_vec3_load(points, v), otx_vec3_load(points, w))) <=
                        distances[k])
                    best = w;
            assert_int_equal(first[v], best);
        }
    }
    test_run_destroy(run);
}

/* A cube whose faces have vertices of their own. */
static otx_cage_input
loose_cube(otx_run *run, float gap)
{
    float *points = OTX_NEW(run->arena, float, 72);
    int32_t *verts = OTX_NEW(run->arena, int32_t, 24);

    for (int32_t c = 0; c < 24; ++c)
    {
        verts[c] = c;
        for (int32_t k = 0; k < 3; ++k)
            points[3 * c + k] =
                cube_points[3 * cube_verts[c] + k] + gap * (float)(c % 5);
    }
    return mesh_input(run, points, 24, verts, 6, 4);
}

static void
test_open_edges_are_told_and_closed(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = loose_cube(run, 0.0f);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;

    (void)state;
    cage = mesh_build(run, &in, &options);
    assert_int_equal(cage.edge_count, 24);
    assert_non_null(
        strstr(test_last_message(run), "24 vertices lie at only 8 places"));
    options.weld = 0.0;
    for (int32_t i = 0; i < 2; ++i)
    {
        cage = mesh_build(run, &in, &options);
        assert_int_equal(cage.vert_count, 24);
        assert_int_equal(cage.edge_count, 12);
        s = mesh_refine(run, &cage, 2);
        for (int32_t k = 0; k < 3; ++k)
            assert_near(s.points[k], 0.5 * in.points[k], 0.01);
        in = loose_cube(run, 1e-4f);
        options.weld = 0.01;
    }
    assert_null(strstr(test_last_message(run), "belong to no face"));
    test_run_destroy(run);
}

/* Cards that only cross or touch are as they are meant. */
static void
test_what_cannot_be_closed_is_no_gap(void **state)
{
    static const float points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0,  1, 0,
                                   0, 0, 0, 0, 0, 1, 0, 1, 1, -1, 0, 0};
    static const int32_t verts[] = {0, 1, 2, 3, 4, 5, 6, 7};
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_input(run, points, 8, verts, 2, 4);

    (void)state;
    mesh_build(run, &in, NULL);
    assert_string_equal(test_last_message(run), "");
    test_run_destroy(run);
}

/* A face that would be left with a vertex twice is refused, not dropped. */
static void
test_too_large_a_distance(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cage;

    (void)state;
    options.weld = 3.0;
    assert_int_equal(
        otx_cage_build(run, &in, &options, &cage), OSDTEX_ERROR_TOPOLOGY);
    assert_non_null(strstr(test_last_message(run), "repeats vertex"));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_by_all_pairs),
        cmocka_unit_test(test_open_edges_are_told_and_closed),
        cmocka_unit_test(test_what_cannot_be_closed_is_no_gap),
        cmocka_unit_test(test_too_large_a_distance)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

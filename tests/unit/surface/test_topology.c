#include "meshes.h"
#include "surface/topology.h"

static void
test_edges_of_a_cube(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_topology t;

    (void)state;
    assert_true(otx_topology_build(
        run->arena, in.vert_count, in.face_count, in.face_first, in.face_verts,
        &t));
    assert_int_equal(t.edge_count, 12);
    for (int32_t e = 0; e < t.edge_count; ++e)
    {
        const int32_t *v = t.edge_verts + 2 * e;

        assert_int_equal(otx_topology_edge_size(&t, e), 2);
        assert_true(v[0] < v[1]);
        assert_int_equal(otx_topology_find_edge(&t, v[1], v[0]), e);
    }
    assert_int_equal(otx_topology_find_edge(&t, 0, 3), -1);
    assert_int_equal(otx_topology_find_edge(&t, 6, 7), 11);
    test_run_destroy(run);
}

static void
test_twins_and_neighbours_are_inverse(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 5);
    int32_t border = 0;
    otx_topology t;

    (void)state;
    assert_true(otx_topology_build(
        run->arena, in.vert_count, in.face_count, in.face_first, in.face_verts,
        &t));
    for (int32_t c = 0; c < t.corner_count; ++c)
    {
        const int32_t twin = otx_topology_twin(&t, c);

        assert_int_equal(
            otx_topology_previous(&t, otx_topology_next(&t, c)), c);
        border += twin < 0;
        if (twin < 0)
            continue;
        assert_int_equal(otx_topology_twin(&t, twin), c);
        assert_int_equal(
            t.face_verts[twin], t.face_verts[otx_topology_next(&t, c)]);
    }
    assert_int_equal(border, 20);
    test_run_destroy(run);
}

static void
test_fans(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 2);
    const otx_topology_fan *fans;
    otx_topology t;

    (void)state;
    assert_true(otx_topology_build(
        run->arena, in.vert_count + 1, in.face_count, in.face_first,
        in.face_verts, &t));
    fans = otx_topology_fans(run->arena, &t);
    assert_int_equal(fans[4].faces, 4);
    assert_int_equal(fans[4].border, 0);
    assert_int_equal(otx_topology_fan_size(&t, fans[4].start), 4);
    assert_int_equal(fans[1].faces, 2);
    assert_int_equal(fans[1].border, 1);
    assert_int_equal(otx_topology_fan_size(&t, fans[1].start), 2);
    assert_int_equal(fans[9].start, -1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edges_of_a_cube),
        cmocka_unit_test(test_twins_and_neighbours_are_inverse),
        cmocka_unit_test(test_fans)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

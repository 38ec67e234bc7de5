/* test_sever.c -- meshes that are no manifold, cut until they are. */
#include "meshes.h"

#include "base/random.h"
#include "surface/sever.h"
#include "surface/topology.h"

/* Severs a triangle mesh; what comes out must be a manifold whose corners are
 * where they were. */
static otx_sever
sever(otx_run *run, int32_t vert_count, const int32_t *verts, int32_t faces)
{
    int32_t *first = OTX_NEW(run->arena, int32_t, faces + 1);
    const otx_topology_fan *fans;
    otx_topology t;
    otx_sever s;

    for (int32_t f = 0; f <= faces; ++f)
        first[f] = 3 * f;
    assert_true(
        otx_sever_build(run->arena, vert_count, faces, first, verts, &s));
    for (int32_t c = 0; s.source && c < 3 * faces; ++c)
        assert_int_equal(s.source[s.face_verts[c]], verts[c]);
    for (int32_t v = 0; s.source && v < vert_count; ++v)
        assert_int_equal(s.source[v], v);
    assert_true(otx_topology_build(
        run->arena, s.vert_count, faces, first, s.face_verts, &t));
    for (int32_t e = 0; e < t.edge_count; ++e)
    {
        const int32_t *corners = t.edge_corners + t.edge_corner_first[e];
        const int32_t size = otx_topology_edge_size(&t, e);

        assert_in_range(size, 1, 2);
        if (size == 2)
            assert_int_not_equal(
                s.face_verts[corners[0]], s.face_verts[corners[1]]);
    }
    fans = otx_topology_fans(run->arena, &t);
    for (int32_t v = 0; v < s.vert_count; ++v)
        if (fans[v].start >= 0)
            assert_int_equal(
                otx_topology_fan_size(&t, fans[v].start), fans[v].faces);
    return s;
}

static void
test_manifold_is_left_alone(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 2, 1, 3};
    otx_run *run = test_run_create();
    const otx_sever s = sever(run, 4, verts, 2);

    (void)state;
    assert_ptr_equal(s.face_verts, verts);
    assert_null(s.source);
    assert_int_equal(s.vert_count, 4);
    test_run_destroy(run);
}

/* Each of the three pages of a book gets a spine. */
static void
test_three_faces_at_an_edge(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(sever(run, 5, verts, 3).vert_count, 9);
    test_run_destroy(run);
}

static void
test_flipped_face(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 1, 2, 3};
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(sever(run, 4, verts, 2).vert_count, 6);
    test_run_destroy(run);
}

static void
test_parts_that_touch_in_a_vertex(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 0, 3, 4};
    otx_run *run = test_run_create();
    const otx_sever s = sever(run, 5, verts, 2);

    (void)state;
    assert_int_equal(s.vert_count, 6);
    assert_int_equal(s.face_verts[0], 0);
    assert_int_equal(s.face_verts[3], 5);
    test_run_destroy(run);
}

/* Two tetrahedra glued along an edge are two closed sheets again. */
static void
test_sheets_that_touch_along_an_edge(void **state)
{
    static const int32_t verts[] = {
        0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 1, 4, 0, 5, 1, 1, 5, 4, 4, 5, 0};
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(sever(run, 6, verts, 8).vert_count, 8);
    test_run_destroy(run);
}

/* A strip with a half turn, and one whose cut would be a slit that both ends
 * hold together. */
static void
test_moebius_strips(void **state)
{
    static const int32_t strip[] = {
        0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 1, 1, 5, 0};
    static const int32_t five[] = {0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 4, 0, 1};
    otx_run *run = test_run_create();

    (void)state;
    sever(run, 6, strip, 6);
    sever(run, 5, five, 5);
    test_run_destroy(run);
}

static void
test_the_same_face_twice(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 1, 2, 0};
    otx_run *run = test_run_create();

    (void)state;
    assert_int_equal(sever(run, 3, verts, 2).vert_count, 6);
    test_run_destroy(run);
}

/* Whatever the faces are. */
static void
test_soups(void **state)
{
    enum
    {
        VERTS = 9,
        FACES = 40
    };
    otx_run *run = test_run_create();

    (void)state;
    for (uint64_t seed = 0; seed < 50; ++seed)
    {
        int32_t *verts = OTX_NEW(run->arena, int32_t, 3 * FACES);

        for (int32_t f = 0; f < FACES; ++f)
        {
            const uint64_t r = otx_random_bits(seed, 0, (uint64_t)f);

            verts[3 * f] = (int32_t)(r % VERTS);
            verts[3 * f + 1] =
                (verts[3 * f] + 1 + (int32_t)(r / VERTS % (VERTS - 1))) % VERTS;
            verts[3 * f + 2] = (int32_t)(r / 1000 % VERTS);
            while (verts[3 * f + 2] == verts[3 * f] ||
                   verts[3 * f + 2] == verts[3 * f + 1])
                verts[3 * f + 2] = (verts[3 * f + 2] + 1) % VERTS;
        }
        sever(run, VERTS, verts, FACES);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_manifold_is_left_alone),
        cmocka_unit_test(test_three_faces_at_an_edge),
        cmocka_unit_test(test_flipped_face),
        cmocka_unit_test(test_parts_that_touch_in_a_vertex),
        cmocka_unit_test(test_sheets_that_touch_along_an_edge),
        cmocka_unit_test(test_moebius_strips),
        cmocka_unit_test(test_the_same_face_twice),
        cmocka_unit_test(test_soups)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

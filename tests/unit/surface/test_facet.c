/* test_facet.c -- the triangles of a face fit together, whatever its size. */
#include "unit/surface/meshes.h"

#include "surface/facet.h"

/* A level with one polygon; corner c is vertex c. */
static otx_level
polygon(otx_run *run, int32_t size)
{
    int32_t *first = OTX_NEW(run->arena, int32_t, 2);

    first[0] = 0;
    first[1] = size;
    return (otx_level){
        .face_count = 1, .corner_count = size, .face_first = first};
}

/* Each edge of the face is a side of one facet, and each side within the face
 * is one of the facet across as well, the other way round. */
static void
sides_meet(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int32_t size = 3; size < 12; ++size)
    {
        const otx_level level = polygon(run, size);
        int32_t edges = 0, inner = 0;

        assert_int_equal(otx_facet_count(&level, 0), size - 2);
        for (int32_t i = 0; i < size - 2; ++i)
        {
            const otx_facet facet = otx_facet_at(&level, 0, i);

            assert_int_equal(facet.index, i);
            for (int32_t k = 0; k < 3; ++k)
            {
                const int32_t a = facet.corners[k];
                const int32_t b = facet.corners[(k + 1) % 3];
                const int32_t across = facet.across[k];

                if (across >= 0)
                {
                    ++edges;
                    assert_int_equal(a, across);
                    assert_int_equal(b, (across + 1) % size);
                    continue;
                }

                const otx_facet other = otx_facet_at(&level, 0, ~across);
                const int32_t side = otx_facet_side(&other, ~i);

                ++inner;
                assert_int_equal(other.across[side], ~i);
                assert_int_equal(other.corners[side], b);
                assert_int_equal(other.corners[(side + 1) % 3], a);
            }
        }
        assert_int_equal(edges, size);
        assert_int_equal(inner, 2 * (size - 3));
    }
    test_run_destroy(run);
}

static void
edges_find_their_facet(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int32_t size = 3; size < 12; ++size)
    {
        const otx_level level = polygon(run, size);

        for (int32_t k = 0; k < size; ++k)
        {
            int32_t side;
            const otx_facet facet = otx_facet_at_edge(&level, 0, k, &side);

            assert_int_equal(facet.across[side], k);
            assert_int_equal(facet.corners[side], k);
        }
    }
    test_run_destroy(run);
}

/* As Blender, three.js and the viewers of USD cut them. */
static void
quads_are_cut_from_their_first_corner(void **state)
{
    otx_run *run = test_run_create();
    const otx_level level = polygon(run, 4);

    (void)state;
    for (int32_t i = 0; i < 2; ++i)
    {
        const otx_facet facet = otx_facet_at(&level, 0, i);

        assert_int_equal(facet.corners[0], 0);
        assert_int_equal(facet.corners[1], i + 1);
        assert_int_equal(facet.corners[2], i + 2);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_meet),
        cmocka_unit_test(edges_find_their_facet),
        cmocka_unit_test(quads_are_cut_from_their_first_corner),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

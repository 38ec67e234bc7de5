/* test_cluster.c -- children, leaves, and what counts as a disc. */
#include "unit/cluster/sheets.h"

static void
leaves_of_children_are_those_of_the_parent(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s =
        sheet_from_file(run, "models/cages/ngons_and_triangles.obj", 2);
    const otx_dual dual = sheet_dual(run, &s, 0);
    otx_cluster_list children;

    (void)state;
    for (int32_t i = 0; i < s.levels[0].face_count; ++i)
    {
        const otx_cluster face = {0, 1, &i, dual.areas[i], -1};
        int32_t count, next = 0;
        double area = 0.0;
        const int32_t *all = otx_cluster_leaves(run->arena, &s, &face, &count);

        assert_int_equal(
            otx_cluster_children(run, &s, &face, &children), OSDTEX_OK);
        assert_int_equal(children.count, otx_level_face_size(&s.levels[0], i));
        for (int32_t k = 0; k < children.count; ++k)
        {
            int32_t n;
            const int32_t *some =
                otx_cluster_leaves(run->arena, &s, &children.clusters[k], &n);

            assert_int_equal(children.clusters[k].level, 1);
            area += children.clusters[k].area;
            for (int32_t j = 0; j < n; ++j)
                assert_int_equal(some[j], all[next++]);
        }
        assert_int_equal(next, count);
        assert_true(fabs(area / face.area - 1.0) < 1e-9);
    }
    test_run_destroy(run);
}

static void
a_leaf_has_no_children(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 2, 2, SHEET_FLAT);
    const int32_t first = 0;
    const otx_cluster face = {0, 1, &first, 1.0, -1};
    otx_cluster_list children;

    (void)state;
    assert_int_equal(
        otx_cluster_children(run, &s, &face, &children), OSDTEX_OK);
    assert_int_equal(children.count, 0);
    test_run_destroy(run);
}

/* Of the 3 x 3 squares, those with a '#'. */
static bool
disc(const char *picture)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 3, 3, SHEET_FLAT);
    int32_t member[9], faces[9], count = 0;
    bool result;

    for (int32_t f = 0; f < 9; ++f)
    {
        member[f] = picture[f] == '#';
        if (member[f])
            faces[count++] = f;
    }
    result = otx_cluster_is_disc(
        run->scratch, &s.levels[0], faces, count, member, 1);
    test_run_destroy(run);
    return result;
}

static void
discs_have_one_outline_without_pinches(void **state)
{
    (void)state;
    assert_true(disc("####..##."));
    assert_true(disc("#########"));
    assert_true(disc("....#...."));
    assert_false(disc("####.####")); /* a ring */
    assert_false(disc("#...#....")); /* pinched */
    assert_false(disc("#.......#")); /* two pieces */
    assert_false(disc("####..#.#"));
}

static void
a_closed_surface_is_no_disc(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, "models/cages/sphere.obj", 0);
    const otx_cluster all = sheet_all(run, &s, 0);
    int32_t *member = OTX_ZNEW(run->arena, int32_t, all.face_count);

    (void)state;
    assert_false(otx_cluster_is_disc(
        run->scratch, &s.levels[0], all.faces, all.face_count, member, 0));
    assert_true(otx_cluster_is_disc(
        run->scratch, &s.levels[0], all.faces, 1, member, -1));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_of_children_are_those_of_the_parent),
        cmocka_unit_test(a_leaf_has_no_children),
        cmocka_unit_test(discs_have_one_outline_without_pinches),
        cmocka_unit_test(a_closed_surface_is_no_disc),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

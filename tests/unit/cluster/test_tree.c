/* test_tree.c -- the stored hierarchy: every level shares the surface out, from
 * the whole through regions and single faces to the leaves. */
#include "unit/cluster/trees.h"

/* Looks into every region, down to single faces. */
static void
open_all(tree_bench *b)
{
    for (int32_t i = 0; i < b->tree.count; ++i)
    {
        const otx_cluster c = otx_cluster_tree_node(&b->tree, i);
        otx_cluster_list children;

        if (c.face_count == 1)
            continue;
        assert_int_equal(
            otx_cluster_tree_children(b->run, &b->tree, &c, &children),
            OSDTEX_OK);
        assert_true(children.count > (i == 0 ? 0 : 1));
    }
    tree_assert_sound(b);
}

static void
every_level_shares_the_surface_out(void **state)
{
    static const char *const cages[] = {"creature", "double_torus",
                                        "hole",     "several_components",
                                        "jack",     "ngons_and_triangles"};

    (void)state;
    for (int32_t i = 0; i < COUNT(cages); ++i)
        for (int32_t level = 0; level < 2; ++level)
        {
            otx_run *run = test_run_create();
            tree_bench *b = tree_plant_cage(run, cages[i], level, 9.0);
            int32_t single = 0;

            open_all(b);
            for (int32_t n = 1; n < b->tree.count; ++n)
                single += b->tree.nodes[n].end - b->tree.nodes[n].first == 1;
            assert_int_equal(single, b->tree.face_count);
            test_run_destroy(run);
        }
}

/* Regions of a level differ little in size, and halve from level to level. */
static void
sizes_are_uniform_within_a_level(void **state)
{
    otx_run *run = test_run_create();
    tree_bench *b =
        tree_plant(sheet_create(run, 48, 48, SHEET_FLAT), run, 0, 9.0);

    (void)state;
    open_all(b);
    for (int32_t i = 1; i < b->tree.count; ++i)
    {
        const otx_cluster_node *n = &b->tree.nodes[i];

        if (n->level < b->tree.face_level && n->target > 8.0)
        {
            assert_true(n->area > 0.2 * n->target);
            assert_true(n->area < 2.0 * n->target);
        }
    }
    test_run_destroy(run);
}

/* Below single faces the surface's own levels are the hierarchy. */
static void
patches_follow_down_to_the_leaves(void **state)
{
    otx_run *run = test_run_create();
    tree_bench *b = tree_plant_cage(run, "jack", 0, 0.0);
    otx_cluster c = otx_cluster_tree_node(&b->tree, 1);
    otx_cluster_list children;

    (void)state;
    assert_int_equal(b->tree.face_level, 1);
    assert_int_equal(otx_cluster_tree_levels(&b->tree), 4);
    for (int32_t level = 1; level < 4; ++level)
    {
        assert_int_equal(otx_cluster_tree_level(&b->tree, &c), level);
        assert_int_equal(
            otx_cluster_tree_children(run, &b->tree, &c, &children), OSDTEX_OK);
        assert_int_equal(children.count, level < 3 ? 4 : 0);
        if (children.count > 0)
            c = children.clusters[3];
    }
    test_run_destroy(run);
}

/* A node that was divided is not divided again, and has the same faces. */
static void
children_are_stored(void **state)
{
    otx_run *run = test_run_create();
    tree_bench *b = tree_plant_cage(run, "creature", 1, 6.0);
    const otx_cluster c = otx_cluster_tree_node(&b->tree, 1);
    otx_cluster_list first, again;
    int32_t count;

    (void)state;
    assert_int_equal(
        otx_cluster_tree_children(run, &b->tree, &c, &first), OSDTEX_OK);
    count = b->tree.count;
    assert_int_equal(
        otx_cluster_tree_children(run, &b->tree, &c, &again), OSDTEX_OK);
    assert_int_equal(b->tree.count, count);
    assert_int_equal(first.count, again.count);
    for (int32_t i = 0; i < first.count; ++i)
        assert_int_equal(first.clusters[i].node, again.clusters[i].node);
    test_run_destroy(run);
}

/* Each part has regions of its own size, and the whole has all. */
static void
parts_have_sizes_of_their_own(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 32, 16, SHEET_FLAT);
    const otx_dual dual = sheet_dual(run, &s, 0);
    int32_t faces[2][256];
    otx_cluster_part parts[2];
    otx_cluster_tree tree;

    (void)state;
    for (int32_t k = 0; k < 2; ++k)
    {
        for (int32_t i = 0; i < 256; ++i)
            faces[k][i] = 32 * (i / 16) + i % 16 + 16 * k;
        parts[k] = (otx_cluster_part){
            {0, 256, faces[k], 256.0, -1}, k == 0 ? 64.0 : 16.0};
    }
    assert_int_equal(
        otx_cluster_tree_create(run, &s, &dual, 1.0, parts, 2, &tree),
        OSDTEX_OK);
    assert_null(otx_cluster_tree_check(&tree, run->scratch));
    assert_int_equal(tree.nodes[0].child_count, 4 + 16);
    assert_true(tree.nodes[1].area > 2.0 * tree.nodes[20].area);
    test_run_destroy(run);
}

static void
what_is_spoilt_is_found(void **state)
{
    otx_run *run = test_run_create();
    tree_bench *b = tree_plant_cage(run, "creature", 0, 6.0);
    otx_cluster_node *n = &b->tree.nodes[1];
    int32_t face = b->tree.faces[n->first];

    (void)state;
    n->parent = 2;
    assert_non_null(
        strstr(otx_cluster_tree_check(&b->tree, run->scratch), "parent"));
    n->parent = 0;
    b->tree.faces[n->first] = b->tree.faces[n->end];
    assert_non_null(otx_cluster_tree_check(&b->tree, run->scratch));
    b->tree.faces[n->first] = face;
    ++n->end;
    ++b->tree.nodes[2].first;
    assert_non_null(otx_cluster_tree_check(&b->tree, run->scratch));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_level_shares_the_surface_out),
        cmocka_unit_test(sizes_are_uniform_within_a_level),
        cmocka_unit_test(patches_follow_down_to_the_leaves),
        cmocka_unit_test(children_are_stored),
        cmocka_unit_test(parts_have_sizes_of_their_own),
        cmocka_unit_test(what_is_spoilt_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

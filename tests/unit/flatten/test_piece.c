/* test_piece.c -- clusters laid out below their polygons: exact on the plane,
 * and the same along a side from both of those who share it. */
#include "unit/cluster/trees.h"
#include "unit/flatten/charts.h"

#include "flatten/piece.h"

typedef struct trial
{
    chart_bench *bench;
    tree_bench *trees;
    otx_controls controls;
} trial;

static trial
make_trial(otx_run *run, tree_bench *trees, double texels)
{
    trial t = {
        .bench = chart_bench_create(run, &trees->surface, texels, 0.0),
        .trees = trees};

    assert_int_equal(
        otx_controls_find(run, &trees->tree, &t.controls), OSDTEX_OK);
    return t;
}

static otx_piece
make_piece(const trial *t, const otx_cluster *cluster, const otx_side *side)
{
    otx_piece p;

    assert_int_equal(
        otx_piece_make(
            &t->bench->request, &t->controls, cluster, side, &t->bench->space,
            t->bench->run->arena, &p),
        OSDTEX_OK);
    chart_check_space(t->bench);
    return p;
}

/* Where a leaf vertex is in a piece; -1 nowhere. */
static int32_t
slot_of(const otx_piece *p, int32_t vert)
{
    for (int32_t i = 0; i < p->vert_count; ++i)
        if (p->verts[i] == vert)
            return i;
    return -1;
}

static void
a_piece_has_the_leaves_of_its_cluster(void **state)
{
    const trial t =
        make_trial(*state, tree_plant_cage(*state, "creature", 1, 8.0), 16.0);
    const otx_level *leaf = otx_surface_leaf(&t.trees->surface);

    for (int32_t node = 1; node < t.trees->tree.count; ++node)
    {
        const otx_cluster c = otx_cluster_tree_node(&t.trees->tree, node);
        const otx_piece p = make_piece(&t, &c, NULL);

        assert_int_equal(p.leaf_count, 4 * c.face_count);
        assert_null(p.value);
        for (int32_t i = 0; i < p.leaf_count; ++i)
            for (int32_t k = p.first[i]; k < p.first[i + 1]; ++k)
                assert_int_equal(
                    p.verts[p.corners[k]],
                    leaf->face_verts
                        [leaf->face_first[p.leaves[i]] + k - p.first[i]]);
        for (int32_t v = 0; v < p.vert_count; ++v)
            assert_true(isfinite(p.flat[v].x) && isfinite(p.flat[v].y));
    }
}

/* What lies in a plane keeps all lengths, however it is divided. */
static void
the_plane_comes_out_exactly(void **state)
{
    const trial t = make_trial(
        *state,
        tree_plant(sheet_create(*state, 9, 7, SHEET_FLAT), *state, 0, 5.0),
        3.0);

    for (int32_t node = 1; node < t.trees->tree.count; ++node)
    {
        const otx_cluster c = otx_cluster_tree_node(&t.trees->tree, node);
        const otx_piece p = make_piece(&t, &c, NULL);

        for (int32_t v = 1; v < p.vert_count; ++v)
            assert_float_equal(
                otx_vec2_length(otx_vec2_sub(p.flat[v], p.flat[0])),
                3.0 * otx_vec3_length(otx_vec3_sub(
                          otx_vec3_load(t.trees->surface.points, p.verts[v]),
                          otx_vec3_load(t.trees->surface.points, p.verts[0]))),
                1e-4);
    }
}

/* Where a place is as seen from a side: 0 and 1 are its ends. */
static otx_vec2
seen_from(const otx_piece *p, const int32_t ends[2], int32_t vert)
{
    const otx_vec2 a = p->flat[slot_of(p, ends[0])];
    const otx_vec2 way = otx_vec2_sub(p->flat[slot_of(p, ends[1])], a);
    const otx_vec2 to = otx_vec2_sub(p->flat[slot_of(p, vert)], a);

    return otx_vec2_scale(
        1.0 / otx_vec2_dot(way, way),
        otx_vec2_mul(to, (otx_vec2){way.x, -way.y}));
}

/* Vertices that two pieces have in common between the ends of a side. */
static int32_t
check_side(const otx_piece *p, const otx_piece *q, const otx_side *side)
{
    int32_t common = 0;

    for (int32_t v = 0; v < p->vert_count; ++v)
    {
        otx_vec2 a, b;

        if (slot_of(q, p->verts[v]) < 0)
            continue;
        a = seen_from(p, side->ends, p->verts[v]);
        b = seen_from(q, side->ends, p->verts[v]);
        /* Other sides that the two share have ends of their own. */
        if (a.x > -0.01 && a.x < 1.01 && fabs(a.y) < 0.4)
        {
            assert_float_equal(a.x, b.x, 1e-5);
            assert_float_equal(a.y, b.y, 1e-5);
            ++common;
        }
    }
    return common;
}

/* Single faces: each neighbour laid against a side meets it at every vertex. */
static void
both_who_share_a_side_see_it_alike(void **state)
{
    const trial t =
        make_trial(*state, tree_plant_cage(*state, "creature", 0, 4.0), 16.0);
    int32_t common = 0;

    for (int32_t face = 0; face < t.trees->surface.levels[0].face_count;
         face += 5)
    {
        const otx_cluster c = {0, 1, &face, 1.0, -1};
        const otx_piece p = make_piece(&t, &c, NULL);
        otx_side *sides;
        int32_t count;

        assert_int_equal(
            otx_piece_sides(&p, t.bench->run->arena, &sides, &count),
            OSDTEX_OK);
        assert_int_equal(count, 4);
        for (int32_t k = 0; k < count; ++k)
        {
            const otx_cluster beyond = {0, 1, &sides[k].face, 1.0, -1};
            const otx_piece q = make_piece(&t, &beyond, NULL);

            common += check_side(&p, &q, &sides[k]);
        }
    }
    assert_true(common > 100);
}

/* A region's neighbours name it as theirs, over the same ends. */
static void
neighbours_are_mutual(void **state)
{
    const trial t =
        make_trial(*state, tree_plant_cage(*state, "torus", 0, 6.0), 16.0);
    int32_t met = 0;

    for (int32_t node = 1; node < t.trees->tree.count; ++node)
    {
        const otx_cluster c = otx_cluster_tree_node(&t.trees->tree, node);
        otx_side *sides, *back;
        int32_t count, back_count;
        otx_piece p;

        if (c.face_count == 1 || t.trees->tree.nodes[node].level != 1)
            continue;
        p = make_piece(&t, &c, NULL);
        assert_int_equal(
            otx_piece_sides(&p, t.bench->run->arena, &sides, &count),
            OSDTEX_OK);
        for (int32_t k = 0; k < count; ++k)
        {
            const otx_piece q = make_piece(&t, &sides[k].beyond, NULL);
            bool found = false;

            assert_int_equal(
                otx_piece_sides(&q, t.bench->run->arena, &back, &back_count),
                OSDTEX_OK);
            for (int32_t j = 0; j < back_count; ++j)
                found = found || (back[j].beyond.node == node &&
                                  back[j].ends[0] == sides[k].ends[1] &&
                                  back[j].ends[1] == sides[k].ends[0]);
            assert_true(found);
            ++met;
        }
    }
    assert_true(met > 10);
}

/* 0 along the side, 1 at all other control vertices, between them elsewhere. */
static void
values_grow_away_from_a_side(void **state)
{
    const trial t =
        make_trial(*state, tree_plant_cage(*state, "creature", 0, 4.0), 16.0);

    for (int32_t face = 0; face < t.trees->surface.levels[0].face_count;
         face += 9)
    {
        const otx_cluster c = {0, 1, &face, 1.0, -1};
        const otx_piece plain = make_piece(&t, &c, NULL);
        otx_side *sides;
        int32_t count;

        assert_int_equal(
            otx_piece_sides(&plain, t.bench->run->arena, &sides, &count),
            OSDTEX_OK);
        for (int32_t k = 0; k < count; ++k)
        {
            const otx_piece p = make_piece(&t, &c, &sides[k]);

            for (int32_t v = 0; v < p.vert_count; ++v)
            {
                assert_true(p.value[v] >= -1e-12 && p.value[v] <= 1.0 + 1e-12);
                assert_memory_equal(
                    &p.flat[v], &plain.flat[v], sizeof p.flat[v]);
            }
            for (int32_t j = 0; j < p.corner_count; ++j)
            {
                const int32_t v = p.polygon[j];

                assert_float_equal(
                    p.value[slot_of(&p, v)],
                    v == sides[k].ends[0] || v == sides[k].ends[1] ? 0.0 : 1.0,
                    0.0);
            }
        }
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(a_piece_has_the_leaves_of_its_cluster),
        test_with_run(the_plane_comes_out_exactly),
        test_with_run(both_who_share_a_side_see_it_alike),
        test_with_run(neighbours_are_mutual),
        test_with_run(values_grow_away_from_a_side),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

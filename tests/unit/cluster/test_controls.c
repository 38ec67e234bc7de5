/* test_controls.c -- control vertices: where three clusters meet, enough for a
 * polygon, and the same for both who share a side. */
#include "unit/cluster/trees.h"

#include "cluster/controls.h"

typedef struct trial
{
    tree_bench *bench;
    const otx_cluster_tree *tree;
    const otx_level *base;
    otx_controls controls;
} trial;

static trial
find(tree_bench *bench)
{
    trial t = {.bench = bench, .tree = &bench->tree, .base = bench->dual.level};

    assert_int_equal(
        otx_controls_find(bench->run, &bench->tree, &t.controls), OSDTEX_OK);
    tree_assert_sound(bench);
    return t;
}

static otx_outline
trace(const trial *t, int32_t node, int32_t level)
{
    otx_outline o;

    assert_int_equal(
        otx_outline_trace(&t->controls, node, level, t->bench->run->arena, &o),
        OSDTEX_OK);
    return o;
}

static const char *const CAGES[] = {
    "creature", "torus", "hole", "open_boundary", "ngons_and_triangles",
    "loop_open"};

enum
{
    CAGE_COUNT = sizeof CAGES / sizeof CAGES[0]
};

static trial
find_cage(otx_run *run, int i)
{
    return find(tree_plant_cage(run, CAGES[i], 1, 8.0));
}

/* Whether a node has a face. */
static bool
has(const trial *t, int32_t node, int32_t face)
{
    const otx_cluster_node *n = &t->tree->nodes[node];

    return face >= 0 && t->tree->place[face] >= n->first &&
           t->tree->place[face] < n->end;
}

static void
faces_are_of_the_cluster_that_has_them(void **state)
{
    for (int i = 0; i < CAGE_COUNT; ++i)
    {
        const trial t = find_cage(*state, i);

        for (int32_t f = 0; f < t.base->face_count; ++f)
            for (int32_t level = 1; level <= t.tree->face_level; ++level)
            {
                const int32_t node =
                    otx_controls_cluster(&t.controls, f, level);

                if (t.base->face_hole[f])
                {
                    assert_int_equal(node, -1);
                    continue;
                }
                assert_true(has(&t, node, f));
                assert_true(t.tree->nodes[node].level <= level);
            }
        assert_int_equal(otx_controls_cluster(&t.controls, -1, 1), -1);
    }
}

/* How many clusters of a level meet in a vertex, up to three; beyond the
 * surface is one. */
static int32_t
clusters_around(const trial *t, int32_t vert, int32_t level)
{
    int32_t met[3], count = 0;

    for (int32_t f = 0; f < t->base->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(t->base, f);
        const int32_t *verts = t->base->face_verts + t->base->face_first[f];

        for (int32_t k = 0; k < size; ++k)
        {
            const bool beyond = otx_level_neighbour(t->base, f, k) < 0;

            if (verts[k] != vert && !(beyond && verts[(k + 1) % size] == vert))
                continue;
            for (int pass = 0; pass < 1 + beyond; ++pass)
            {
                const int32_t node =
                    pass ? -1 : otx_controls_cluster(&t->controls, f, level);
                bool known = verts[k] != vert && !pass;

                for (int32_t j = 0; j < count; ++j)
                    known = known || met[j] == node;
                if (!known && count < 3)
                    met[count++] = node;
            }
        }
    }
    return count;
}

static void
three_clusters_make_a_control_vertex(void **state)
{
    const trial t = find_cage(*state, 0);
    int32_t found = 0;

    for (int32_t v = 0; v < t.base->vert_count; v += 3)
        for (int32_t level = 1; level < t.tree->face_level; ++level)
            if (clusters_around(&t, v, level) >= 3)
            {
                assert_true(t.controls.vert_level[v] <= level);
                ++found;
            }
    assert_true(found > 50);
}

/* An outline goes once around its region, with the region to its left. */
static void
check_outline(const trial *t, int32_t node, const otx_outline *o)
{
    for (int32_t i = 0; i < o->count; ++i)
    {
        const int32_t from = o->verts[i], to = o->verts[(i + 1) % o->count];
        bool is_side = false;

        assert_false(has(t, node, o->outside[i]));
        for (int32_t f = t->tree->nodes[node].first;
             f < t->tree->nodes[node].end; ++f)
        {
            const int32_t face = t->tree->faces[f];
            const int32_t size = otx_level_face_size(t->base, face);
            const int32_t *verts =
                t->base->face_verts + t->base->face_first[face];

            for (int32_t k = 0; k < size; ++k)
                is_side =
                    is_side ||
                    (verts[k] == from && verts[(k + 1) % size] == to &&
                     otx_level_neighbour(t->base, face, k) == o->outside[i]);
        }
        assert_true(is_side);
        for (int32_t j = 0; j < i; ++j)
            assert_int_not_equal(o->verts[j], from);
    }
}

/* Twice the area that the control polygon has at the least. */
static double
area_of(const trial *t, const otx_outline *o)
{
    otx_vec3 sum = {0, 0, 0}, p[3];

    for (int32_t k = 1; k + 1 < o->control_count; ++k)
    {
        const int32_t at[3] = {0, k, k + 1};

        for (int j = 0; j < 3; ++j)
            p[j] = otx_vec3_load(
                t->bench->surface.points, o->verts[o->controls[at[j]]]);
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(otx_vec3_sub(p[1], p[0]), otx_vec3_sub(p[2], p[0])));
    }
    return otx_vec3_length(sum);
}

static bool
is_disc(const trial *t, int32_t node)
{
    const otx_cluster c = otx_cluster_tree_node(t->tree, node);
    int32_t *member =
        OTX_ZNEW(t->bench->run->arena, int32_t, t->base->face_count);

    for (int32_t i = 0; i < c.face_count; ++i)
        member[c.faces[i]] = 1;
    return otx_cluster_is_disc(
        t->bench->run->scratch, t->base, c.faces, c.face_count, member, 1);
}

static void
regions_have_a_polygon(void **state)
{
    for (int i = 0; i < CAGE_COUNT; ++i)
    {
        const trial t = find_cage(*state, i);
        int32_t regions = 0;

        for (int32_t node = 1; node < t.tree->count; ++node)
        {
            const otx_cluster_node *n = &t.tree->nodes[node];
            otx_outline o;

            if (n->end - n->first == 1 || !is_disc(&t, node))
                continue;
            ++regions;
            o = trace(&t, node, n->level);
            check_outline(&t, node, &o);
            assert_true(o.control_count >= 3);
            assert_int_equal(o.controls[0], 0);
            for (int32_t k = 1; k < o.control_count; ++k)
                assert_true(o.controls[k] > o.controls[k - 1]);
            assert_true(area_of(&t, &o) > 0.0);
        }
        assert_true(regions > 8);
    }
}

/* Between two control vertices a region has one neighbour, which has the same
 * two for its own side. */
static void
sides_have_one_neighbour(void **state)
{
    for (int i = 0; i < CAGE_COUNT; ++i)
    {
        const trial t = find_cage(*state, i);

        for (int32_t node = 1; node < t.tree->count; ++node)
        {
            const otx_cluster_node *n = &t.tree->nodes[node];
            const int32_t level = n->level;
            otx_outline o;

            if (n->end - n->first == 1 || !is_disc(&t, node))
                continue;
            o = trace(&t, node, level);
            for (int32_t k = 0; k < o.control_count; ++k)
            {
                const int32_t end =
                    k + 1 < o.control_count ? o.controls[k + 1] : o.count;
                const int32_t beyond = otx_controls_cluster(
                    &t.controls, o.outside[o.controls[k]], level);

                for (int32_t j = o.controls[k]; j < end; ++j)
                    assert_int_equal(
                        otx_controls_cluster(&t.controls, o.outside[j], level),
                        beyond);
                assert_true(
                    t.controls.vert_level[o.verts[end % o.count]] <= level);
            }
        }
    }
}

/* A long strip has four corners, and regions of a line of squares as well. */
static void
a_strip_is_no_line(void **state)
{
    const trial t = find(
        tree_plant(sheet_create(*state, 12, 1, SHEET_FLAT), *state, 0, 3.0));

    for (int32_t node = 1; node < t.tree->count; ++node)
    {
        const otx_cluster_node *n = &t.tree->nodes[node];
        const otx_outline o = trace(&t, node, n->level);

        if (n->end - n->first > 1)
            assert_true(o.control_count >= 3 && area_of(&t, &o) > 0.5);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(faces_are_of_the_cluster_that_has_them),
        test_with_run(three_clusters_make_a_control_vertex),
        test_with_run(regions_have_a_polygon),
        test_with_run(sides_have_one_neighbour),
        test_with_run(a_strip_is_no_line),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_assign.c -- half-edges fit, tiles are spread, order is all that
 * counts. */
#include "method/tile/assign.h"

#include "../../grid.h"
#include "../surface/meshes.h"

#include "method/tile/orient.h"

static otx_tile_layout
layout_of(int32_t boundaries, int32_t corners, bool oriented)
{
    return (otx_tile_layout){
        .boundaries = boundaries,
        .corners = corners,
        .cell = 16,
        .gutter = 2,
        .oriented = oriented,
    };
}

static int32_t
edge_side(const otx_level *level, int32_t face, int32_t edge, int32_t turns)
{
    for (int32_t i = 0; i < 4; ++i)
        if (level->face_edges[4 * face + i] == edge)
            return (i - turns) & 3;
    return -1;
}

/* The two sides of every edge are 2k and 2k + 1, and all faces around a vertex
 * see the same corner. */
static void
check_names(const otx_assign_input *input, const int32_t *names, otx_run *run)
{
    const otx_level *level = input->level;
    int32_t *vert_corner = OTX_NEW(run->arena, int32_t, level->vert_count);

    memset(vert_corner, -1, (size_t)level->vert_count * sizeof(int32_t));
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t turns = input->turns ? input->turns[f] : 0;
        const otx_tile_name name =
            otx_tile_layout_name(input->layout, names[f]);

        assert_int_equal(
            otx_tile_layout_number(input->layout, &name), names[f]);
        for (int32_t i = 0; i < 4; ++i)
        {
            int32_t *corner =
                &vert_corner[level->face_verts[4 * f + ((i + turns) & 3)]];

            assert_true(*corner < 0 || *corner == name.corners[i]);
            *corner = name.corners[i];
        }
    }
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * e;
        int32_t types[2];

        if (faces[1] < 0)
            continue;
        for (int32_t i = 0; i < 2; ++i)
        {
            const int32_t turns = input->turns ? input->turns[faces[i]] : 0;

            types[i] = otx_tile_layout_name(input->layout, names[faces[i]])
                           .sides[edge_side(level, faces[i], e, turns)];
        }
        assert_int_equal(types[0], types[1] ^ 1);
    }
}

static int64_t
count_equal(const otx_level *level, const int32_t *names)
{
    int64_t equal = 0;

    for (int32_t e = 0; e < level->edge_count; ++e)
        equal += level->edge_faces[2 * e + 1] >= 0 &&
                 names[level->edge_faces[2 * e]] ==
                     names[level->edge_faces[2 * e + 1]];
    return equal;
}

static void
test_half_edges_fit(void **state)
{
    static const int32_t kinds[][3] = {
        {1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {1, 2, 0}, {2, 3, 0}, {2, 1, 1}};

    (void)state;
    for (int32_t k = 0; k < COUNT(kinds) * 2; ++k)
    {
        const otx_tile_layout layout =
            layout_of(kinds[k / 2][0], kinds[k / 2][1], kinds[k / 2][2] != 0);
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_cube(run);
        const otx_cage cage = mesh_build(run, &in, NULL);
        const otx_surface surface = mesh_refine(run, &cage, 4);
        const otx_level *level = otx_surface_leaf(&surface);
        uint8_t *turns = OTX_ZNEW(run->arena, uint8_t, level->face_count);
        int32_t *names = OTX_NEW(run->arena, int32_t, level->face_count);
        const otx_assign_input input = {
            .level = level, .layout = &layout, .turns = turns, .plain = k % 2};

        if (layout.oriented)
            assert_int_equal(
                otx_orient_loops(run, &surface, 4, turns), OSDTEX_OK);
        assert_int_equal(otx_assign_names(run, &input, names), OSDTEX_OK);
        check_names(&input, names, run);
        if (!input.plain)
            assert_int_equal(count_equal(level, names), 0);
        test_run_destroy(run);
    }
}

/* Around a vertex with a whole corner every tile shows another quarter of it,
 * in turn; the corners of a cube, and lines between them, have none. */
static void
test_whole_corners_lie_alike(void **state)
{
    const otx_tile_layout layout = layout_of(1, 3, false);
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 4);
    const otx_level *level = otx_surface_leaf(&surface);
    uint8_t *turns = OTX_ZNEW(run->arena, uint8_t, level->face_count);
    uint8_t *whole = OTX_ZNEW(run->arena, uint8_t, level->vert_count);
    uint8_t *quarters = OTX_ZNEW(run->arena, uint8_t, level->vert_count);
    int32_t *names = OTX_NEW(run->arena, int32_t, level->face_count);
    const otx_assign_input input = {
        .level = level, .layout = &layout, .turns = turns, .whole = whole};
    int32_t count = 0;

    (void)state;
    assert_int_equal(otx_orient_walk(run, level, turns), OSDTEX_OK);
    otx_orient_find_whole(level, turns, whole);
    assert_int_equal(otx_assign_names(run, &input, names), OSDTEX_OK);
    check_names(&input, names, run);
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const otx_tile_name name = otx_tile_layout_name(&layout, names[f]);

        for (int32_t i = 0; i < 4; ++i)
        {
            const int32_t vert =
                level->face_verts[4 * f + ((i + turns[f]) & 3)];

            assert_int_equal(name.corners[i] > 0, whole[vert]);
            quarters[vert] |= (uint8_t)(1 << i);
        }
    }
    for (int32_t v = 0; v < level->vert_count; ++v)
    {
        count += whole[v];
        if (whole[v])
            assert_int_equal(quarters[v], 15);
    }
    assert_in_range(count, level->vert_count * 3 / 4, level->vert_count - 8);
    test_run_destroy(run);
}

/* On a grid the rule leaves no equal neighbours and uses all tiles alike. */
static void
test_use_is_balanced(void **state)
{
    const otx_tile_layout layout = layout_of(1, 1, false);
    otx_run *run = test_run_create();
    const otx_surface *grid = test_grid_create(run->arena, 200, 200, 1.0);
    const otx_level *level = otx_surface_leaf(grid);
    const otx_assign_input input = {.level = level, .layout = &layout};
    int32_t *names = OTX_NEW(run->arena, int32_t, level->face_count);
    int32_t uses[16] = {0};

    (void)state;
    assert_int_equal(otx_assign_names(run, &input, names), OSDTEX_OK);
    check_names(&input, names, run);
    assert_int_equal(count_equal(level, names), 0);
    for (int32_t f = 0; f < level->face_count; ++f)
        ++uses[names[f]];
    for (int32_t i = 0; i < 16; ++i)
        assert_in_range(uses[i], 1250, 3750);
    test_run_destroy(run);
}

/* On a grid all rows agree: bottom on top, right on left. */
static void
test_loops_orient_a_grid(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *grid = test_grid_create(run->arena, 5, 4, 1.0);
    uint8_t turns[20];

    (void)state;
    assert_int_equal(otx_orient_loops(run, grid, 0, turns), OSDTEX_OK);
    for (int32_t f = 0; f < 20; ++f)
        assert_int_equal(turns[f], 0);
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 0);
    test_run_destroy(run);
}

/* A cube's eight vertices of valence 3 cannot be oriented, and are named. */
static void
test_singular_vertices_are_named(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 2);
    uint8_t turns[96];
    osdtex_diagnostic d;
    int64_t named = 0;

    (void)state;
    assert_int_equal(otx_orient_loops(run, &surface, 2, turns), OSDTEX_OK);
    for (int32_t i = 0; i < otx_diagnostics_count(run->diagnostics); ++i)
    {
        otx_diagnostics_get(run->diagnostics, i, &d);
        if (d.vertex >= 0)
            named += d.count;
    }
    assert_int_equal(named, 8);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_half_edges_fit),
        cmocka_unit_test(test_whole_corners_lie_alike),
        cmocka_unit_test(test_use_is_balanced),
        cmocka_unit_test(test_loops_orient_a_grid),
        cmocka_unit_test(test_singular_vertices_are_named),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_phase.c -- periodic coordinates where the answer is known. */
#include "field/attract.h"
#include "periodic/rings.h"
#include "periodic/unwrap.h"
#include "unit/field/test_field.h"

/* Coordinates of the whole surface along the field that `q` asks for. */
static otx_phase
solve_with(
    otx_run *run, const field_surface *s, const otx_direction_request *q,
    double cell, double cancel)
{
    const double *flat =
        OTX_ZNEW(run->arena, double, s->connection.level->vert_count);
    otx_direction *field = OTX_NEW(run->arena, otx_direction, 1);
    otx_phase_request request = {
        .field = field,
        .log_scale = flat,
        .gradient = {{1.0 / cell, 0}, {0, 1.0 / cell}},
        .cancel = cancel};
    double *distance;
    otx_phase phase;

    assert_int_equal(
        otx_direction_solve(run, &s->connection, q, field), OSDTEX_OK);
    assert_int_equal(otx_phase_solve(run, &request, &phase), OSDTEX_OK);
    assert_int_equal(
        otx_phase_distance(run, &s->connection, phase.defect, &distance),
        OSDTEX_OK);
    assert_int_equal(otx_phase_unwrap(run, &phase, distance), OSDTEX_OK);
    return phase;
}

static otx_phase
solve(
    otx_run *run, const field_surface *s, const otx_direction_request *q,
    double cell)
{
    return solve_with(run, s, q, cell, 1.5 * cell);
}

/* Both criteria by rings, on what `solve` made of a flat field. */
static otx_rings
find_rings(
    otx_run *run, const field_surface *s, const otx_phase *phase,
    const otx_direction *field, double cell)
{
    const otx_phase_request request = {
        .field = field,
        .log_scale =
            OTX_ZNEW(run->arena, double, s->connection.level->vert_count),
        .gradient = {{1.0 / cell, 0}, {0, 1.0 / cell}}};
    otx_rings rings;

    assert_int_equal(otx_rings_find(run, phase, &request, &rings), OSDTEX_OK);
    return rings;
}

/* Sound coordinates have no singular ring; a face that is squeezed makes its
 * corners' rings so by both criteria, and one that is only shifted by whole
 * cells by none. */
static void
singular_rings_are_found(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 6);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_level *level = s->connection.level;
    const otx_direction_request q = {.symmetry = 2, .pull_length = 1.0};
    const double cell = 1.3;
    const int32_t face = level->face_count / 2;
    otx_phase phase = solve(run, s, &q, cell);
    otx_direction field;
    otx_rings rings;

    (void)state;
    assert_int_equal(
        otx_direction_solve(run, &s->connection, &q, &field), OSDTEX_OK);
    assert_int_equal(find_rings(run, s, &phase, &field, cell).count, 0);
    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        phase.cells[i].x += 3.0;
    assert_int_equal(find_rings(run, s, &phase, &field, cell).count, 0);
    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        phase.cells[i].x *= 0.2;
    rings = find_rings(run, s, &phase, &field, cell);
    assert_int_equal(rings.count, 4);
    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        assert_int_equal(
            rings.singular[level->face_verts[i]],
            OTX_RING_DISTORTED | OTX_RING_MISMATCHED);
    test_run_destroy(run);
}

/* On a plane the coordinates are the plane's, up to a shift. */
static void
a_plane_gets_its_own_coordinates(void **state)
{
    (void)state;
    for (int32_t symmetry = 1; symmetry <= 2; ++symmetry)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_grid(run, 6);
        const field_surface *s = field_from_input(run, &in, 2);
        const otx_level *level = s->connection.level;
        otx_direction_request q = {.symmetry = symmetry, .pull_length = 1.0};
        otx_vec2 *pull;
        const double cell = 1.3;
        otx_phase phase;
        const otx_vec3 first =
            otx_vec3_load(s->surface.points, level->face_verts[0]);
        double sense;

        assert_int_equal(
            otx_attract_axis(
                run, &s->connection, symmetry, (otx_vec3){0, 1, 0}, &pull),
            OSDTEX_OK);
        q.pull = pull;
        phase = solve(run, s, &q, cell);
        assert_int_equal(phase.defect_count, 0);
        sense = phase.cells[1].x - phase.cells[0].x +
                            (phase.cells[2].x - phase.cells[1].x) >
                        0.0
                    ? 1.0
                    : -1.0;
        for (int32_t i = 0; i < level->corner_count; ++i)
        {
            const otx_vec3 p =
                otx_vec3_load(s->surface.points, level->face_verts[i]);
            const double a = sense * (phase.cells[i].x - phase.cells[0].x);
            const double b = sense * (phase.cells[i].y - phase.cells[0].y);

            /* a runs along y, b to the left of it. */
            assert_true(fabs(a - (p.y - first.y) / cell) < 0.02);
            assert_true(fabs(b + (p.x - first.x) / cell) < 0.02);
        }
        test_run_destroy(run);
    }
}

/* Every edge between sound faces agrees up to whole cells and sense. */
static void
neighbours_agree_up_to_whole_cells(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *level = s->connection.level;
    const otx_direction_request q = {.symmetry = 2};
    const otx_phase phase = solve(run, s, &q, 0.4);

    (void)state;
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *f = level->edge_faces + 2 * e;
        otx_vec2 at[2][2];
        double same[2];

        if (phase.defect[f[0]] || phase.defect[f[1]])
            continue;
        for (int k = 0; k < 2; ++k)
            for (int side = 0; side < 2; ++side)
            {
                int32_t i = level->face_first[f[side]];

                while (level->face_verts[i] != level->edge_verts[2 * e + k])
                    ++i;
                at[side][k] = phase.cells[i];
            }
        for (int way = 0; way < 2; ++way)
        {
            const double sense = way == 0 ? 1.0 : -1.0;
            const otx_vec2 a =
                otx_vec2_sub(at[0][0], otx_vec2_scale(sense, at[1][0]));
            const otx_vec2 b =
                otx_vec2_sub(at[0][1], otx_vec2_scale(sense, at[1][1]));

            same[way] = fabs(a.x - b.x) + fabs(a.y - b.y) +
                        fabs(a.x - round(a.x)) + fabs(a.y - round(a.y));
        }
        assert_true(fmin(same[0], same[1]) < 1e-6);
    }
    test_run_destroy(run);
}

static void
a_torus_has_few_defects(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = field_torus(run, 32, 16);
    const field_surface *s = field_from_input(run, &in, 1);
    otx_phase phase;

    (void)state;
    phase = solve(
        run, s, &(otx_direction_request){.symmetry = 2}, 2.0 * OTX_PI / 8);
    assert_true(phase.defect_count < s->connection.level->face_count / 20);
    test_run_destroy(run);
}

/* Fewer dislocations, and what is left of them still sums to whole cells. */
static void
close_dislocations_vanish(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = field_torus(run, 16, 24);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_direction_request q = {.symmetry = 1, .pull_length = 0.1};
    otx_phase apart, met;
    otx_vec2 *pull;

    (void)state;
    assert_int_equal(
        otx_attract_axis(
            run, &s->connection, 1, (otx_vec3){0.3, 1, 0.2}, &pull),
        OSDTEX_OK);
    q.pull = pull;
    apart = solve_with(run, s, &q, 0.25, 0.0);
    met = solve_with(run, s, &q, 0.25, 0.5);
    assert_true(apart.defect_count > 0);
    assert_int_equal(apart.cancelled, 0);
    assert_true(met.cancelled > 0);
    assert_true(met.defect_count < apart.defect_count);
    test_run_destroy(run);
}

static void
the_same_for_any_number_of_threads(void **state)
{
    otx_run *runs[2];
    otx_phase phases[2];
    int32_t corners = 0;

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 3);

        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);
        const otx_direction_request q = {.symmetry = 2};

        phases[i] = solve(runs[i], s, &q, 0.5);
        corners = s->connection.level->corner_count;
    }
    assert_memory_equal(
        phases[0].cells, phases[1].cells,
        (size_t)corners * sizeof *phases[0].cells);
    test_run_destroy(runs[0]);
    test_run_destroy(runs[1]);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singular_rings_are_found),
        cmocka_unit_test(a_plane_gets_its_own_coordinates),
        cmocka_unit_test(neighbours_agree_up_to_whole_cells),
        cmocka_unit_test(a_torus_has_few_defects),
        cmocka_unit_test(close_dislocations_vanish),
        cmocka_unit_test(the_same_for_any_number_of_threads),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

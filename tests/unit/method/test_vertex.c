/* test_vertex.c -- fields that are combed, and charts whose borders are nowhere
 * in what is made. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "base/random.h"
#include "field/connection.h"
#include "mapping/show.h"
#include "method/vertex/vertex.h"

enum
{
    SIDE = 64,
    PERIOD = 16
};

/* Directions along the y axis' part in the faces, each of them turned over by
 * chance: combed, neighbours agree. */
static void
neighbours_mean_the_same_direction(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface =
        sheet_from_file(run, "models/cages/torus.obj", 2);
    const otx_level *leaf = otx_surface_leaf(&surface);
    otx_vec3 *directions = OTX_NEW(run->arena, otx_vec3, leaf->face_count);
    otx_connection connection;
    otx_guide guide = {directions, 2, 0.3}, combed;

    (void)state;
    assert_int_equal(
        otx_connection_build(run, &surface, 2, &connection), OSDTEX_OK);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const otx_vec3 c = connection.centres[f];
        const otx_vec3 ring = otx_vec3_unit((otx_vec3){-c.z, 0.0, c.x});

        directions[f] = otx_vec3_scale(
            otx_random_unit(5, 1, (uint64_t)f) < 0.5 ? -1.0 : 1.0, ring);
    }
    assert_int_equal(
        otx_vertex_comb(run, &surface, &guide, &combed), OSDTEX_OK);
    assert_true(combed.angle == guide.angle && combed.symmetry == 2);
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        assert_true(
            otx_vec3_dot(
                combed.directions[leaf->edge_faces[2 * e]],
                combed.directions[leaf->edge_faces[2 * e + 1]]) > 0.0);
    test_run_destroy(run);
}

static otx_exemplar *
paint(otx_arena *arena)
{
    otx_exemplar *e = test_exemplar_create(arena, SIDE, SIDE, true, 1);

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
        {
            const double u = 2.0 * OTX_PI / PERIOD * (i % SIDE + 0.5);
            const double v = 2.0 * OTX_PI / PERIOD * (i / SIDE + 0.5);

            e->lab.pixels[3 * i + c] =
                (float)(40.0 + 20.0 * sin(u + c) + 15.0 * cos(v - 0.5 * c) + 10.0 * sin(2.0 * u + v));
        }
    return e;
}

/* L at the middle of edge k of a face. */
static double
look(const otx_mapping *mapping, const otx_exemplar *e, int32_t face, int32_t k)
{
    const otx_show_view show = otx_show_of(mapping);
    const int32_t first = otx_surface_leaf(mapping->surface)->face_first[face];
    const int32_t corners[3] = {
        first + k, first + (k + 1) % 4, first + (k + 2) % 4};
    const double at[3] = {0.5, 0.5, 0.0};
    float lab[3];

    otx_show_lab(
        &show, e, &(otx_show_place){face, corners, at, NULL, NULL}, 0, lab);
    return (double)lab[0];
}

/* What two faces show at their edge. */
static double
step_at(const otx_mapping *mapping, const otx_exemplar *e, int32_t edge)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    double seen[2];

    for (int i = 0; i < 2; ++i)
    {
        const int32_t face = leaf->edge_faces[2 * (size_t)edge + (size_t)i];
        int32_t k = 0;

        while (leaf->face_edges[leaf->face_first[face] + k] != edge)
            ++k;
        seen[i] = look(mapping, e, face, k);
    }
    return fabs(seen[0] - seen[1]);
}

static void
borders_of_charts_are_nowhere(void **state)
{
    otx_run *run = test_run_create_with(NULL, 2);
    const otx_surface surface =
        sheet_from_file(run, "models/cages/torus.obj", 3);
    const otx_level *leaf = otx_surface_leaf(&surface);
    const otx_exemplar *e = paint(run->arena);
    const otx_map_request request = {.scale = SIDE / 40.0, .first_face = -1};
    const otx_method *method = otx_method_find("vertex");
    otx_vertex_settings settings = {
        .tolerance = 10.0, .levels = 2, .starts = 1};
    const otx_job job = {
        .run = run,
        .surface = &surface,
        .exemplars = e,
        .exemplar_count = 1,
        .request = &request,
        .settings = &settings};
    otx_mapping mapping;

    double sum = 0.0;
    int32_t count = 0;

    (void)state;
    assert_int_equal(otx_method_map(method, &job, &mapping), OSDTEX_OK);
    assert_non_null(mapping.field);
    assert_true(otx_source_field_is_whole(
        mapping.field, leaf->face_hole, leaf->face_count));
    assert_true(mapping.field->chart_count > 2);
    for (int32_t edge = 0; edge < leaf->edge_count; ++edge)
    {
        const int32_t *faces = leaf->edge_faces + 2 * (size_t)edge;

        if (mapping.field->face_chart[faces[0]] ==
            mapping.field->face_chart[faces[1]])
            continue;
        sum += step_at(&mapping, e, edge);
        ++count;
    }
    assert_true(count > 50);
    /* Texels beside each other differ by 7, and places by chance by 24. */
    assert_true(sum / count < 5.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_mean_the_same_direction),
        cmocka_unit_test(borders_of_charts_are_nowhere),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

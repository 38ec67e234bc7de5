/* test_points.c -- nested meshes, ways over them, and sweeps along a field. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "method/vertex/stroll.h"

enum
{
    SIDE = 48
};

typedef struct scene
{
    otx_run *run;
    otx_surface surface;
    otx_map_request request;
    otx_job job;
    otx_vertex vertex;
    otx_turk turk;
} scene;

/* A plane whose field is the x axis. */
static void
set_up(scene *s, const char *cage)
{
    otx_vec3 *directions;
    int32_t faces;

    s->run = test_run_create();
    s->surface = sheet_from_file(s->run, cage, 2);
    s->request = (otx_map_request){.scale = 1.0, .first_face = -1};
    s->job = (otx_job){
        .run = s->run,
        .surface = &s->surface,
        .exemplars = test_exemplar_create(s->run->arena, SIDE, SIDE, true, 1),
        .exemplar_count = 1,
        .request = &s->request};
    faces = otx_surface_leaf(&s->surface)->face_count;
    directions = OTX_NEW(s->run->arena, otx_vec3, faces);
    for (int32_t f = 0; f < faces; ++f)
        directions[f] = (otx_vec3){1.0, 0.0, 0.0};
    s->vertex = (otx_vertex){
        .job = &s->job,
        .run = s->run,
        .settings = {.levels = 3},
        .mapping = {.surface = &s->surface},
        .guide = {directions, 1, 0.0},
        .set = {.texels = 12.0}};
    assert_int_equal(otx_turk_build(&s->vertex, &s->turk), OSDTEX_OK);
}

static otx_vec3
point(const scene *s, int32_t v)
{
    return otx_vec3_load(s->turk.surface->points, v);
}

/* The vertex nearest to the middle of the plane. */
static int32_t
middle(const scene *s)
{
    otx_vec3 sum = {0, 0, 0};
    int32_t best = 0;

    for (int32_t v = 0; v < s->turk.meshes[0].count; ++v)
        sum = otx_vec3_add(
            sum, otx_vec3_scale(1.0 / s->turk.meshes[0].count, point(s, v)));
    for (int32_t v = 0; v < s->turk.meshes[0].count; ++v)
        if (otx_vec3_length(otx_vec3_sub(point(s, v), sum)) <
            otx_vec3_length(otx_vec3_sub(point(s, best), sum)))
            best = v;
    return best;
}

static void
meshes_are_nested(void **state)
{
    scene s;

    (void)state;
    set_up(&s, "models/cages/torus.obj");
    assert_int_equal(s.turk.mesh_count, 3);
    for (int32_t k = 1; k < s.turk.mesh_count; ++k)
        assert_int_equal(
            s.turk.meshes[k - 1].count, 4 * s.turk.meshes[k].count);
    assert_true(s.turk.surface->mean_edge_length * 12.0 < 1.5);
    test_run_destroy(s.run);
}

static void
what_is_even_stays_even(void **state)
{
    static const otx_quad grey = {3.0f, 5.0f, 7.0f, 0.0f};
    scene s;

    (void)state;
    set_up(&s, "models/cages/torus.obj");
    for (int32_t v = 0; v < s.turk.meshes[1].count; ++v)
        s.turk.above[v] = grey;
    otx_turk_interpolate(
        &s.turk.meshes[1], s.turk.meshes[0].count, s.turk.above);
    otx_turk_smooth(
        &s.turk.meshes[0], 0.1, s.turk.above, s.turk.meshes[0].colors);
    for (int32_t v = 0; v < s.turk.meshes[0].count; ++v)
        for (int c = 0; c < 3; ++c)
            assert_float_equal(s.turk.meshes[0].colors[v][c], grey[c], 1e-4);
    test_run_destroy(s.run);
}

/* To the right, then down: on a plane as in the picture, and values that are
 * linear are found. */
static void
ways_are_straight(void **state)
{
    scene s;
    otx_stroll way;
    otx_vec3 from, to;
    otx_quad found;
    int32_t v;

    (void)state;
    set_up(&s, "models/cages/plane.obj");
    v = middle(&s);
    from = point(&s, v);
    for (int32_t i = 0; i < s.turk.meshes[0].count; ++i)
        s.turk.above[i] = (otx_quad){
            (float)point(&s, i).x, (float)point(&s, i).y, (float)point(&s, i).z,
            0.0f};
    assert_true(otx_stroll_begin(
        &s.turk.meshes[0], s.turk.surface->points, v,
        (otx_vec3){cos(0.4), sin(0.4), 0.0}, &way));
    otx_stroll_go(&way, 0.3);
    otx_stroll_turn(&way, 0.0, -1.0);
    otx_stroll_go(&way, 0.2);
    to = (otx_vec3){
        from.x + 0.3 * cos(0.4) + 0.2 * sin(0.4),
        from.y + 0.3 * sin(0.4) - 0.2 * cos(0.4), from.z};
    assert_true(otx_vec3_length(otx_vec3_sub(way.at, to)) < 1e-6);
    found = otx_stroll_look(&way, s.turk.above);
    assert_float_equal(found[0], to.x, 1e-5);
    assert_float_equal(found[1], to.y, 1e-5);
    otx_stroll_go(&way, 1e3);
    assert_true(way.ended);
    test_run_destroy(s.run);
}

/* A way round a tube comes back: it stays on the surface, and is as long as it
 * was told to be. */
static void
ways_bend_with_the_surface(void **state)
{
    scene s;
    otx_stroll way;
    otx_vec3 last;
    double length = 0.0;

    (void)state;
    set_up(&s, "models/cages/torus.obj");
    assert_true(otx_stroll_begin(
        &s.turk.meshes[0], s.turk.surface->points, 0, s.turk.down[0], &way));
    last = way.at;
    for (int32_t i = 0; i < 400; ++i)
    {
        otx_stroll_go(&way, 0.01);
        length += otx_vec3_length(otx_vec3_sub(way.at, last));
        last = way.at;
    }
    assert_true(length > 3.96 && length < 4.0 + 1e-6);
    test_run_destroy(s.run);
}

/* With the picture's right along x its v falls along -y, and so the sweep. */
static void
sweeps_measure_along_the_field(void **state)
{
    scene s;
    double first;

    (void)state;
    set_up(&s, "models/cages/plane.obj");
    assert_int_equal(otx_turk_sweep(&s.turk), OSDTEX_OK);
    first = s.turk.sweep[0] + point(&s, 0).y;
    for (int32_t v = 0; v < s.turk.meshes[0].count; ++v)
        assert_true(fabs(s.turk.sweep[v] + point(&s, v).y - first) < 1e-4);
    for (int32_t i = 1; i < s.turk.meshes[0].count; ++i)
        assert_true(
            s.turk.sweep[s.turk.order[i - 1]] <= s.turk.sweep[s.turk.order[i]]);
    test_run_destroy(s.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_nested),
        cmocka_unit_test(what_is_even_stays_even),
        cmocka_unit_test(ways_are_straight),
        cmocka_unit_test(ways_bend_with_the_surface),
        cmocka_unit_test(sweeps_measure_along_the_field),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

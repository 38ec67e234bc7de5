/* test_hierarchical.c -- whole runs: coverage, no flips, no seams where none
 * need be, the user's wishes, and failures that leave nothing behind. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "mapping/measure.h"
#include "mapping/seam.h"
#include "method/hierarchical/settings.h"
#include "method/method.h"
#include "patch/mosaic.h"

#include <stdlib.h>

typedef struct job
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    otx_map_request request;
    otx_hierarchical_settings settings;
    otx_mapping mapping;
    otx_figures figures;
} job;

/* Blobs of several sizes, so that there is something to match. */
static otx_exemplar *
make_exemplar(otx_run *run, int32_t side, bool wrap)
{
    otx_exemplar *e = test_exemplar_create(run->arena, side, side, wrap, 4);
    float *p = e->match.pixels;
    const double turn = 2.0 * OTX_PI / side;

    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x, p += 3)
        {
            const double a = sin(turn * (5 * x + 2 * y) + 3 * sin(turn * y));
            const double b = sin(turn * (7 * y - 3 * x) + 2 * sin(turn * x));

            p[0] = (float)(0.7 * (50.0 + 50.0 * a * b) + 0.3 * p[0]);
            p[1] = (float)(0.7 * (50.0 + 50.0 * a) + 0.3 * p[1]);
            p[2] = (float)(0.7 * (50.0 + 50.0 * b) + 0.3 * p[2]);
        }
    return e;
}

static job *
make_job_with(
    const otx_allocator_hooks *hooks, int32_t threads, const char *cage,
    int32_t level, double images, bool wrap)
{
    otx_run *run = test_run_create_with(hooks, threads);
    job *j = OTX_ZNEW(run->arena, job, 1);
    char path[128];

    j->run = run;
    snprintf(
        path, sizeof path, "%s%s.obj", cage[0] == '.' ? "" : "models/cages/",
        cage);
    j->surface = OTX_NEW(run->arena, otx_surface, 1);
    *j->surface = sheet_from_file(run, path, level);
    j->exemplar = make_exemplar(run, 64, wrap);
    j->request.scale = sqrt(j->surface->area / images);
    j->request.first_face = -1;
    otx_option_defaults(
        otx_hierarchical_options, OTX_HIERARCHICAL_OPTION_COUNT, &j->settings);
    j->settings.angles = 7;
    return j;
}

static job *
make_job(const char *cage, int32_t level, double images, bool wrap)
{
    return make_job_with(NULL, 2, cage, level, images, wrap);
}

static otx_status
map(job *j)
{
    return otx_method_map(
        otx_method_find("hierarchical"),
        &(otx_job){
            j->run, j->surface, j->exemplar, 1, &j->request, &j->settings,
            &j->figures},
        &j->mapping);
}

static otx_measure
measure(job *j)
{
    otx_measure m;

    assert_int_equal(
        otx_measure_run(j->run, &j->mapping, j->exemplar, NULL, &m), OSDTEX_OK);
    return m;
}

static void
set(job *j, const char *key, const char *value)
{
    assert_int_equal(
        otx_option_set(
            j->run, otx_hierarchical_options, OTX_HIERARCHICAL_OPTION_COUNT,
            &j->settings, key, value),
        OSDTEX_OK);
}

static void
check_mapping(job *j)
{
    const otx_measure m = measure(j);
    const otx_level *leaf = otx_surface_leaf(j->surface);

    assert_int_equal(m.uncovered, 0);
    assert_int_equal(m.flips, 0);
    assert_int_equal(m.outside, 0);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        assert_int_equal(j->mapping.face_patch[f] < 0, leaf->face_hole[f] != 0);
}

static const char *const cages[] = {
    "chaikin",       "corner",    "creased",
    "creature",      "dialect",   "double_torus",
    "high_valence",  "hole",      "jack",
    "loop_closed",   "loop_open", "materials_and_groups",
    "open_boundary", "plane",     "ngons_and_triangles",
    "semi_sharp",    "sphere",    "several_components",
    "torus",         "uv_seams"};

static void
cover_cages(const char *mode, bool wrap, int32_t step)
{
    for (int32_t i = 0; i < COUNT(cages); i += step)
    {
        job *j = make_job(cages[i], 1, 8.0, wrap);

        set(j, "mode", mode);
        if (map(j) != OSDTEX_OK)
            fail_msg("%s: %s", cages[i], test_last_message(j->run));
        check_mapping(j);
        test_run_destroy(j->run);
    }
}

static void
every_cage_is_covered_without_flips(void **state)
{
    (void)state;
    cover_cages("best", true, 1);
    cover_cages("paper", true, 1);
}

static void
nothing_leaves_an_exemplar_that_does_not_tile(void **state)
{
    (void)state;
    cover_cages("best", false, 3);
    cover_cages("paper", false, 3);
}

/* On a plane the continuation of a neighbour is exact. */
static void
a_plane_that_may_continue_has_no_seam(void **state)
{
    static const char *const modes[] = {"best", "paper"};

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        job *j = make_job("plane", 3, 16.0, true);
        otx_measure m;

        set(j, "mode", modes[k]);
        set(j, "continuation", "allow");
        assert_int_equal(map(j), OSDTEX_OK);
        m = measure(j);
        assert_true(otx_figures_value(&j->figures, "fits") > 4);
        assert_true(m.seam_length == 0.0);
        assert_true(m.stretch_ratio_p95 < 1.001);
        test_run_destroy(j->run);
    }
}

/* Plain meshes beside small pictures: what lies around a face is more than a
 * search takes. */
static void
faces_of_many_pictures_go_on(void **state)
{
    static const char *const modes[] = {"best", "paper"};

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        job *flat = make_job("plane", 0, 16.0 * 36.0, true);
        job *round = make_job("jack", 0, 30.0 * 36.0, true);

        set(flat, "mode", modes[k]);
        set(round, "mode", modes[k]);
        if (map(flat) != OSDTEX_OK || map(round) != OSDTEX_OK)
            fail_msg(
                "%s%s", test_last_message(flat->run),
                test_last_message(round->run));
        assert_true(measure(flat).seam_length < 1e-9);
        check_mapping(round);
        test_run_destroy(flat->run);
        test_run_destroy(round->run);
    }
}

static void
the_same_bytes_from_any_number_of_threads(void **state)
{
    static const char *const modes[] = {"best", "paper"};
    static const int32_t threads[] = {1, 2, 8, 2};

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        job *first = make_job_with(NULL, 1, "creature", 1, 10.0, true);
        const int64_t bytes =
            8 * (int64_t)otx_surface_leaf(first->surface)->corner_count;

        set(first, "mode", modes[k]);
        assert_int_equal(map(first), OSDTEX_OK);
        for (int t = 0; t < 4; ++t)
        {
            job *j = make_job_with(NULL, threads[t], "creature", 1, 10.0, true);

            set(j, "mode", modes[k]);
            assert_int_equal(map(j), OSDTEX_OK);
            assert_memory_equal(
                j->mapping.uvs, first->mapping.uvs, (size_t)bytes);
            test_run_destroy(j->run);
        }
        test_run_destroy(first->run);
    }
}

static void
seeds_differ(void **state)
{
    job *a = make_job("sphere", 1, 6.0, true);
    job *b = make_job("sphere", 1, 6.0, true);

    (void)state;
    b->run->seed = 2;
    assert_int_equal(map(a), OSDTEX_OK);
    assert_int_equal(map(b), OSDTEX_OK);
    assert_memory_not_equal(a->mapping.uvs, b->mapping.uvs, 800);
    test_run_destroy(a->run);
    test_run_destroy(b->run);
}

/* UV of a cage vertex in the first patch. */
static otx_vec2
first_uv(const job *j, int32_t vert)
{
    const otx_level *leaf = otx_surface_leaf(j->surface);

    for (int32_t c = 0; c < leaf->corner_count; ++c)
        if (leaf->face_verts[c] == vert && j->mapping.face_patch[c / 4] == 0)
            return (otx_vec2){j->mapping.uvs[2 * c], j->mapping.uvs[2 * c + 1]};
    fail_msg("the first patch has no vertex %d", vert);
    return (otx_vec2){0, 0};
}

static void
the_first_patch_is_where_the_user_wants_it(void **state)
{
    (void)state;
    for (int k = 0; k < 4; ++k)
    {
        job *j = make_job("plane", 3, 9.0, k % 2 == 0);
        const otx_level *leaf = otx_surface_leaf(j->surface);
        const int32_t *ends = j->surface->levels[0].face_verts + 4 * 5;
        otx_vec2 sum = {0, 0}, edge;
        int32_t corners = 0, own = 0;

        j->request.first_face = 5;
        j->request.first_position = (otx_vec2){0.45, 0.55};
        j->request.first_angle = 0.1;
        set(j, "cut", "off");
        set(j, "relax", "off");
        set(j, "guide", "off");
        set(j, "mode", k < 2 ? "paper" : "best");
        set(j, "clusters", "subdivision");
        assert_int_equal(map(j), OSDTEX_OK);
        for (int32_t c = 0; c < leaf->corner_count; ++c)
        {
            const float *uv = j->mapping.uvs + 2 * c;

            if (j->mapping.face_patch[c / 4] != 0)
                continue;
            own += leaf->face_cage[c / 4] == 5;
            sum = otx_vec2_add(sum, (otx_vec2){uv[0], uv[1]});
            ++corners;
        }
        assert_int_equal(own, 4 * 64);
        sum = otx_vec2_scale(1.0 / corners, sum);
        assert_true(fabs(sum.x - floor(sum.x) - 0.45) < 1e-3);
        assert_true(fabs(sum.y - floor(sum.y) - 0.55) < 1e-3);
        edge = otx_vec2_sub(first_uv(j, ends[1]), first_uv(j, ends[0]));
        assert_true(fabs(atan2(edge.y, edge.x) - 0.1) < 1e-3);
        test_run_destroy(j->run);
    }
}

/* With all that the method does by default: patches are larger than the face,
 * the field has ways of its own, and the cut would take what it likes. */
static void
a_face_is_where_the_user_wants_it_at_the_end(void **state)
{
    static const otx_analysis along = {
        .kind = OTX_ANALYSIS_DIRECTIONAL, .symmetry = 2, .angle = 0.3};
    enum
    {
        FACE = 20
    };

    (void)state;
    for (int k = 0; k < 4; ++k)
    {
        job *j = make_job("creature", 2, 9.0, true);
        const otx_level *leaf = otx_surface_leaf(j->surface);
        const int32_t *ends =
            j->surface->levels[0].face_verts + (size_t)4 * FACE;
        const double angle = -1.0 + 0.8 * k;
        otx_vec2 sum = {0, 0}, edge;
        int32_t corners = 0, own = 0;

        j->request.first_face = FACE;
        j->request.first_position = (otx_vec2){0.3, 0.6};
        j->request.first_angle = angle;
        j->request.analysis = k < 2 ? &along : NULL;
        assert_int_equal(map(j), OSDTEX_OK);
        for (int32_t c = 0; c < leaf->corner_count; ++c)
        {
            if (leaf->face_cage[c / 4] != FACE)
                continue;
            own += j->mapping.face_patch[c / 4] == 0;
            sum = otx_vec2_add(
                sum,
                (otx_vec2){j->mapping.uvs[2 * c], j->mapping.uvs[2 * c + 1]});
            ++corners;
        }
        assert_int_equal(own, corners);
        sum = otx_vec2_scale(1.0 / corners, sum);
        assert_true(fabs(remainder(sum.x - 0.3, 1.0)) < 0.02);
        assert_true(fabs(remainder(sum.y - 0.6, 1.0)) < 0.02);
        edge = otx_vec2_sub(first_uv(j, ends[1]), first_uv(j, ends[0]));
        assert_true(
            fabs(remainder(atan2(edge.y, edge.x) - angle, 2.0 * OTX_PI)) < 0.1);
        test_run_destroy(j->run);
    }
}

/* Angle from the first edge of a leaf face on the plane z = 0 to the same edge
 * in the exemplar. */
static double
turn_of(const job *j, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(j->surface);
    const int32_t first = leaf->face_first[face];
    const otx_vec2 way = otx_vec2_sub(
        otx_seam_texel(&j->mapping, j->exemplar, first + 1),
        otx_seam_texel(&j->mapping, j->exemplar, first));
    const otx_vec3 edge = otx_vec3_sub(
        otx_vec3_load(j->surface->points, leaf->face_verts[first + 1]),
        otx_vec3_load(j->surface->points, leaf->face_verts[first]));

    return atan2(way.y, way.x) - atan2(edge.y, edge.x);
}

static double
turn_between(const job *j, int32_t a, int32_t b)
{
    return fabs(remainder(turn_of(j, a) - turn_of(j, b), 2.0 * OTX_PI));
}

static job *
plane_with(const char *key, const char *value)
{
    job *j = make_job("plane", 3, 9.0, true);

    set(j, key, value);
    set(j, "relax", "off");
    set(j, "guide", "off");
    j->request.first_face = 5;
    j->request.first_angle = 1.0;
    assert_int_equal(map(j), OSDTEX_OK);
    return j;
}

/* Mean turn against one face. */
static double
spread_with(const char *drift)
{
    job *j = plane_with("drift", drift);
    const int32_t count = otx_surface_leaf(j->surface)->face_count;
    double sum = 0.0;

    for (int32_t f = 1; f < count; ++f)
        sum += turn_between(j, f, 0);
    test_run_destroy(j->run);
    return sum / count;
}

static void
the_first_direction_spreads(void **state)
{
    (void)state;
    assert_true(spread_with("15") < 0.5 * spread_with("180"));
}

/* Share of the edges between patches where both have one direction. */
static double
continued_share(const char *continuation)
{
    job *j = plane_with("continuation", continuation);
    const otx_level *leaf = otx_surface_leaf(j->surface);
    int32_t borders = 0, continued = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);

            if (other < 0 ||
                j->mapping.face_patch[f] == j->mapping.face_patch[other])
                continue;
            ++borders;
            continued += turn_between(j, f, other) < 0.02;
        }
    test_run_destroy(j->run);
    assert_true(borders > 0);
    return (double)continued / borders;
}

static void
a_tiling_exemplar_does_not_continue_itself(void **state)
{
    (void)state;
    assert_true(continued_share("allow") > 0.9);
    assert_true(continued_share("avoid") < 0.2);
}

static void
no_place_near_the_border_is_left(void **state)
{
    job *j = make_job("plane", 3, 9.0, false);

    (void)state;
    j->request.first_face = 5;
    j->request.first_position = (otx_vec2){0.99, 0.0};
    j->request.first_angle = 1.0;
    assert_int_equal(map(j), OSDTEX_OK);
    check_mapping(j);
    test_run_destroy(j->run);
}

/* What is switched off leaves no trace in the figures, and the parts do what
 * they are for. */
static void
every_part_can_be_switched(void **state)
{
    static const char *const off[][2] = {
        {"cut", "off"},
        {"relax", "off"},
        {"relax", "loop"},
        {"flatten", "recursive"},
        {"clusters", "subdivision"},
        {"angles", "1"},
        {"candidates", "3"},
        {"tau", "0.3"},
        {"coarse", "0"},
        {"usage", "1"}};

    (void)state;
    for (int32_t i = 0; i < COUNT(off); ++i)
    {
        job *j = make_job("creature", 1, 10.0, true);

        set(j, off[i][0], off[i][1]);
        assert_int_equal(map(j), OSDTEX_OK);
        check_mapping(j);
        test_run_destroy(j->run);
    }
}

static double
seams_of(const char *key, const char *value)
{
    job *j = make_job("sphere", 3, 10.0, true);
    double seams;

    set(j, "mode", "paper");
    set(j, "tau", "100");
    set(j, key, value);
    assert_int_equal(map(j), OSDTEX_OK);
    seams = measure(j).seam_energy;
    test_run_destroy(j->run);
    return seams;
}

static void
relaxing_and_choosing_lower_the_seams(void **state)
{
    (void)state;
    assert_true(seams_of("relax", "loop") < 0.9 * seams_of("relax", "off"));
    assert_true(seams_of("angles", "19") < seams_of("angles", "1"));
}

typedef struct countdown
{
    int32_t left;
} countdown;

static bool
stop_later(void *user, const char *stage, double fraction)
{
    countdown *c = user;

    (void)stage;
    assert_true(fraction >= 0.0 && fraction <= 1.0);
    return c->left-- > 0;
}

static void
cancelling_at_any_call_leaves_nothing(void **state)
{
    static const char *const modes[] = {"best", "paper"};

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        otx_status status = OSDTEX_ERROR_CANCELLED;

        for (int32_t stop = 0; status != OSDTEX_OK && stop < 4000;
             stop += 1 + stop / 4)
        {
            job *j = make_job("sphere", 1, 6.0, true);
            countdown c = {stop};

            set(j, "mode", modes[k]);
            j->run->progress = stop_later;
            j->run->progress_user = &c;
            status = map(j);
            assert_true(
                status == OSDTEX_OK || status == OSDTEX_ERROR_CANCELLED);
            test_run_destroy(j->run);
        }
        assert_int_equal(status, OSDTEX_OK);
    }
}

static void
failing_any_allocation_leaves_nothing(void **state)
{
    static const char *const modes[] = {"best", "paper"};

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        otx_status status = OSDTEX_ERROR_MEMORY;

        for (int64_t stop = 0; status != OSDTEX_OK && stop < 100000;
             stop += 1 + stop / 8)
        {
            test_ration f = {INT64_MAX};
            const otx_allocator_hooks hooks = test_ration_hooks(&f);
            job *j = make_job_with(&hooks, 1, "sphere", 1, 6.0, true);

            set(j, "mode", modes[k]);
            f.left = stop;
            status = map(j);
            f.left = INT64_MAX;
            assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
            test_run_destroy(j->run);
        }
        assert_int_equal(status, OSDTEX_OK);
    }
}

/* Patches of what does not tile reach its rim. */
static void
the_whole_of_what_does_not_tile_is_shown(void **state)
{
    job *j = make_job("sphere", 4, 12.0, false);

    (void)state;
    assert_int_equal(map(j), OSDTEX_OK);
    check_mapping(j);
    assert_true(measure(j).coverage > 0.7);
    test_run_destroy(j->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cage_is_covered_without_flips),
        cmocka_unit_test(nothing_leaves_an_exemplar_that_does_not_tile),
        cmocka_unit_test(a_plane_that_may_continue_has_no_seam),
        cmocka_unit_test(faces_of_many_pictures_go_on),
        cmocka_unit_test(the_same_bytes_from_any_number_of_threads),
        cmocka_unit_test(seeds_differ),
        cmocka_unit_test(the_first_patch_is_where_the_user_wants_it),
        cmocka_unit_test(a_face_is_where_the_user_wants_it_at_the_end),
        cmocka_unit_test(the_first_direction_spreads),
        cmocka_unit_test(a_tiling_exemplar_does_not_continue_itself),
        cmocka_unit_test(no_place_near_the_border_is_left),
        cmocka_unit_test(every_part_can_be_switched),
        cmocka_unit_test(relaxing_and_choosing_lower_the_seams),
        cmocka_unit_test(cancelling_at_any_call_leaves_nothing),
        cmocka_unit_test(failing_any_allocation_leaves_nothing),
        cmocka_unit_test(the_whole_of_what_does_not_tile_is_shown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

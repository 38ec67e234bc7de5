/* test_supply.c -- runs of several exemplars: who shows what, how far seams
 * may run from where they are asked for, and that one exemplar is one. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "mapping/measure.h"
#include "mapping/source.h"
#include "method/hierarchical/settings.h"
#include "method/method.h"
#include "patch/mosaic.h"
#include "relax/cut.h"
#include "surface/distance.h"

#include <stdlib.h>

enum
{
    EXEMPLARS = 3,
    SIDE = 64
};

typedef struct job
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplars; /* [EXEMPLARS] */
    uint8_t *demand;         /* [leaf face_count] */
    otx_map_request request;
    otx_patch_settings settings;
    otx_mapping mapping;
    otx_figures figures;
    int32_t exemplar_count;
} job;

/* Blobs; another `kind`, other ones. */
static void
paint(otx_exemplar *e, int kind)
{
    float *p = e->match.pixels;
    const double turn = 2.0 * OTX_PI / SIDE;

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x, p += 3)
        {
            const double a =
                sin(turn * ((5 + kind) * x + 2 * y) + 3 * sin(turn * y));
            const double b =
                sin(turn * (7 * y - (3 + kind) * x) + 2 * sin(turn * x));

            p[0] = (float)(0.7 * (50.0 + 50.0 * a * b) + 0.3 * p[0]);
            p[1] = (float)(0.7 * (50.0 + 50.0 * a) + 0.3 * p[1] + 5.0 * kind);
            p[2] = (float)(0.7 * (50.0 + 50.0 * b) + 0.3 * p[2]);
        }
}

/* What is asked for: `count` sectors about an axis off the middle, across the
 * faces of the cage. */
static void
ask_for_sectors(job *j, int32_t count)
{
    const otx_level *leaf = otx_surface_leaf(j->surface);

    j->exemplar_count = EXEMPLARS;
    j->request.demand = j->demand;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const otx_vec3 p = otx_vec3_load(
            j->surface->points, leaf->face_verts[leaf->face_first[f]]);
        const double turn =
            atan2(p.y - 0.11, p.x - 0.07) / (2.0 * OTX_PI) + 0.5;

        j->demand[f] = (uint8_t)fmin(floor(turn * count), (double)(count - 1));
    }
}

static job *
make_job(int32_t threads, const char *cage, int32_t level, bool same)
{
    otx_run *run = test_run_create_with(NULL, threads);
    job *j = OTX_ZNEW(run->arena, job, 1);
    char path[128];

    j->run = run;
    snprintf(path, sizeof path, "models/cages/%s.obj", cage);
    j->surface = OTX_NEW(run->arena, otx_surface, 1);
    *j->surface = sheet_from_file(run, path, level);
    j->exemplars = OTX_NEW(run->arena, otx_exemplar, EXEMPLARS);
    for (int k = 0; k < EXEMPLARS; ++k)
    {
        j->exemplars[k] =
            *test_exemplar_create(run->arena, SIDE, SIDE, k != 1, 4);
        paint(&j->exemplars[k], same ? 0 : k);
    }
    j->demand =
        OTX_ZNEW(run->arena, uint8_t, otx_surface_leaf(j->surface)->face_count);
    j->request.scale = sqrt(j->surface->area / 10.0);
    j->request.first_face = -1;
    otx_option_defaults(
        otx_hierarchical_options, OTX_HIERARCHICAL_OPTION_COUNT, &j->settings);
    j->settings.angles = 7;
    return j;
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

static otx_status
map_by(job *j, const char *method)
{
    return otx_method_map(
        otx_method_find(method),
        &(otx_job){
            j->run, j->surface, j->exemplars,
            j->request.demand ? j->exemplar_count : 1, &j->request,
            &j->settings, &j->figures},
        &j->mapping);
}

static void
map(job *j)
{
    if (map_by(j, "hierarchical") != OSDTEX_OK)
        fail_msg("%s", test_last_message(j->run));
}

/* Texels from where the demand ends. */
static double *
distances(job *j)
{
    const int32_t count = otx_surface_leaf(j->surface)->face_count;
    double *away = OTX_NEW(j->run->arena, double, count);

    assert_int_equal(
        otx_distance_measure(
            j->run, j->surface, j->demand, SIDE / j->request.scale, INFINITY,
            away),
        OSDTEX_OK);
    return away;
}

/* Everything covered, nothing reversed, everything beyond the band as asked
 * for. How many faces show what they are not asked for. */
static int32_t
check(job *j, double band)
{
    const otx_level *leaf = otx_surface_leaf(j->surface);
    const double *away = distances(j);
    int32_t moved = 0;
    otx_measure m;

    assert_int_equal(
        otx_measure_run(j->run, &j->mapping, j->exemplars, NULL, &m),
        OSDTEX_OK);
    assert_int_equal(m.uncovered, 0);
    assert_int_equal(m.flips, 0);
    assert_int_equal(m.outside, 0);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        if (leaf->face_hole[f] || otx_source_of(&j->mapping, f) == j->demand[f])
            continue;
        assert_true(away[f] < band);
        ++moved;
    }
    return moved;
}

static void
beyond_the_band_everything_is_as_asked_for(void **state)
{
    static const char *const cages[] = {
        "creature",    "torus", "open_boundary", "several_components",
        "loop_closed", "hole",  "plane"};
    int32_t moved = 0;

    (void)state;
    for (int32_t i = 0; i < COUNT(cages); ++i)
    {
        job *j = make_job(2, cages[i], 2, false);

        ask_for_sectors(j, EXEMPLARS);
        map(j);
        assert_int_equal(j->mapping.exemplar_count, EXEMPLARS);
        moved += check(j, SIDE / 8.0);
        test_run_destroy(j->run);
    }
    assert_true(moved > 0); /* the cut does choose */
}

static void
without_a_band_or_a_cut_seams_keep_to_the_border(void **state)
{
    static const char *const how[][2] = {
        {"transition", "0"}, {"cut", "off"}, {"mode", "paper"}};

    (void)state;
    for (int32_t i = 0; i < COUNT(how); ++i)
    {
        job *j = make_job(2, "creature", 1, false);

        ask_for_sectors(j, EXEMPLARS);
        set(j, how[i][0], how[i][1]);
        map(j);
        assert_int_equal(check(j, 0.0), 0);
        test_run_destroy(j->run);
    }
}

/* Whoever is asked for nowhere leaves no trace, and a copy of the first is the
 * first. */
static void
a_single_one_of_several_is_a_single_one(void **state)
{
    job *one = make_job(2, "creature", 1, true);
    const size_t corners = (size_t)otx_surface_leaf(one->surface)->corner_count;

    (void)state;
    map(one);
    assert_null(one->mapping.patch_exemplar);
    for (int k = 0; k < 3; k += 2)
    {
        job *j = make_job(2, "creature", 1, true);

        ask_for_sectors(j, 1);
        memset(j->demand, k, (size_t)otx_surface_leaf(j->surface)->face_count);
        map(j);
        assert_memory_equal(
            j->mapping.uvs, one->mapping.uvs, 2 * corners * sizeof(float));
        assert_int_equal(j->mapping.patch_count, one->mapping.patch_count);
        for (int32_t p = 0; p < j->mapping.patch_count; ++p)
            assert_int_equal(j->mapping.patch_exemplar[p], k);
        test_run_destroy(j->run);
    }
    test_run_destroy(one->run);
}

static void
the_same_bytes_from_any_number_of_threads(void **state)
{
    static const int32_t threads[] = {2, 8};
    job *first = make_job(1, "creature", 1, false);
    const size_t corners =
        (size_t)otx_surface_leaf(first->surface)->corner_count;

    (void)state;
    ask_for_sectors(first, EXEMPLARS);
    map(first);
    for (int32_t t = 0; t < COUNT(threads); ++t)
    {
        job *j = make_job(threads[t], "creature", 1, false);

        ask_for_sectors(j, EXEMPLARS);
        map(j);
        assert_memory_equal(
            j->mapping.uvs, first->mapping.uvs, 2 * corners * sizeof(float));
        assert_int_equal(j->mapping.patch_count, first->mapping.patch_count);
        assert_memory_equal(
            j->mapping.patch_exemplar, first->mapping.patch_exemplar,
            (size_t)first->mapping.patch_count);
        test_run_destroy(j->run);
    }
    test_run_destroy(first->run);
}

/* Nothing where an exemplar is asked for; elsewhere from nothing at the border
 * to a third of sigma a texel over the band, in the unit of strain; beyond, no
 * price is enough. */
static void
straying_costs_more_the_farther(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = OTX_ZNEW(run->arena, otx_mosaic, 1);
    const double band = 8.0, sigma = 0.4;
    const otx_exemplar exemplar = {.match_sigma = sigma};
    const uint8_t demand[] = {0, 0, 0, 0, 0, 1};
    double away[] = {0.0, 2.0, 4.0, 7.9, 8.0, 3.0};
    const otx_node node = {.supply = 1};
    const double distortion = otx_cut_options_default().distortion;
    double sum = 0.0;

    (void)state;
    m->job.exemplars = &exemplar;
    m->job.demand = demand;
    m->supplies.away = away;
    m->supplies.transition = band;
    assert_true(otx_supply_cost(m, &node, 0) == 0.0f);
    for (int f = 1; f < 4; ++f)
        assert_true(
            otx_supply_cost(m, &node, f) > otx_supply_cost(m, &node, f - 1));
    assert_true(otx_supply_cost(m, &node, 4) < 0.0f);
    assert_true(otx_supply_cost(m, &node, 5) == 0.0f);
    for (int i = 0; i < 1000; ++i)
    {
        away[0] = band * (i + 0.5) / 1000.0;
        sum +=
            distortion * (double)otx_supply_cost(m, &node, 0) * band / 1000.0;
    }
    assert_true(fabs(sum - sigma / 3.0) < 1e-3 * sigma);
    m->supplies.transition = 0.0;
    away[0] = 0.0;
    assert_true(otx_supply_cost(m, &node, 0) < 0.0f);
    test_run_destroy(run);
}

/* Transitions are told apart from seams, and shares add up. */
static void
measures_tell_exemplars_apart(void **state)
{
    job *j = make_job(2, "sphere", 2, false);
    int32_t faces = 0;
    double area = 0.0;
    otx_measure m;

    (void)state;
    ask_for_sectors(j, EXEMPLARS);
    map(j);
    assert_int_equal(
        otx_measure_run(j->run, &j->mapping, j->exemplars, NULL, &m),
        OSDTEX_OK);
    for (int k = 0; k < EXEMPLARS; ++k)
    {
        assert_true(m.shares[k].coverage > 0.1 && m.shares[k].coverage <= 1.0);
        faces += m.shares[k].faces;
        area += m.shares[k].area;
    }
    assert_int_equal(faces, otx_surface_leaf(j->surface)->face_count);
    assert_true(fabs(area - m.area) < 1e-9 * m.area);
    assert_true(m.transition_length > 0.0 && m.transition_rms > 0.0);
    test_run_destroy(j->run);
}

static void
other_methods_take_one(void **state)
{
    job *j = make_job(1, "sphere", 1, false);

    (void)state;
    ask_for_sectors(j, EXEMPLARS);
    assert_int_equal(map_by(j, "tile"), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(j->run), "takes one exemplar"));
    test_run_destroy(j->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beyond_the_band_everything_is_as_asked_for),
        cmocka_unit_test(without_a_band_or_a_cut_seams_keep_to_the_border),
        cmocka_unit_test(a_single_one_of_several_is_a_single_one),
        cmocka_unit_test(the_same_bytes_from_any_number_of_threads),
        cmocka_unit_test(straying_costs_more_the_farther),
        cmocka_unit_test(measures_tell_exemplars_apart),
        cmocka_unit_test(other_methods_take_one),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

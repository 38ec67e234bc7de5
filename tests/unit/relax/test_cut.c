/* test_cut.c -- planted paths are found, small cases are solved exactly, and
 * nothing depends on threads. */
#include "cuts.h"

enum
{
    NX = 16,
    NY = 12
};

/* Where the planted path runs in row y: up at x = 7, right along y = 6, up at
 * x = 9. */
static int32_t
planted(int32_t y)
{
    return y < 6 ? 7 : 9;
}

/* Whether texel (x, y) is within 3 texels of the path. */
static bool
near_path(double x, double y)
{
    const double reach = 3.0, level = 6.0 * DENSITY;
    const bool low = y < level + reach && fabs(x - 7.0 * DENSITY) < reach;
    const bool high = y > level - reach && fabs(x - 9.0 * DENSITY) < reach;
    const bool step = fabs(y - level) < reach && x > 7.0 * DENSITY - reach &&
                      x < 9.0 * DENSITY + reach;

    return low || high || step;
}

static void
a_planted_path_is_cut_exactly(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, NX, NY, 1.0);
    otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 256, NY * DENSITY, false, 3);
    const otx_offer offers[2] = {
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){0, 0, 13, NY}, 0.0,
            (otx_vec2){0.0, 0.0}),
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){3, 0, NX, NY}, 0.0,
            (otx_vec2){128.0, 0.0})};
    const otx_cut_options options = unit_options();
    int32_t labels[NX * NY];
    otx_cut_stats stats;

    (void)state;
    for (int32_t y = 0; y < NY * DENSITY; ++y)
        for (int32_t x = 0; x < 128; ++x)
            if (near_path(x + 0.5, y + 0.5))
                memcpy(
                    otx_image_at(&exemplar->match, x + 128, y),
                    otx_image_at(&exemplar->match, x, y), 3 * sizeof(float));
    for (int32_t f = 0; f < NX * NY; ++f)
        labels[f] = f % NX < 5 ? 0 : 1;
    assert_int_equal(
        otx_cut_run(
            run, surface, exemplar, offers, 2, &options, labels, &stats),
        OSDTEX_OK);
    for (int32_t f = 0; f < NX * NY; ++f)
        assert_int_equal(labels[f], f % NX < planted(f / NX) ? 0 : 1);
    assert_int_equal(stats.patches, 2);
    assert_int_equal(stats.rejected, 0);
    /* What is left is the cost of length: 14 edges of 8 texels. */
    assert_float_equal(
        stats.energy_after, 14 * 8 * 1e-3 * exemplar->match_sigma, 0.1);
    assert_true(stats.energy_before > 100.0 * stats.energy_after);
    test_run_destroy(run);
}

/* The same between two pictures, at the same UVs: what is continuous in one is
 * a seam between two, and costs its length even where they agree. */
static void
a_path_between_two_exemplars_is_cut_exactly(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, NX, NY, 1.0);
    otx_exemplar pair[2];
    otx_offer offers[2] = {
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){0, 0, 13, NY}, 0.0,
            (otx_vec2){0.0, 0.0}),
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){3, 0, NX, NY}, 0.0,
            (otx_vec2){0.0, 0.0})};
    const otx_cut_options options = unit_options();
    int32_t labels[NX * NY];
    otx_cut_stats stats;

    (void)state;
    offers[1].exemplar = 1;
    for (int k = 0; k < 2; ++k)
        pair[k] = *test_exemplar_create(
            run->arena, 128, NY * DENSITY, false, k == 0 ? 3 : 5);
    for (int32_t y = 0; y < NY * DENSITY; ++y)
        for (int32_t x = 0; x < 128; ++x)
            if (near_path(x + 0.5, y + 0.5))
                memcpy(
                    otx_image_at(&pair[1].match, x, y),
                    otx_image_at(&pair[0].match, x, y), 3 * sizeof(float));
    for (int32_t f = 0; f < NX * NY; ++f)
        labels[f] = f % NX < 5 ? 0 : 1;
    assert_int_equal(
        otx_cut_run(run, surface, pair, offers, 2, &options, labels, &stats),
        OSDTEX_OK);
    for (int32_t f = 0; f < NX * NY; ++f)
        assert_int_equal(labels[f], f % NX < planted(f / NX) ? 0 : 1);
    assert_float_equal(
        stats.energy_after, 14 * 8 * 1e-3 * pair[0].match_sigma, 0.1);
    test_run_destroy(run);
}

/* Two exemplars that show the same everywhere: where it can be cut is what
 * tells. */
static void
a_border_goes_round_features(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, NX, NY, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 128, NY * DENSITY, false, 3);
    const otx_exemplar pair[2] = {*exemplar, *exemplar};
    otx_offer offers[2] = {
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){0, 0, 13, NY}, 0.0,
            (otx_vec2){0.0, 0.0}),
        offer_rectangle(
            run->arena, surface, NX, (int32_t[]){3, 0, NX, NY}, 0.0,
            (otx_vec2){0.0, 0.0})};
    otx_image outlines[2];
    otx_cut_options options = unit_options();
    int32_t labels[NX * NY];
    otx_cut_stats stats;

    (void)state;
    offers[1].exemplar = 1;
    for (int k = 0; k < 2; ++k)
    {
        assert_int_equal(
            otx_image_create(
                run, run->arena, 128, NY * DENSITY, 1, &outlines[k]),
            OSDTEX_OK);
        for (int32_t y = 0; y < NY * DENSITY; ++y)
            for (int32_t x = 0; x < 128; ++x)
                *otx_image_at(&outlines[k], x, y) =
                    k == 1 && !near_path(x + 0.5, y + 0.5);
    }
    options.outlines = outlines;
    for (int32_t f = 0; f < NX * NY; ++f)
        labels[f] = f % NX < 5 ? 0 : 1;
    assert_int_equal(
        otx_cut_run(run, surface, pair, offers, 2, &options, labels, &stats),
        OSDTEX_OK);
    for (int32_t f = 0; f < NX * NY; ++f)
        assert_int_equal(labels[f], f % NX < planted(f / NX) ? 0 : 1);
    assert_int_equal(stats.rejected, 0);
    test_run_destroy(run);
}

static int64_t
energy_of(const otx_cut_cost *cost, const int32_t *labels)
{
    const otx_level *leaf = cost->leaf;
    int64_t sum = 0;

    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * e;

        if (f[1] >= 0)
            sum += otx_cut_cost_edge(
                cost, e, (otx_cut_view){labels[f[0]], f[0]},
                (otx_cut_view){labels[f[1]], f[1]});
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        sum += otx_cut_cost_face(cost, f, (otx_cut_view){labels[f], f});
    return sum;
}

/* With two labels one expansion from a single label is a global minimum. */
static void
two_labels_are_solved_exactly(void **state)
{
    enum
    {
        FACES = 12
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 4, 3, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 5);
    const int32_t all[4] = {0, 0, 4, 3};
    otx_cut_options options = unit_options();

    (void)state;
    options.distortion = 0.02;
    for (uint64_t round = 0; round < 8; ++round)
    {
        float costs[2][FACES];
        otx_offer offers[2];
        int32_t labels[FACES] = {0}, other[FACES];
        int64_t least = INT64_MAX;

        for (uint64_t p = 0; p < 2; ++p)
        {
            offers[p] = offer_rectangle(
                run->arena, surface, 4, all, (double)(round + p),
                (otx_vec2){10.0 * (double)p, (double)round});
            for (uint64_t f = 0; f < FACES; ++f)
                costs[p][f] =
                    (float)(800.0 * otx_random_unit(round, 1, FACES * p + f));
            offers[p].cost = costs[p];
        }

        const otx_cut_cost cost =
            otx_cut_cost_create(surface, exemplar, offers, &options);

        for (int32_t bits = 0; bits < 1 << FACES; ++bits)
        {
            for (int32_t f = 0; f < FACES; ++f)
                other[f] = bits >> f & 1;

            const int64_t energy = energy_of(&cost, other);

            least = energy < least ? energy : least;
        }
        assert_int_equal(
            otx_cut_run(
                run, surface, exemplar, offers, 2, &options, labels, NULL),
            OSDTEX_OK);
        assert_int_equal(energy_of(&cost, labels), least);
    }
    test_run_destroy(run);
}

enum
{
    SIDE = 24,
    PATCHES = 30
};

/* Many turned patches on noise; patch 0 offers everything. Labels end in
 * `labels`. */
static otx_cut_stats
cut_random(int32_t threads, uint64_t seed, int32_t labels[SIDE * SIDE])
{
    otx_run *run = test_run_create_with(NULL, threads);
    const otx_surface *surface = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 128, 128, true, seed);
    const otx_cut_options options = unit_options();
    uint8_t offered[PATCHES][SIDE * SIDE] = {{0}};
    otx_offer offers[PATCHES];
    otx_cut_stats stats;

    for (int32_t f = 0; f < SIDE * SIDE; ++f)
        labels[f] = -1;
    for (int32_t p = 0; p < PATCHES; ++p)
    {
        const uint64_t r = otx_random_bits(seed, 2, (uint64_t)p);
        const int32_t x = (int32_t)(r % (SIDE - 6));
        const int32_t y = (int32_t)(r / 64 % (SIDE - 6));
        int32_t box[4] = {x, y, x + 6 + x % 3, y + 6};

        if (box[2] > SIDE)
            box[2] = SIDE;
        if (p == 0)
            memcpy(box, (int32_t[]){0, 0, SIDE, SIDE}, sizeof box);
        offers[p] = offer_rectangle(
            run->arena, surface, SIDE, box, (double)(r % 7),
            (otx_vec2){(double)(r % 101), (double)(r % 103)});
        for (int32_t i = 0; i < offers[p].face_count; ++i)
        {
            offered[p][offers[p].faces[i]] = 1;
            labels[offers[p].faces[i]] = p;
        }
    }
    assert_int_equal(
        otx_cut_run(
            run, surface, exemplar, offers, PATCHES, &options, labels, &stats),
        OSDTEX_OK);
    for (int32_t f = 0; f < SIDE * SIDE; ++f)
        assert_true(labels[f] >= 0 && offered[labels[f]][f]);
    test_run_destroy(run);
    return stats;
}

static void
energy_falls_and_labels_stay_within_their_offers(void **state)
{
    int32_t labels[SIDE * SIDE];

    (void)state;
    for (uint64_t seed = 1; seed <= 5; ++seed)
    {
        const otx_cut_stats stats = cut_random(2, seed, labels);

        assert_true(stats.energy_after < stats.energy_before);
        assert_true(stats.changed > 0 && stats.moves > 0);
        assert_int_equal(stats.rejected, 0);
    }
}

/* Eight times eight patches on 32 x 32 faces, most out of sight of each other.
 */
static void
cut_many(int32_t threads, int32_t labels[32 * 32])
{
    otx_run *run = test_run_create_with(NULL, threads);
    const otx_surface *surface = test_grid_create(run->arena, 32, 32, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 128, 128, true, 3);
    const otx_cut_options options = unit_options();
    otx_offer offers[64];
    otx_cut_stats stats;

    for (int32_t p = 0; p < 64; ++p)
    {
        const int32_t x = p * 5 % 8 * 4, y = p * 5 / 8 % 8 * 4;
        const int32_t box[4] = {
            x > 2 ? x - 3 : 0, y > 2 ? y - 3 : 0, x < 25 ? x + 7 : 32,
            y < 25 ? y + 7 : 32};

        offers[p] = offer_rectangle(
            run->arena, surface, 32, box, 0.3 * p,
            (otx_vec2){7.0 * p, 11.0 * p});
        for (int32_t f = 0; f < 16; ++f)
            labels[(y + f / 4) * 32 + x + f % 4] = p;
    }
    assert_int_equal(
        otx_cut_run(
            run, surface, exemplar, offers, 64, &options, labels, &stats),
        OSDTEX_OK);
    assert_true(stats.moves > 32 && stats.rejected == 0);
    test_run_destroy(run);
}

static void
moves_at_the_same_time_do_not_change_the_labels(void **state)
{
    int32_t one[32 * 32], other[32 * 32];

    (void)state;
    cut_many(1, one);
    for (int round = 0; round < 4; ++round)
    {
        cut_many(round % 2 ? 8 : 2, other);
        assert_memory_equal(one, other, sizeof one);
    }
}

static void
threads_do_not_change_the_labels(void **state)
{
    int32_t one[SIDE * SIDE], other[SIDE * SIDE];

    (void)state;
    cut_random(1, 9, one);
    cut_random(2, 9, other);
    assert_memory_equal(one, other, sizeof one);
    cut_random(8, 9, other);
    assert_memory_equal(one, other, sizeof one);
}

static void
faces_without_a_patch_are_taken_but_holes_are_not(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 4, 1, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 6);
    const otx_offer offer = offer_rectangle(
        run->arena, surface, 4, (int32_t[]){0, 0, 3, 1}, 0.0,
        (otx_vec2){0.0, 0.0});
    const otx_cut_options options = unit_options();
    int32_t labels[4] = {0, -1, -1, -1};
    otx_cut_stats stats;

    (void)state;
    assert_int_equal(
        otx_cut_run(
            run, surface, exemplar, &offer, 1, &options, labels, &stats),
        OSDTEX_OK);
    assert_int_equal(labels[1], 0);
    assert_int_equal(labels[2], 0);
    assert_int_equal(labels[3], -1);
    assert_int_equal(stats.changed, 2);
    test_run_destroy(run);
}

static void
bad_input_is_refused_and_labels_stay(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 2, 1, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 16, 16, true, 6);
    otx_offer offer = offer_rectangle(
        run->arena, surface, 2, (int32_t[]){0, 0, 1, 1}, 0.0,
        (otx_vec2){0.0, 0.0});
    otx_cut_options options = unit_options();
    int32_t labels[2] = {0, 0};

    (void)state;
    assert_int_equal(
        otx_cut_run(run, surface, exemplar, &offer, 1, &options, labels, NULL),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "does not offer"));
    labels[1] = 1;
    assert_int_equal(
        otx_cut_run(run, surface, exemplar, &offer, 1, &options, labels, NULL),
        OSDTEX_ERROR_ARGUMENT);
    options.texels_per_unit = 0.0;
    assert_int_equal(
        otx_cut_run(run, surface, exemplar, &offer, 1, &options, labels, NULL),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(labels[0], 0);
    assert_int_equal(labels[1], 1);
    test_run_destroy(run);
}

static bool
refuse(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    (void)fraction;
    return false;
}

static void
cancelling_leaves_the_labels(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 2, 1, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 16, 16, true, 6);
    const otx_offer offer = offer_rectangle(
        run->arena, surface, 2, (int32_t[]){0, 0, 2, 1}, 0.0,
        (otx_vec2){0.0, 0.0});
    const otx_cut_options options = unit_options();
    int32_t labels[2] = {0, -1};

    (void)state;
    run->progress = refuse;
    assert_int_equal(
        otx_cut_run(run, surface, exemplar, &offer, 1, &options, labels, NULL),
        OSDTEX_ERROR_CANCELLED);
    assert_int_equal(labels[1], -1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_planted_path_is_cut_exactly),
        cmocka_unit_test(a_path_between_two_exemplars_is_cut_exactly),
        cmocka_unit_test(a_border_goes_round_features),
        cmocka_unit_test(two_labels_are_solved_exactly),
        cmocka_unit_test(energy_falls_and_labels_stay_within_their_offers),
        cmocka_unit_test(threads_do_not_change_the_labels),
        cmocka_unit_test(moves_at_the_same_time_do_not_change_the_labels),
        cmocka_unit_test(faces_without_a_patch_are_taken_but_holes_are_not),
        cmocka_unit_test(bad_input_is_refused_and_labels_stay),
        cmocka_unit_test(cancelling_leaves_the_labels),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

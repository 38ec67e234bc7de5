/* test_polygon.c -- sides are kept, plane polygons come back as they are. */
#include "support.h"

#include "base/random.h"
#include "flatten/polygon.h"

enum
{
    CORNERS_MAX = 9
};

static double
chance(uint64_t i)
{
    return otx_random_unit(11, 0, i);
}

/* A convex polygon in a tilted plane, corners moved out of it by `bump`. */
static void
make(int32_t n, uint64_t seed, double bump, otx_vec3 *out, otx_vec3 *normal)
{
    const otx_vec3 x = otx_vec3_unit((otx_vec3){1, 0.4, -0.3});
    const otx_vec3 z = otx_vec3_unit(otx_vec3_cross(x, (otx_vec3){0, 1, 0.2}));
    const otx_vec3 y = otx_vec3_cross(z, x);

    for (int32_t i = 0; i < n; ++i)
    {
        const double turn = 2.0 * OTX_PI * (i + 0.4 * chance(seed + i)) / n;
        const otx_vec3 p = otx_vec3_mix(3.0 * cos(turn), x, 2.0 * sin(turn), y);

        out[i] = otx_vec3_mix(1.0, p, bump * (chance(seed + 50 + i) - 0.5), z);
    }
    *normal = z;
}

static void
check_layout(int32_t n, uint64_t seed, double bump, double tolerance)
{
    otx_run *run = test_run_create();
    otx_vec3 p[CORNERS_MAX], normal;
    otx_vec2 q[CORNERS_MAX];
    double area = 0.0;

    make(n, seed, bump, p, &normal);
    assert_int_equal(
        otx_polygon_layout(run->scratch, p, n, normal, q), OSDTEX_OK);
    assert_true(fabs(q[0].x) + fabs(q[0].y) + fabs(q[1].y) < 1e-6);
    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = i + 1; j < n; ++j)
        {
            const double flat = otx_vec2_length(otx_vec2_sub(q[i], q[j]));
            const double space = otx_vec3_length(otx_vec3_sub(p[i], p[j]));
            const bool side = j == i + 1 || (i == 0 && j == n - 1);

            /* A plane polygon is rigid: its diagonals are kept as well. */
            assert_true(fabs(flat - space) < (side ? 1e-6 : tolerance));
        }
    for (int32_t i = 0; i < n; ++i)
        area += otx_vec2_cross(q[i], q[(i + 1) % n]);
    assert_true(area > 0.0);
    test_run_destroy(run);
}

static void
plane_polygons_keep_their_shape(void **state)
{
    (void)state;
    for (int32_t n = 3; n <= CORNERS_MAX; ++n)
        for (uint64_t seed = 0; seed < 20; ++seed)
            check_layout(n, 100 * seed, 0.0, 1e-4);
}

static void
bent_polygons_keep_their_sides(void **state)
{
    (void)state;
    for (int32_t n = 3; n <= CORNERS_MAX; ++n)
        for (uint64_t seed = 0; seed < 20; ++seed)
            check_layout(n, 100 * seed, 1.5, INFINITY);
}

static void
a_hollow_corner_stays_hollow(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec3 arrow[] = {
        {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
    otx_vec2 q[5];

    (void)state;
    assert_int_equal(
        otx_polygon_layout(run->scratch, arrow, 5, (otx_vec3){0, 0, 1}, q),
        OSDTEX_OK);
    for (int i = 0; i < 5; ++i)
    {
        assert_true(fabs(q[i].x - arrow[i].x) < 1e-6);
        assert_true(fabs(q[i].y - arrow[i].y) < 1e-6);
    }
    test_run_destroy(run);
}

static void
degenerate_polygons_stay_finite(void **state)
{
    otx_run *run = test_run_create();
    const otx_vec3 point[6] = {
        {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    const otx_vec3 line[6] = {
        {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1, 0, 0}};

    (void)state;
    for (int32_t n = 3; n <= 6; ++n)
    {
        const otx_vec3 *both[] = {point, line};

        for (int k = 0; k < 2; ++k)
        {
            otx_vec2 q[6];

            assert_int_equal(
                otx_polygon_layout(
                    run->scratch, both[k], n, (otx_vec3){0, 0, 0}, q),
                OSDTEX_OK);
            for (int32_t i = 0; i < n; ++i)
                assert_true(isfinite(q[i].x) && isfinite(q[i].y));
        }
    }
    test_run_destroy(run);
}

static void
coordinates_reproduce_the_point(void **state)
{
    (void)state;
    for (int32_t n = 3; n <= CORNERS_MAX; ++n)
    {
        otx_vec2 q[CORNERS_MAX], x = {0.21, -0.17}, back = {0, 0};
        double w[CORNERS_MAX], sum = 0.0;

        for (int32_t i = 0; i < n; ++i)
            q[i] = otx_vec2_scale(
                1.0 + chance((uint64_t)(40 * n + i)),
                otx_vec2_polar(2.0 * OTX_PI * i / n));
        otx_polygon_coordinates(q, n, x, w);
        for (int32_t i = 0; i < n; ++i)
        {
            assert_true(w[i] > 0.0);
            sum += w[i];
            back = otx_vec2_add(back, otx_vec2_scale(w[i], q[i]));
        }
        assert_true(fabs(sum - 1.0) < 1e-12);
        assert_true(otx_vec2_length(otx_vec2_sub(back, x)) < 1e-12);
    }
}

static void
coordinates_without_an_answer_are_even(void **state)
{
    const otx_vec2 same[4] = {{2, 2}, {2, 2}, {2, 2}, {2, 2}};
    double w[4];

    (void)state;
    otx_polygon_coordinates(same, 4, (otx_vec2){2, 2}, w);
    for (int i = 0; i < 4; ++i)
        assert_true(w[i] == 0.25);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_polygons_keep_their_shape),
        cmocka_unit_test(bent_polygons_keep_their_sides),
        cmocka_unit_test(a_hollow_corner_stays_hollow),
        cmocka_unit_test(degenerate_polygons_stay_finite),
        cmocka_unit_test(coordinates_reproduce_the_point),
        cmocka_unit_test(coordinates_without_an_answer_are_even),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_raster.c -- each sample has one facet, each texel its nearest edge. */
#include "support.h"

#include "bake/raster.h"
#include "base/random.h"

#include <math.h>

static otx_raster
make(otx_run *run, double x, double y, int32_t width, int32_t height, int32_t n)
{
    otx_raster raster = {{x, y}, width, height, n, NULL};

    assert_true(otx_raster_begin(run->arena, &raster));
    return raster;
}

/* The area on the left of a to b, twice. */
static double
left_of(otx_vec2 a, otx_vec2 b, otx_vec2 p)
{
    return otx_vec2_cross(otx_vec2_sub(b, a), otx_vec2_sub(p, a));
}

static otx_vec2
random_point(uint64_t i)
{
    return (otx_vec2){
        20.0 * otx_random_unit(5, 0, i) - 5.0,
        20.0 * otx_random_unit(5, 1, i) - 5.0};
}

static void
samples_are_those_inside(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (uint64_t i = 0; i < 300; i += 3)
    {
        otx_raster raster = make(run, -2.0, 3.0, 9, 7, 2);
        const otx_vec2 p[3] = {
            random_point(i), random_point(i + 1), random_point(i + 2)};
        const double turn = left_of(p[0], p[1], p[2]) > 0.0 ? 1.0 : -1.0;

        otx_raster_triangle(&raster, p, 42);
        for (int32_t y = 0; y < 14; ++y)
            for (int32_t x = 0; x < 18; ++x)
            {
                const otx_vec2 at = {
                    raster.origin.x + (x + 0.5) / raster.n,
                    raster.origin.y + (y + 0.5) / raster.n};
                const double most = fmin(
                    fmin(
                        turn * left_of(p[0], p[1], at),
                        turn * left_of(p[1], p[2], at)),
                    turn * left_of(p[2], p[0], at));

                if (fabs(most) > 1e-3)
                    assert_int_equal(
                        raster.facets[y * 18 + x], most > 0.0 ? 42 : -1);
            }
    }
    test_run_destroy(run);
}

/* Two triangles that make up the block, with samples on their diagonal. */
static void
shared_edges_belong_to_the_first(void **state)
{
    otx_run *run = test_run_create();
    otx_raster raster = make(run, 0.0, 0.0, 8, 8, 2);
    const otx_vec2 a[3] = {{0, 0}, {8, 0}, {8, 8}};
    const otx_vec2 b[3] = {{0, 0}, {0, 8}, {8, 8}}; /* the other way round */

    (void)state;
    otx_raster_triangle(&raster, a, 1);
    otx_raster_triangle(&raster, b, 2);
    for (int32_t y = 0; y < 16; ++y)
        for (int32_t x = 0; x < 16; ++x)
            assert_int_equal(raster.facets[y * 16 + x], x >= y ? 1 : 2);
    test_run_destroy(run);
}

static void
what_lies_on_top_stays_below_the_first(void **state)
{
    otx_run *run = test_run_create();
    otx_raster raster = make(run, 0.0, 0.0, 4, 4, 1);
    const otx_vec2 all[3] = {{-20, -20}, {40, -20}, {-20, 40}};
    const otx_vec2 none[3] = {{0, 0}, {2, 2}, {4, 4}};
    const otx_vec2 wild[3] = {{NAN, 0}, {2, 2}, {INFINITY, 4}};

    (void)state;
    otx_raster_triangle(&raster, none, 1);
    otx_raster_triangle(&raster, wild, 1);
    assert_int_equal(raster.facets[0], -1);
    otx_raster_triangle(&raster, all, 2);
    otx_raster_triangle(&raster, all, 3);
    for (int32_t i = 0; i < 16; ++i)
        assert_int_equal(raster.facets[i], 2);
    test_run_destroy(run);
}

static double
distance_to(const otx_vec2 p[2], otx_vec2 at)
{
    const otx_vec2 d = otx_vec2_sub(
        at, otx_vec2_lerp(p[0], p[1], otx_raster_nearest(p[0], p[1], at)));

    return sqrt(otx_vec2_dot(d, d));
}

static void
texels_have_their_nearest_edge(void **state)
{
    enum
    {
        EDGES = 12
    };
    const double radius = 3.0;
    otx_run *run = test_run_create();
    const otx_raster raster = make(run, 1.0, -3.0, 11, 13, 1);
    otx_vec2 edges[EDGES][2];
    otx_raster_near near;

    (void)state;
    assert_true(otx_raster_near_begin(run->arena, &raster, &near));
    for (int32_t e = 0; e < EDGES; ++e)
    {
        edges[e][0] = random_point((uint64_t)(1000 + 2 * e));
        edges[e][1] = random_point((uint64_t)(1001 + 2 * e));
        otx_raster_edge(&raster, edges[e], radius, e, &near);
    }
    for (int32_t y = 0; y < raster.height; ++y)
        for (int32_t x = 0; x < raster.width; ++x)
        {
            const otx_vec2 at = otx_raster_texel(&raster, x, y);
            const int32_t found = near.edges[y * raster.width + x];
            double least = INFINITY;

            for (int32_t e = 0; e < EDGES; ++e)
                least = fmin(least, distance_to(edges[e], at));
            assert_true(
                found >= 0 ? least <= radius + 1e-6 : least >= radius - 1e-6);
            if (found >= 0)
                assert_true(distance_to(edges[found], at) < least + 1e-5);
        }
    test_run_destroy(run);
}

static void
nearest_stays_on_the_segment(void **state)
{
    const otx_vec2 a = {1, 1}, b = {3, 1};

    (void)state;
    assert_true(otx_raster_nearest(a, b, (otx_vec2){2.5, 9}) == 0.75);
    assert_true(otx_raster_nearest(a, b, (otx_vec2){-4, 0}) == 0.0);
    assert_true(otx_raster_nearest(a, b, (otx_vec2){7, 2}) == 1.0);
    assert_true(otx_raster_nearest(a, a, (otx_vec2){7, 2}) == 0.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_those_inside),
        cmocka_unit_test(shared_edges_belong_to_the_first),
        cmocka_unit_test(what_lies_on_top_stays_below_the_first),
        cmocka_unit_test(texels_have_their_nearest_edge),
        cmocka_unit_test(nearest_stays_on_the_segment),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

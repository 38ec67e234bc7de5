/* test_lattice.c -- planted lattices are found, and whole pictures are whole
 * cells. */
#include "analysis/lattice.h"
#include "unit/surface/meshes.h"

enum
{
    REACH = 60,
    SIDE = 2 * REACH + 1
};

/* Likeness of a picture that repeats by `g`: bumps at its lattice points. */
static otx_lags
planted(otx_run *run, const otx_vec2 g[2])
{
    float *values = OTX_NEW(run->arena, float, SIDE *SIDE);
    const double area = otx_vec2_cross(g[0], g[1]);

    for (int32_t y = -REACH; y <= REACH; ++y)
        for (int32_t x = -REACH; x <= REACH; ++x)
        {
            const otx_vec2 p = {x, y};
            const double a = otx_vec2_cross(p, g[1]) / area;
            const double b = otx_vec2_cross(g[0], p) / area;

            values[(y + REACH) * SIDE + x + REACH] =
                (float)(0.25 * (1.0 + cos(2.0 * OTX_PI * a)) * (1.0 + cos(2.0 * OTX_PI * b)));
        }
    return (otx_lags){REACH, values};
}

static void
planted_lattices_are_found(void **state)
{
    static const otx_vec2 planted_at[][2] = {
        {{20, 0}, {0, 20}}, {{24, 3}, {-3, 17}}, {{18, 0}, {9, 16}}};
    otx_run *run = test_run_create();

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        const otx_vec2 *g = planted_at[i];
        const otx_lags map = planted(run, g);
        const double area = otx_vec2_cross(g[0], g[1]);
        otx_lattice found;

        otx_lattice_find(&map, &found);
        /* The same lattice: whole multiples of the same generators. */
        assert_near(
            fabs(otx_vec2_cross(found.generators[0], found.generators[1])),
            area, 0.06 * area);
        for (int k = 0; k < 2; ++k)
        {
            const double a = otx_vec2_cross(found.generators[k], g[1]) / area;
            const double b = otx_vec2_cross(g[0], found.generators[k]) / area;

            assert_near(a, round(a), 0.06);
            assert_near(b, round(b), 0.06);
        }
    }
    test_run_destroy(run);
}

static void
order_depends_on_the_lattice_alone(void **state)
{
    static const otx_vec2 g[2] = {{20, 2}, {-3, 15}};

    (void)state;
    for (int i = 0; i < 8; ++i)
    {
        const otx_vec2 a = otx_vec2_scale(i & 1 ? -1.0 : 1.0, g[0]);
        const otx_vec2 b = otx_vec2_scale(i & 2 ? -1.0 : 1.0, g[1]);
        otx_vec2 got[2] = {i & 4 ? b : a, i & 4 ? a : b};

        otx_lattice_order(got);
        assert_memory_equal(got, g, sizeof g);
    }
}

static void
whole_pictures_are_whole_cells(void **state)
{
    const otx_image image = {.width = 96, .height = 64, .channels = 3};
    const otx_vec2 rough[2] = {{31.7, 0.2}, {-0.1, 16.2}};
    otx_vec2 fitted[2] = {rough[0], rough[1]};
    otx_vec2 kept[2] = {rough[0], rough[1]};

    (void)state;
    otx_lattice_fit(&image, true, true, fitted);
    assert_near(fitted[0].x, 32.0, 1e-9);
    assert_near(fitted[0].y, 0.0, 1e-9);
    assert_near(fitted[1].x, 0.0, 1e-9);
    assert_near(fitted[1].y, 16.0, 1e-9);
    otx_lattice_fit(&image, false, false, kept);
    assert_memory_equal(kept, rough, sizeof rough);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planted_lattices_are_found),
        cmocka_unit_test(order_depends_on_the_lattice_alone),
        cmocka_unit_test(whole_pictures_are_whole_cells),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

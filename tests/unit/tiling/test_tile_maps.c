/* test_tile_maps.c -- every map of a set comes from where the colour does, and
 * normals go with the pieces that they lie on. */
#include "tiles.h"

#include "tiling/tile_maps.h"

enum
{
    SIDE = 64,
    FACTOR = 2 /* texels of a map to one of the colour */
};

/* Heights and roughness say where a texel of the map is; normals lean to where
 * columns grow. The colours say the same for their own texels. */
static void
name_texels(otx_run *run, otx_exemplar *e)
{
    otx_companions *c = &e->companions;

    assert_int_equal(
        otx_image_create(
            run, run->arena, FACTOR * SIDE, FACTOR * SIDE, 5, &c->image),
        OSDTEX_OK);
    c->maps[OTX_COMPANION_NORMAL] = (otx_companion){.is_there = true};
    c->maps[OTX_COMPANION_HEIGHT] =
        (otx_companion){.is_there = true, .first = 3};
    c->maps[OTX_COMPANION_ROUGHNESS] =
        (otx_companion){.is_there = true, .first = 4};
    for (int32_t y = 0; y < FACTOR * SIDE; ++y)
        for (int32_t x = 0; x < FACTOR * SIDE; ++x)
        {
            float *p = otx_image_at(&c->image, x, y);

            p[0] = 0.6f;
            p[1] = 0.0f;
            p[2] = 0.8f;
            p[3] = (float)x;
            p[4] = (float)y;
        }
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            float *p = otx_image_at(&e->linear, x, y);

            p[0] = (float)x;
            p[1] = (float)y;
        }
}

/* Texels of the maps within one of the colour are its own, in the order that
 * the normals say. */
static void
check_texel(const otx_tileset *made, int32_t x, int32_t y, int32_t *turned)
{
    const float *color = otx_image_at(&made->linear, x, y);
    const otx_image *maps = &made->companions.image;
    const float *low = otx_image_at(maps, FACTOR * x, FACTOR * y);
    const float *right = low + maps->channels;
    const double dx = (double)right[3] - (double)low[3];
    const double dy = (double)right[4] - (double)low[4];

    for (int32_t i = 0; i < FACTOR * FACTOR; ++i)
    {
        const float *p = otx_image_at(
            maps, FACTOR * x + i % FACTOR, FACTOR * y + i / FACTOR);

        assert_true((int32_t)p[3] / FACTOR == (int32_t)color[0]);
        assert_true((int32_t)p[4] / FACTOR == (int32_t)color[1]);
        assert_float_equal(p[0], 0.6 * dx, 1e-6);
        assert_float_equal(p[1], -0.6 * dy, 1e-6);
        assert_float_equal(p[2], 0.8, 1e-6);
    }
    assert_float_equal(fabs(dx) + fabs(dy), 1.0, 1e-6);
    *turned += dx < 0.5;
}

/* A tile's texel and its right neighbour, where they are neighbours in the
 * picture, too, say the turn; of those that stand alone nothing is known. */
static void
check_neighbours(
    const otx_tileset *made, int32_t x, int32_t y, int32_t *seen,
    int32_t *wrong)
{
    const float *a = otx_image_at(&made->linear, x, y);
    const float *b = otx_image_at(&made->linear, x + 1, y);
    const float *n =
        otx_image_at(&made->companions.image, FACTOR * x, FACTOR * y);
    double dx = (double)b[0] - (double)a[0];
    double dy = (double)b[1] - (double)a[1];

    dx -= SIDE * floor(dx / SIDE + 0.5);
    dy -= SIDE * floor(dy / SIDE + 0.5);
    if (fabs(dx) + fabs(dy) != 1.0)
        return;
    ++*seen;
    *wrong +=
        fabs((double)n[0] - 0.6 * dx) + fabs((double)n[1] + 0.6 * dy) > 0.1;
}

static void
maps_lie_where_the_colour_does(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 2, .cell = 16, .gutter = 2};
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 5);
    int32_t turned = 0, seen = 0, wrong = 0;
    otx_tileset made;

    (void)state;
    name_texels(run, e);
    assert_int_equal(otx_tileset_make(run, e, &options, &made), OSDTEX_OK);
    assert_int_equal(made.companions.image.width, FACTOR * made.linear.width);
    for (int32_t y = 0; y < made.linear.height; ++y)
        for (int32_t x = 0; x + 1 < made.linear.width; ++x)
        {
            check_texel(&made, x, y, &turned);
            if ((x + 1) % options.cell != 0)
                check_neighbours(&made, x, y, &seen, &wrong);
        }
    /* Noise has more cuts than any picture. */
    assert_true(turned > seen / 10);
    if (wrong * 1000 > seen)
        fail_msg("%d of %d texels are turned otherwise", wrong, seen);
    test_run_destroy(run);
}

/* Normals cannot be cross-faded. */
static void
ramps_are_refused(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 16, .gutter = 2, .ramp = true};
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 5);
    otx_tileset made;

    (void)state;
    name_texels(run, e);
    assert_int_equal(
        otx_tileset_make(run, e, &options, &made), OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "cross-faded"));
    test_run_destroy(run);
}

/* An edge of the user's own lies at any angle. */
static void
windows_at_an_angle(void **state)
{
    const otx_tileset_edge edge = {{32.0, 32.0}, 0.5, 0.0};
    const otx_tileset_options options = {
        .boundaries = 1,
        .corners = 1,
        .cell = 16,
        .gutter = 2,
        .edge_count = 1,
        .edges = &edge};
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 5);
    int32_t angled = 0;
    otx_tileset made;

    (void)state;
    name_texels(run, e);
    assert_int_equal(otx_tileset_make(run, e, &options, &made), OSDTEX_OK);
    for (int32_t i = 0;
         i < FACTOR * FACTOR * made.linear.width * made.linear.height; ++i)
    {
        const float *n = made.companions.image.pixels + 5 * i;

        assert_float_equal(hypot((double)n[0], (double)n[1]), 0.6, 1e-5);
        /* cos .5 or sin .5 of it, whichever way the tile has it. */
        angled += fabs(fabs((double)n[0]) - 0.6 * cos(0.5)) < 1e-4 ||
                  fabs(fabs((double)n[0]) - 0.6 * sin(0.5)) < 1e-4;
    }
    assert_true(angled > 100);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_lie_where_the_colour_does),
        cmocka_unit_test(ramps_are_refused),
        cmocka_unit_test(windows_at_an_angle),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

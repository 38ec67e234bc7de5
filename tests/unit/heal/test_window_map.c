/* test_window_map.c -- windows of a plane, face by face: copies are found, a
 * cut is seen where it is, and what is made again is looked at. */
#include "grid.h"

#include "base/random.h"
#include "heal/heal.h"
#include "heal/window_map.h"

enum
{
    SIDE = 96, /* texels of the exemplar */
    SPOT = 16,
    FACES = 24, /* along each side of the plane */
    STEP = 8    /* texels of a face */
};

typedef struct scene
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    otx_mapping *mapping;
} scene;

/* Spots of colours by chance, so that it is nowhere like itself. */
static void
set_up(scene *s, otx_run *run)
{
    s->run = run;
    s->surface = test_grid_create(run->arena, FACES, FACES, STEP);
    s->exemplar = test_exemplar_create(run->arena, SIDE, SIDE, true, 1);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
        {
            const int32_t spot =
                i / SIDE / SPOT * (SIDE / SPOT) + i % SIDE / SPOT;
            const double u = OTX_PI / SPOT * (i % SIDE + 0.5);
            const double v = OTX_PI / SPOT * (i / SIDE + 0.5);

            s->exemplar->lab.pixels[3 * i + c] =
                (float)(20.0 + 60.0 * otx_random_unit(2, (uint32_t)c, (uint64_t)spot) * fabs(sin(u) * sin(v)));
        }
    s->mapping = test_mapping_create(run->arena, s->surface, s->exemplar, 1, 0);
}

/* Faces from the middle to column `end` are moved along. */
static void
cut(scene *s, int32_t end)
{
    for (int32_t c = 0; c < 4 * FACES * FACES; ++c)
        if (c / 4 % FACES >= FACES / 2 && c / 4 % FACES < end)
            s->mapping->uvs[2 * c + 1] += 0.31f;
}

/* Windows at the rim of the plane lack a part. */
static bool
is_inner(int32_t face)
{
    const int32_t x = face % FACES, y = face / FACES;

    return x >= 4 && x < FACES - 4 && y >= 4 && y < FACES - 4;
}

/* Along the cut. */
static double
mean_on_cut(const otx_window_map *map)
{
    double sum = 0.0;

    for (int32_t y = 4; y < FACES - 4; ++y)
        sum += map->faces[y * FACES + FACES / 2] / (FACES - 8);
    return sum;
}

static otx_window_map
look(const scene *s)
{
    otx_window_map map;

    assert_int_equal(
        otx_window_map_make(s->run, s->mapping, s->exemplar, &map), OSDTEX_OK);
    return map;
}

static void
copies_are_near(void **state)
{
    scene s;
    otx_window_map map;
    int32_t judged = 0;

    set_up(&s, *state);
    map = look(&s);
    for (int32_t f = 0; f < FACES * FACES; ++f)
    {
        if (is_inner(f))
            assert_true(map.faces[f] < 0.5f);
        judged += map.faces[f] >= 0.0f;
    }
    assert_true(judged > FACES * FACES / 2);
    assert_true(map.mean < 0.3);
    assert_true(map.share_above < 0.01);
}

static void
a_cut_is_seen_where_it_is(void **state)
{
    scene s;
    otx_window_map map;
    double off = 0.0;

    set_up(&s, *state);
    cut(&s, FACES);
    map = look(&s);
    for (int32_t y = 4; y < FACES - 4; ++y)
        off += map.faces[y * FACES + FACES / 2 - 7] / (FACES - 8);
    assert_true(mean_on_cut(&map) > 5.0 * off);
    assert_true(mean_on_cut(&map) > 0.5);
}

/* A mapping with a field is judged by what that shows. */
static void
what_was_made_is_looked_at(void **state)
{
    scene s;
    otx_heal_options options = otx_heal_options_default();
    otx_heal_figures figures;
    otx_window_map before, after;

    set_up(&s, *state);
    cut(&s, FACES / 2 + 2);
    before = look(&s);
    options.band = 48.0;
    assert_int_equal(
        otx_heal_run(
            s.run, s.mapping, s.exemplar, &options, &s.mapping->field,
            &figures),
        OSDTEX_OK);
    assert_non_null(s.mapping->field);
    after = look(&s);
    assert_true(mean_on_cut(&after) < 0.5 * mean_on_cut(&before));
    assert_true(after.faces[8 * FACES + 4] == before.faces[8 * FACES + 4]);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            copies_are_near, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            a_cut_is_seen_where_it_is, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            what_was_made_is_looked_at, test_run_setup, test_run_teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

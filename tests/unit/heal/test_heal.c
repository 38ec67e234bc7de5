/* test_heal.c -- seams mended on a plane: what has none is left alone, a cut
 * through a periodic exemplar is closed, and bytes do not depend on threads. */
#include "grid.h"

#include "heal/heal.h"
#include "mapping/seam.h"
#include "mapping/show.h"

enum
{
    SIDE = 96,   /* texels of the exemplar */
    PERIOD = 24, /* of what it shows */
    FACES = 24,  /* along each side of the plane */
    STEP = 8     /* texels of a face */
};

typedef struct scene
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    otx_mapping *mapping;
} scene;

static otx_exemplar *
paint(otx_arena *arena)
{
    otx_exemplar *exemplar = test_exemplar_create(arena, SIDE, SIDE, true, 1);

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
        {
            const double u = 2.0 * OTX_PI / PERIOD * (i % SIDE + 0.5);
            const double v = 2.0 * OTX_PI / PERIOD * (i / SIDE + 0.5);

            exemplar->lab.pixels[3 * i + c] =
                (float)(40.0 + 20.0 * sin(u + c) + 15.0 * cos(v - 0.5 * c) + 10.0 * sin(2.0 * u + v));
        }
    return exemplar;
}

static scene
set(int32_t threads)
{
    otx_run *run = test_run_create_with(NULL, threads);
    scene s = {.run = run};

    s.surface = test_grid_create(run->arena, FACES, FACES, STEP);
    s.exemplar = paint(run->arena);
    s.mapping = test_mapping_create(run->arena, s.surface, s.exemplar, 1.0, 0);
    return s;
}

/* Moves what the faces of columns [first, end) show by whole texels. */
static void
shift(scene *s, int32_t first, int32_t end, double by)
{
    const otx_level *leaf = otx_surface_leaf(s->surface);

    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const int32_t x = c / 4 % FACES;

        if (x >= first && x < end)
            s->mapping->uvs[2 * c + 1] += (float)(by / SIDE);
    }
}

static const otx_source_field *
heal(scene *s, double band)
{
    otx_heal_options options = otx_heal_options_default();
    const otx_source_field *field;
    otx_heal_figures figures;

    options.band = band;
    options.levels = 3;
    options.starts = 1;
    assert_int_equal(
        otx_heal_run(
            s->run, s->mapping, s->exemplar, &options, &field, &figures),
        OSDTEX_OK);
    return field;
}

static void
what_is_continuous_is_left_alone(void **state)
{
    scene s = set(2);

    (void)state;
    assert_null(heal(&s, 32.0));
    test_run_destroy(s.run);
}

/* Lab at the middle of a face. */
static void
look(const scene *s, int32_t face, float lab[3])
{
    const otx_show_view show = otx_show_of(s->mapping);
    const int32_t corners[3] = {4 * face, 4 * face + 1, 4 * face + 3};
    const double at[3] = {0.0, 0.5, 0.5};

    otx_show_lab(
        &show, s->exemplar, &(otx_show_place){face, corners, at, NULL, NULL}, 0,
        lab);
}

/* How far the middles of faces are from those of an unbroken plane: mean
 * squared Lab distance, and the largest difference of a channel. */
static double
departure(const scene *s, const scene *whole, double *worst)
{
    double sum = 0.0;

    *worst = 0.0;
    for (int32_t f = 0; f < FACES * FACES; ++f)
    {
        float a[3], b[3];

        look(s, f, a);
        look(whole, f, b);
        for (int c = 0; c < 3; ++c)
        {
            const double d = fabs((double)a[c] - (double)b[c]);

            sum += d * d;
            *worst = fmax(*worst, d);
        }
    }
    return sum / (FACES * FACES);
}

/* A strip that is moved along within what repeats: after healing the plane is
 * whole to a fraction of a texel, and there is no seam. Charts lie at any
 * angle, so it is not to the bit. */
static void
a_moved_strip_is_mended(void **state)
{
    scene s = set(2), whole = set(2);
    otx_seam_list seams;
    double before, after, worst_before, worst_after;

    (void)state;
    shift(&s, FACES / 2 - 1, FACES / 2 + 1, 5.0);
    before = departure(&s, &whole, &worst_before);
    s.mapping->field = heal(&s, 48.0);
    assert_non_null(s.mapping->field);
    after = departure(&s, &whole, &worst_after);
    assert_true(after < before / 9.0);
    assert_true(worst_after < worst_before / 2.0);
    assert_int_equal(
        otx_seam_collect(s.run, s.mapping, s.exemplar, &seams), OSDTEX_OK);
    assert_int_equal(seams.edge_count, 0);
    test_run_destroy(s.run);
    test_run_destroy(whole.run);
}

static void
bytes_do_not_depend_on_threads(void **state)
{
    scene one = set(1), other = set(4);
    const otx_source_field *a, *b;
    int64_t count = 0;

    (void)state;
    shift(&one, FACES / 2, FACES, 5.0);
    shift(&other, FACES / 2, FACES, 5.0);
    a = heal(&one, 24.0);
    b = heal(&other, 24.0);
    assert_non_null(a);
    assert_int_equal(a->chart_count, b->chart_count);
    for (int32_t k = 0; k < a->chart_count; ++k)
        count += (int64_t)a->charts[k].width * a->charts[k].height;
    assert_true(count > 0);
    assert_memory_equal(
        a->texels, b->texels, (size_t)count * sizeof *a->texels);
    test_run_destroy(one.run);
    test_run_destroy(other.run);
}

/* With a gate a cut that shows is mended, and one within what repeats, which
 * nobody can see, is not. */
static void
only_what_shows_is_mended(void **state)
{
    (void)state;
    for (int shows = 0; shows < 2; ++shows)
    {
        scene s = set(2);
        otx_heal_options options = otx_heal_options_default();
        const otx_source_field *field;
        otx_heal_figures figures;

        shift(&s, FACES / 2 - 1, FACES / 2 + 1, shows ? 5.0 : PERIOD);
        options.gate = true;
        options.levels = 3;
        options.starts = 1;
        assert_int_equal(
            otx_heal_run(
                s.run, s.mapping, s.exemplar, &options, &field, &figures),
            OSDTEX_OK);
        assert_true(figures.sections > 0);
        assert_int_equal(figures.mended > 0, shows);
        assert_int_equal(field != NULL, shows);
        if (shows)
            assert_true(figures.windows_on[1] < 0.75 * figures.windows_on[0]);
        test_run_destroy(s.run);
    }
}

static bool
never(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    return fraction < 0.05;
}

static void
it_can_be_stopped(void **state)
{
    scene s = set(2);
    otx_heal_options options = otx_heal_options_default();
    const otx_source_field *field;
    otx_heal_figures figures;

    (void)state;
    shift(&s, FACES / 2, FACES, 5.0);
    s.run->progress = never;
    assert_int_equal(
        otx_heal_run(s.run, s.mapping, s.exemplar, &options, &field, &figures),
        OSDTEX_ERROR_CANCELLED);
    assert_null(field);
    test_run_destroy(s.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_continuous_is_left_alone),
        cmocka_unit_test(a_moved_strip_is_mended),
        cmocka_unit_test(only_what_shows_is_mended),
        cmocka_unit_test(bytes_do_not_depend_on_threads),
        cmocka_unit_test(it_can_be_stopped),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

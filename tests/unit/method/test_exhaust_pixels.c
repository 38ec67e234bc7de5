/* test_exhaust_pixels.c -- the tree finds what trying all pixels does. */
#include "grid.h"

#include "base/random.h"
#include "method/vertex/neighbourhood.h"

enum
{
    SIDE = 40,
    QUERIES = 60
};

typedef struct scene
{
    otx_run *run;
    otx_pattern pattern;
    otx_hood hood;
    otx_hood_table table;
} scene;

static void
set_up(scene *s, otx_hood_kind kind, bool wrap)
{
    otx_exemplar *e;

    s->run = test_run_create();
    e = test_exemplar_create(s->run->arena, SIDE, SIDE, wrap, 7);
    assert_int_equal(
        otx_pattern_build(
            s->run, s->run->arena,
            &(otx_pattern_input){
                .lab = &e->lab, .wrap_x = wrap, .wrap_y = wrap, .levels = 2},
            &s->pattern),
        OSDTEX_OK);
    otx_hood_set(&s->hood, kind, 0);
    assert_int_equal(
        otx_hood_table_build(s->run, &s->pattern, &s->hood, &s->table),
        OSDTEX_OK);
}

/* A pixel's square, sample by sample. */
static void
square_of(const scene *s, int32_t pixel, otx_quad *out)
{
    const float x = (float)(pixel % SIDE) + 0.5f;
    const float y = (float)(pixel / SIDE) + 0.5f;

    for (int32_t i = 0; i < s->hood.count; ++i)
    {
        const float scale = i < s->hood.own ? 1.0f : 0.5f;

        otx_pattern_at(
            &s->pattern.levels[i < s->hood.own ? 0 : 1], 1,
            scale * x + (float)s->hood.right[i],
            scale * y - (float)s->hood.down[i], &out[i]);
    }
}

static double
distance(const scene *s, const otx_quad *a, int32_t pixel)
{
    otx_quad b[OTX_HOOD_MOST];
    double sum = 0.0;

    square_of(s, pixel, b);
    for (int32_t i = 0; i < s->hood.count; ++i)
        for (int c = 0; c < 3; ++c)
            sum += pow((double)a[i][c] - (double)b[i][c], 2.0);
    return sum;
}

static double
least(const scene *s, const otx_quad *colors)
{
    double best = INFINITY;

    for (int32_t i = 0; i < s->table.count; ++i)
        best = fmin(best, distance(s, colors, s->table.pixels[i]));
    return best;
}

static void
it_is_as_near_as_the_nearest(void **state)
{
    static const otx_hood_kind kinds[] = {
        OTX_HOOD_SEED, OTX_HOOD_EXTRAPOLATE, OTX_HOOD_REFINE};

    (void)state;
    for (int k = 0; k < 6; ++k)
    {
        scene s;

        set_up(&s, kinds[k / 2], k % 2);
        assert_true(
            k % 2 ? s.table.count == SIDE * SIDE
                  : s.table.count < SIDE * SIDE && s.table.count > 400);
        for (int32_t q = 0; q < QUERIES; ++q)
        {
            otx_quad colors[OTX_HOOD_MOST];
            int32_t found;
            double nearest;

            square_of(&s, (37 * q) % (SIDE * SIDE), colors);
            for (int32_t i = 0; i < s.hood.count; ++i)
                for (int c = 0; c < 3; ++c)
                    colors[i][c] +=
                        (float)(30.0 * otx_random_unit(3, (uint32_t)q, (uint64_t)(3 * i + c)) - 15.0);
            found = otx_hood_nearest(&s.table, colors, q % 3 ? -1 : q);
            nearest = least(&s, colors);
            if (q % 3)
                assert_true(
                    distance(&s, colors, found) <= nearest * (1.0 + 1e-4));
            s.table.slack = 1.0f;
            found = otx_hood_nearest(&s.table, colors, -1);
            assert_true(distance(&s, colors, found) <= 4.0 * nearest + 1e-3);
            s.table.slack = 0.0f;
        }
        test_run_destroy(s.run);
    }
}

/* What is in the picture is found where it is. */
static void
a_copy_is_found(void **state)
{
    scene s;

    (void)state;
    set_up(&s, OTX_HOOD_REFINE, true);
    for (int32_t pixel = 0; pixel < SIDE * SIDE; pixel += 101)
    {
        otx_quad colors[OTX_HOOD_MOST];

        square_of(&s, pixel, colors);
        assert_int_equal(otx_hood_nearest(&s.table, colors, -1), pixel);
    }
    test_run_destroy(s.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_as_near_as_the_nearest),
        cmocka_unit_test(a_copy_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_difference.c -- what is integrated along the two sides of an edge. */
#include "grid.h"

#include "seam/difference.h"

static otx_seam_side
side_on(const otx_exemplar *e, const otx_image *image, otx_vec2 a, otx_vec2 b)
{
    return (otx_seam_side){
        otx_view_of(image, e->wrap_x, e->wrap_y),
        {(double)image->width / e->match.width,
         (double)image->height / e->match.height},
        {a, b}};
}

static void
one_side_twice_has_no_difference(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *e = test_exemplar_create(run->arena, 32, 16, true, 1);
    const otx_seam_side a =
        side_on(e, &e->match, (otx_vec2){1, 2}, (otx_vec2){9, 5});
    /* A whole picture away. */
    const otx_seam_side b =
        side_on(e, &e->match, (otx_vec2){33, -14}, (otx_vec2){41, -11});

    (void)state;
    assert_float_equal(otx_difference_sum(&a, &a, 9), 0.0, 0.0);
    assert_float_equal(otx_difference_sum(&a, &b, 9), 0.0, 1e-20);
    test_run_destroy(run);
}

static void
a_constant_step_is_its_own_mean_and_energy(void **state)
{
    float a[3 * 5], b[3 * 5];
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, 16, 16, true, 1);

    (void)state;
    for (int i = 0; i < 15; ++i)
    {
        a[i] = 0.25f * i;
        b[i] = a[i] + (i % 3 == 0 ? 3.0f : i % 3 == 1 ? 4.0f : 0.0f);
    }
    assert_float_equal(otx_difference(a, b), 5.0, 1e-6);
    assert_float_equal(otx_difference_mean(a, b, 5), 5.0, 1e-6);
    /* The left half is dark, the right half bright. */
    for (int i = 0; i < 3 * 16 * 16; ++i)
        e->match.pixels[i] = (i / 3) % 16 < 8 ? 0.0f : 2.0f;

    const otx_seam_side dark =
        side_on(e, &e->match, (otx_vec2){2, 2}, (otx_vec2){6, 9});
    const otx_seam_side bright =
        side_on(e, &e->match, (otx_vec2){10, 3}, (otx_vec2){14, 12});

    assert_float_equal(otx_difference_sum(&dark, &bright, 7), 7 * 12.0, 1e-9);
    test_run_destroy(run);
}

/* A coarser level is looked at through the same texel positions. */
static void
slopes_are_per_texel_of_the_exemplar(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar *e = test_exemplar_create(run->arena, 32, 32, false, 1);
    otx_image half;

    (void)state;
    for (int i = 0; i < 3 * 32 * 32; ++i)
        e->match.pixels[i] = (float)((i / 3) % 32);
    assert_int_equal(
        otx_image_halve(run, run->arena, &e->match, &half), OSDTEX_OK);
    for (int level = 0; level < 2; ++level)
    {
        const otx_seam_side side = side_on(
            e, level == 0 ? &e->match : &half, (otx_vec2){4.2, 8.3},
            (otx_vec2){20.2, 9.1});
        double color[3];
        otx_vec2 slope[3];

        otx_difference_look(&side, 0.5, color, slope);
        assert_float_equal(color[0], 12.2 - 0.5, 1e-9);
        assert_float_equal(slope[0].x, 1.0, 1e-9);
        assert_float_equal(slope[0].y, 0.0, 1e-9);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_side_twice_has_no_difference),
        cmocka_unit_test(a_constant_step_is_its_own_mean_and_energy),
        cmocka_unit_test(slopes_are_per_texel_of_the_exemplar),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_window.c -- windows are found wherever and however turned they are. */
#include "grid.h"

#include "mapping/window.h"

/* Waves of 9 to 30 texels, periodic on 96 x 96. */
static void
paint_waves(otx_image *image)
{
    for (int32_t i = 0; i < image->width * image->height; ++i)
        for (int c = 0; c < 3; ++c)
        {
            double sum = 50.0;

            for (int k = 0; k < 9; ++k)
            {
                const double a = (3 * k + c) * 7 % 11 - 5;
                const double b = (5 * k + 2 * c) * 3 % 11 - 5;
                const double x = (i % image->width + 0.5) / image->width;
                const double y = (double)(i / image->width) / image->height;

                sum += 8.0 * sin(2.0 * OTX_PI * (a * x + b * y) + k * k + c);
            }
            image->pixels[3 * (size_t)i + (size_t)c] = (float)sum;
        }
}

static otx_window_figures
look(otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar)
{
    otx_seam_list seams;
    otx_window_figures figures;

    assert_int_equal(
        otx_seam_collect(run, mapping, exemplar, &seams), OSDTEX_OK);
    assert_int_equal(
        otx_window_measure(run, mapping, exemplar, &seams, 4, &figures),
        OSDTEX_OK);
    return figures;
}

static void
turned_and_moved_interiors_are_found(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 12, 12, 0.25);
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 96, 96, true, 1);

    (void)state;
    paint_waves(&exemplar->lab);
    exemplar->lab_sigma = 30.0;
    for (int turn = 0; turn < 3; ++turn)
    {
        otx_mapping *mapping =
            test_mapping_create(run->arena, surface, exemplar, 32.0, 5.3);

        for (int32_t c = 0; c < 4 * 144; ++c)
        {
            float *uv = mapping->uvs + 2 * c;
            const otx_vec2 turned = otx_vec2_mul(
                otx_vec2_polar(1.234 * turn), (otx_vec2){uv[0], uv[1]});

            uv[0] = (float)turned.x;
            uv[1] = (float)turned.y;
        }

        const otx_window_figures figures = look(run, mapping, exemplar);

        assert_int_equal(figures.seam_count, 0);
        assert_int_equal(figures.interior_count, 4);
        assert_true(figures.seam_p50 == 0.0);
        assert_true(figures.interior_p90 < 0.03);
    }
    test_run_destroy(run);
}

static void
windows_off_the_surface_are_left_out(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 2, 2, 0.25);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 96, 96, true, 1);
    const otx_mapping *mapping =
        test_mapping_create(run->arena, surface, exemplar, 32.0, 0.0);
    const otx_window_figures figures = look(run, mapping, exemplar);

    (void)state;
    assert_int_equal(figures.interior_count, 0);
    assert_true(figures.interior_p50 == 0.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_and_moved_interiors_are_found),
        cmocka_unit_test(windows_off_the_surface_are_left_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

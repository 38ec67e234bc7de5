/* test_measure.c -- figures of mappings whose figures are known. */
#include "grid.h"

#include "mapping/measure.h"

#include <string.h>

typedef struct scene
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    otx_mapping *mapping;
} scene;

/* An 8 x 8 grid of 8-texel faces that covers a 64 x 64 exemplar once. */
static scene
scene_create(int32_t threads)
{
    scene s = {.run = test_run_create_with(NULL, threads)};

    s.surface = test_grid_create(s.run->arena, 8, 8, 0.25);
    s.exemplar = test_exemplar_create(s.run->arena, 64, 64, true, 3);
    s.mapping =
        test_mapping_create(s.run->arena, s.surface, s.exemplar, 32.0, 0.0);
    return s;
}

static otx_measure
measured(const scene *s)
{
    otx_measure m;

    assert_int_equal(
        otx_measure_run(s->run, s->mapping, s->exemplar, NULL, &m), OSDTEX_OK);
    return m;
}

static void
one_flat_chart_is_perfect(void **state)
{
    scene s = scene_create(2);
    const otx_measure m = measured(&s);

    (void)state;
    assert_float_equal(m.texels_per_unit, 32.0, 1e-9);
    assert_float_equal(m.area, 64.0 * 64.0, 1e-3);
    assert_true(m.seam_energy == 0.0 && m.seam_rms == 0.0);
    assert_true(m.seam_length == 0.0 && m.seams_per_100 == 0.0);
    assert_float_equal(m.stretch_l2_mean, 1.0, 1e-5);
    assert_float_equal(m.stretch_ratio_p95, 1.0, 1e-5);
    assert_float_equal(m.log_area_mean, 0.0, 1e-5);
    assert_float_equal(m.coverage, 1.0, 1e-6);
    assert_int_equal(m.flips, 0);
    assert_int_equal(m.folds, 0);
    assert_int_equal(m.outside, 0);
    assert_int_equal(m.uncovered, 0);
    assert_int_equal(m.patches, 1);
    test_run_destroy(s.run);
}

static void
swap_corners(otx_mapping *mapping, int32_t a, int32_t b)
{
    for (int c = 0; c < 2; ++c)
    {
        const float kept = mapping->uvs[2 * a + c];

        mapping->uvs[2 * a + c] = mapping->uvs[2 * b + c];
        mapping->uvs[2 * b + c] = kept;
    }
}

static void
mirrored_faces_are_flips_and_crossed_ones_folds(void **state)
{
    scene s = scene_create(2);
    otx_measure m;

    (void)state;
    /* Face 3 mirrored; face 5 with one corner pushed through its diagonal. */
    swap_corners(s.mapping, 12, 13);
    swap_corners(s.mapping, 14, 15);
    for (int c = 0; c < 2; ++c)
        s.mapping->uvs[2 * 20 + c] += 0.7f * 8.0f / 64.0f;
    m = measured(&s);
    assert_int_equal(m.flips, 1);
    assert_int_equal(m.folds, 1);
    test_run_destroy(s.run);
}

static void
faces_without_area_are_no_flips(void **state)
{
    scene s = scene_create(2);
    const otx_level *leaf = otx_surface_leaf(s.surface);
    const size_t numbers = 3 * (size_t)leaf->vert_count;
    const int32_t *verts = leaf->face_verts + leaf->face_first[3];
    float *points = OTX_NEW(s.run->arena, float, numbers);

    (void)state;
    swap_corners(s.mapping, 12, 13);
    swap_corners(s.mapping, 14, 15);
    assert_int_equal(measured(&s).flips, 1);
    memcpy(points, s.surface->points, numbers * sizeof *points);
    for (int c = 0; c < 3; ++c)
    {
        points[3 * verts[2] + c] = points[3 * verts[1] + c];
        points[3 * verts[3] + c] = points[3 * verts[0] + c];
    }
    s.surface->points = points;
    assert_int_equal(measured(&s).flips, 0);
    test_run_destroy(s.run);
}

static void
a_planted_step_has_its_energy(void **state)
{
    scene s = scene_create(2);
    otx_measure m;

    (void)state;
    /* Lower half of the picture 0, upper half Delta E 5; the right half of the
     * grid is moved up by half a picture. Sample positions keep clear of the
     * border between the halves but for one texel on each side of it. */
    for (int32_t i = 0; i < 64 * 64; ++i)
    {
        float *texel = s.exemplar->lab.pixels + 3 * i;

        texel[0] = i / 64 < 32 ? 0.0f : 3.0f;
        texel[1] = i / 64 < 32 ? 0.0f : 4.0f;
        texel[2] = 0.0f;
    }
    s.exemplar->lab_sigma = 10.0;
    s.exemplar->lab_step = 1.0;
    for (int32_t f = 0; f < 64; ++f)
        if (f % 8 >= 4)
        {
            s.mapping->face_patch[f] = 1;
            for (int32_t c = 4 * f; c < 4 * f + 4; ++c)
                s.mapping->uvs[2 * c + 1] += 0.5f;
        }
    s.mapping->patch_count = 2;
    m = measured(&s);
    assert_float_equal(m.seam_length, 64.0, 1e-3);
    assert_float_equal(m.seam_rms, 5.0, 1e-4);
    assert_float_equal(m.seam_p50, 5.0, 1e-4);
    assert_float_equal(m.seam_p95_sigma, 0.5, 1e-5);
    assert_float_equal(m.seam_rms_step, 5.0, 1e-4);
    assert_float_equal(m.seam_energy, 64.0 * 5.0 / 4096.0, 1e-5);
    assert_float_equal(m.seam_visible_share, 1.0, 1e-9);
    assert_float_equal(m.seam_share, 8.0 / 112.0, 1e-6);
    assert_float_equal(m.seams_per_100, 200.0 / OTX_PI * 64.0 / 4096.0, 1e-4);
    assert_int_equal(m.patches, 2);
    test_run_destroy(s.run);
}

static void
stretch_has_its_closed_form(void **state)
{
    scene s = scene_create(2);
    otx_measure m;

    (void)state;
    /* Twice as wide, half as high, and turned: area is kept. */
    for (int32_t c = 0; c < 4 * 64; ++c)
    {
        const otx_vec2 uv = otx_vec2_mul(
            otx_vec2_polar(0.7), (otx_vec2){
                                     2.0 * (double)s.mapping->uvs[2 * c],
                                     0.5 * (double)s.mapping->uvs[2 * c + 1]});

        s.mapping->uvs[2 * c] = (float)uv.x;
        s.mapping->uvs[2 * c + 1] = (float)uv.y;
    }
    m = measured(&s);
    assert_float_equal(m.stretch_l2_mean, sqrt(0.5 * (0.25 + 4.0)), 1e-4);
    assert_float_equal(m.stretch_ratio_mean, 4.0, 1e-4);
    assert_float_equal(m.stretch_ratio_p95, 4.0, 1e-4);
    assert_float_equal(m.log_area_mean, 0.0, 1e-4);
    assert_int_equal(m.flips, 0);
    test_run_destroy(s.run);
}

static void
uvs_beyond_a_border_and_missing_faces_are_counted(void **state)
{
    scene s = scene_create(2);
    otx_measure m;

    (void)state;
    s.exemplar->wrap_x = s.exemplar->wrap_y = false;
    for (int32_t c = 0; c < 4 * 64; ++c)
        s.mapping->uvs[2 * c] += 12.0f / 64.0f;
    s.mapping->face_patch[0] = -1;
    s.mapping->uvs[2 * 4 * 9] = NAN;
    m = measured(&s);
    assert_int_equal(m.outside, 16);
    assert_float_equal(m.outside_max, 12.0, 1e-4);
    assert_int_equal(m.uncovered, 2);
    test_run_destroy(s.run);
}

static void
using_a_corner_of_the_picture_is_low_coverage(void **state)
{
    scene s = scene_create(2);

    (void)state;
    for (int32_t c = 0; c < 2 * 4 * 64; ++c)
        s.mapping->uvs[c] *= 0.5f;
    assert_float_equal(measured(&s).coverage, 0.25, 1e-6);
    test_run_destroy(s.run);
}

/* Averages neighbours around the torus, so that features are a few texels
 * wide as in a photograph. */
static void
smooth(otx_run *run, otx_image *image, int32_t rounds)
{
    const int32_t w = image->width, h = image->height;
    otx_image old = *image;

    old.pixels = OTX_NEW(run->arena, float, 3 * w * h);
    for (int32_t round = 0; round < rounds; ++round)
    {
        memcpy(old.pixels, image->pixels, sizeof(float) * 3 * w * h);
        for (int32_t i = 0; i < w * h; ++i)
            for (int c = 0; c < 3; ++c)
            {
                const int32_t x = i % w, y = i / w;

                otx_image_at(image, x, y)[c] =
                    0.2f * (otx_image_at(&old, x, y)[c] +
                            otx_image_at(&old, (x + 1) % w, y)[c] +
                            otx_image_at(&old, (x + w - 1) % w, y)[c] +
                            otx_image_at(&old, x, (y + 1) % h)[c] +
                            otx_image_at(&old, x, (y + h - 1) % h)[c]);
            }
    }
}

/* RMS distance of texels half a picture apart. */
static double
sigma_of(const otx_image *image)
{
    const int32_t half = image->width * image->height / 2;
    double sum = 0.0;

    for (int32_t i = 0; i < 3 * half; ++i)
    {
        const double d = (double)image->pixels[i] - image->pixels[i + 3 * half];

        sum += d * d;
    }
    return sqrt(sum / half);
}

static void
windows_tell_broken_structure_from_whole(void **state)
{
    scene s = {.run = test_run_create()};
    const otx_measure_options options = {.window_count = 6};
    otx_measure m;

    (void)state;
    s.surface = test_grid_create(s.run->arena, 16, 12, 0.25);
    s.exemplar = test_exemplar_create(s.run->arena, 128, 96, true, 8);
    smooth(s.run, &s.exemplar->lab, 12);
    s.exemplar->lab_sigma = sigma_of(&s.exemplar->lab);
    s.mapping =
        test_mapping_create(s.run->arena, s.surface, s.exemplar, 32.0, 0.0);
    for (int32_t f = 0; f < 16 * 12; ++f)
        if (f % 16 >= 8)
            for (int32_t c = 4 * f; c < 4 * f + 4; ++c)
                s.mapping->uvs[2 * c + 1] += 0.37f;
    assert_int_equal(
        otx_measure_run(s.run, s.mapping, s.exemplar, &options, &m), OSDTEX_OK);
    assert_true(m.windows > 3);
    assert_true(m.window_interior_p90 < 0.02);
    /* Half of the window is found, the other half is a random pair. */
    assert_true(m.window_seam_p50 > 0.4 && m.window_seam_p50 < 0.9);
    test_run_destroy(s.run);
}

static void
threads_do_not_change_the_figures(void **state)
{
    const otx_measure_options options = {.window_count = 3};
    otx_measure first, other;

    (void)state;
    for (int32_t threads = 1; threads <= 8; threads *= 2)
    {
        scene s = scene_create(threads);

        for (int32_t c = 0; c < 2 * 4 * 24; ++c)
            s.mapping->uvs[c] += 0.31f;
        memset(&other, 0, sizeof other);
        assert_int_equal(
            otx_measure_run(s.run, s.mapping, s.exemplar, &options, &other),
            OSDTEX_OK);
        if (threads == 1)
            first = other;
        assert_true(
            first.seam_energy == other.seam_energy &&
            first.seam_rms == other.seam_rms &&
            first.window_seam_p50 == other.window_seam_p50 &&
            first.window_seam_p90 == other.window_seam_p90 &&
            first.stretch_l2_mean == other.stretch_l2_mean &&
            first.coverage == other.coverage);
        assert_true(other.seam_energy > 0.0);
        test_run_destroy(s.run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_flat_chart_is_perfect),
        cmocka_unit_test(mirrored_faces_are_flips_and_crossed_ones_folds),
        cmocka_unit_test(faces_without_area_are_no_flips),
        cmocka_unit_test(a_planted_step_has_its_energy),
        cmocka_unit_test(stretch_has_its_closed_form),
        cmocka_unit_test(uvs_beyond_a_border_and_missing_faces_are_counted),
        cmocka_unit_test(using_a_corner_of_the_picture_is_low_coverage),
        cmocka_unit_test(windows_tell_broken_structure_from_whole),
        cmocka_unit_test(threads_do_not_change_the_figures),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_exhaust.c -- the Fourier transform finds what brute force finds. */
#include "scene.h"

#include "match/exhaust.h"

#include <stdlib.h>

enum
{
    MAX_PIXELS = 4096
};

/* --------------------------------------------- Fourier against brute force */

typedef struct pixels
{
    const otx_plane *plane;
    int32_t count;
    int32_t x[MAX_PIXELS], y[MAX_PIXELS];
    float color[MAX_PIXELS][OTX_PLANE_LANES];
} pixels;

static void
collect_pixels(void *context, const otx_mask_span *span)
{
    pixels *p = context;
    const otx_plane *plane = p->plane;

    for (int32_t n = 0; n < span->count; ++n)
    {
        const double x =
            (span->source.x + n * span->source_step.x) / plane->pixel.x;
        const double y =
            (span->source.y + n * span->source_step.y) / plane->pixel.y;

        assert_true(p->count < MAX_PIXELS);
        p->x[p->count] = span->x + n;
        p->y[p->count] = span->y;
        otx_plane_sample(
            plane, otx_plane_wrap(x, plane->width, plane->wrap_x),
            otx_plane_wrap(y, plane->height, plane->wrap_y),
            p->color[p->count++]);
    }
}

/* Mean square over the pixels, moved by (dx, dy); beyond the rim of what does
 * not tile is the mean, 0, which costs something besides. */
static double
direct_error(const pixels *p, int32_t dx, int32_t dy)
{
    double sum = 0.0;

    for (int32_t n = 0; n < p->count; ++n)
    {
        static const float mean[OTX_PLANE_LANES] = {0};
        const otx_plane *plane = p->plane;
        const int32_t x = p->x[n] + dx, y = p->y[n] + dy;
        const bool beyond = otx_plane_ends(x, plane->width, plane->wrap_x) ||
                            otx_plane_ends(y, plane->height, plane->wrap_y);
        const float *t =
            beyond ? mean
                   : otx_plane_at(
                         plane, otx_view_fold(x, plane->width, plane->wrap_x),
                         otx_view_fold(y, plane->height, plane->wrap_y));

        sum += beyond ? plane->beyond : 0.0;
        for (int k = 0; k < 3; ++k)
            sum += (double)(p->color[n][k] - t[k]) *
                   (double)(p->color[n][k] - t[k]);
    }
    return sum / p->count;
}

static void
check_map(int32_t width, int32_t height, bool wrap, int32_t level, double cell)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, width, height);
    otx_matcher *matcher = scene_matcher(run, &image, wrap);
    const otx_plane *plane = &matcher->planes[level];
    const double angles[3] = {0.0, 0.5, 2.8};
    const double bound = 1e-4 * matcher->sigma * matcher->sigma;
    otx_match_query query = otx_match_query_defaults(angles, 3);
    otx_exhaust_buffers buffers;
    pixels *p = OTX_NEW(run->arena, pixels, 1);
    scene_mask scene;

    query.overhang = true;
    /* The source differs from every placement that is searched. */
    scene_mask_make(
        &scene, (otx_vec2){-3.0, 5.0}, cell, 1.9,
        (otx_vec2){0.5 * width, 0.4 * height});
    assert_int_equal(
        otx_exhaust_buffers_create(run->arena, plane, &query, &buffers),
        OSDTEX_OK);
    for (int a = 0; a < 3; ++a)
    {
        const otx_mask_frame frame = {
            .rotation = otx_vec2_polar(angles[a]), .pixel = plane->pixel};
        const otx_matcher_range range =
            otx_matcher_shifts(matcher, &scene.mask, &query, angles[a]);
        int compared = 0;

        p->plane = plane;
        p->count = 0;
        otx_mask_draw(&scene.mask, &frame, collect_pixels, p);
        const otx_exhaust_sums sums =
            otx_exhaust_map(plane, &scene.mask, angles[a], &buffers);

        assert_true(fabs(sums.weight - p->count) < 1e-6);
        for (int32_t y = 0; y < plane->fft_height; ++y)
            for (int32_t x = 0; x < plane->fft_width; ++x)
            {
                const int32_t dx = x - sums.base_x;
                const int32_t dy = y - sums.base_y;
                const otx_vec2 shift = {
                    dx * plane->pixel.x, dy * plane->pixel.y};
                const double value =
                    (sums.energy +
                     (double)buffers.map
                         [(size_t)y * otx_fft_stride(plane->fft) + (size_t)x]) /
                    sums.weight;

                if (!otx_matcher_allows(&range, shift))
                    continue;
                assert_true(fabs(value - direct_error(p, dx, dy)) < bound);
                ++compared;
            }
        assert_true(compared > 0);
    }
    test_run_destroy(run);
}

static void
fourier_equals_brute_force(void **state)
{
    (void)state;
    check_map(48, 48, true, 0, 3.0);
    check_map(37, 41, true, 0, 2.3);
    check_map(45, 33, true, 1, 3.7);
    check_map(48, 48, false, 0, 3.0);
    check_map(61, 53, false, 0, 3.1);
    check_map(61, 53, false, 1, 4.0);
}

/* Larger than the exemplar: folded, and still the sum over all its texels. */
static void
a_mask_larger_than_the_tile_is_folded(void **state)
{
    (void)state;
    check_map(24, 20, true, 0, 7.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fourier_equals_brute_force),
        cmocka_unit_test(a_mask_larger_than_the_tile_is_folded),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

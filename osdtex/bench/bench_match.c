/* bench_match.c -- see bench_match.h.
 *
 * The floor is 19 x (4 forward + 1 inverse) of FFTW's own two-dimensional real
 * transforms, planned with FFTW_ESTIMATE like ours: what the search would cost
 * if drawing masks, products and looking for minima were free, and no row of
 * the mask were known to be empty. One thread for both. */
#include "bench/bench_match.h"

#include "base/random.h"
#include "match/exhaust.h"

#include <fftw3.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum
{
    ORIENTATIONS = 19,
    TRIANGLES = 2 * 4 * 24
};

/* Time of the processor for what runs in one thread, so that a busy machine
 * does not distort the ratio; time of the wall for what runs in two. */
static double
now_ms(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* ---------------------------------------------------------------- scene */

/* Smooth blobs of several sizes, tiling. */
static void
fill_exemplar(otx_image *image)
{
    const int32_t n = image->width;

    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            for (int32_t c = 0; c < 3; ++c)
            {
                double sum = 0.0;

                for (int32_t cell = 4; cell <= 16; cell *= 2)
                {
                    const int32_t i = x / cell, j = y / cell;
                    const double u = (double)(x % cell) / cell;
                    const double v = (double)(y % cell) / cell;
                    double corner[2][2];

                    for (int32_t k = 0; k < 4; ++k)
                        corner[k / 2][k % 2] = otx_random_unit(
                            (uint64_t)cell, (uint32_t)c,
                            (uint64_t)((j + k / 2) % (n / cell) * n + (i + k % 2) % (n / cell)));
                    sum +=
                        (1 - v) * ((1 - u) * corner[0][0] + u * corner[0][1]) +
                        v * ((1 - u) * corner[1][0] + u * corner[1][1]);
                }
                otx_image_at(image, x, y)[c] = (float)(sum / 3.0);
            }
}

/* A collar a quarter of the exemplar wide around an empty square, `width`
 * texels thick: 24 quads on each side, textured from two places. */
static void
fill_mask(otx_mask_triangle *triangles, double size, double width)
{
    int32_t count = 0;

    for (int32_t side = 0; side < 4; ++side)
        for (int32_t k = 0; k < 24; ++k)
            for (int32_t half = 0; half < 2; ++half)
            {
                static const double corners[2][3][2] = {
                    {{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
                otx_mask_triangle *t = &triangles[count++];

                for (int c = 0; c < 3; ++c)
                {
                    const otx_vec2 p = {
                        -0.5 * size +
                            (size - width) * (k + corners[half][c][0]) / 24.0,
                        -0.5 * size + width * corners[half][c][1]};

                    t->flat[c] =
                        otx_vec2_mul(otx_vec2_polar(0.5 * OTX_PI * side), p);
                    t->source[c] = otx_vec2_add(
                        otx_vec2_mul(
                            otx_vec2_polar(side < 2 ? 0.3 : 2.2), t->flat[c]),
                        (otx_vec2){1.3 * size, side < 2 ? 0.4 : size});
                    t->weight[c] = 1.0f;
                }
            }
}

/* ---------------------------------------------------------------- floor */

static double
time_floor(int32_t n, int32_t repeats)
{
    const size_t complex_count = (size_t)n * ((size_t)n / 2 + 1);
    float *real[4], *map = fftwf_alloc_real((size_t)n * (size_t)n);
    fftwf_complex *spectrum[4];
    fftwf_plan forward[4], inverse;
    const clockid_t clock = CLOCK_THREAD_CPUTIME_ID;
    double best = INFINITY;

    for (int p = 0; p < 4; ++p)
    {
        real[p] = fftwf_alloc_real((size_t)n * (size_t)n);
        spectrum[p] = fftwf_alloc_complex(complex_count);
        memset(real[p], 0, (size_t)n * (size_t)n * sizeof(float));
        forward[p] =
            fftwf_plan_dft_r2c_2d(n, n, real[p], spectrum[p], FFTW_ESTIMATE);
    }
    inverse = fftwf_plan_dft_c2r_2d(n, n, spectrum[0], map, FFTW_ESTIMATE);
    for (int32_t r = 0; r < repeats; ++r)
    {
        const double start = now_ms(clock);

        for (int a = 0; a < ORIENTATIONS; ++a)
        {
            for (int p = 0; p < 4; ++p)
                fftwf_execute(forward[p]);
            fftwf_execute(inverse);
        }
        best = fmin(best, now_ms(clock) - start);
    }
    for (int p = 0; p < 4; ++p)
    {
        fftwf_destroy_plan(forward[p]);
        fftwf_free(real[p]);
        fftwf_free(spectrum[p]);
    }
    fftwf_destroy_plan(inverse);
    fftwf_free(map);
    return best;
}

/* ---------------------------------------------------------------- bench */

typedef struct scene
{
    otx_run run;
    otx_matcher *matcher;
    otx_mask_triangle triangles[TRIANGLES];
    otx_mask mask;
    double angles[ORIENTATIONS];
} scene;

static void
scene_close(scene *s)
{
    otx_heap *heap = s->run.heap;

    otx_arena_destroy(s->run.scratch);
    otx_arena_destroy(s->run.arena);
    otx_pool_destroy(s->run.pool);
    otx_diagnostics_destroy(s->run.diagnostics);
    otx_heap_destroy(heap);
}

static otx_status
scene_open(scene *s, int32_t n)
{
    otx_heap *heap = otx_heap_create(NULL);
    otx_image image = {n, n, 3, NULL};

    *s = (scene){
        .run = {
            .heap = heap,
            .arena = otx_arena_create(heap),
            .scratch = otx_arena_create(heap),
            .pool = otx_pool_create(heap, 2),
            .diagnostics = otx_diagnostics_create(heap)}};
    image.pixels = OTX_NEW(s->run.arena, float, (size_t)n *(size_t)n * 3);
    if (!image.pixels)
        return OSDTEX_ERROR_MEMORY;
    fill_exemplar(&image);
    fill_mask(s->triangles, 0.45 * n, 0.1 * n);
    s->mask = (otx_mask){s->triangles, TRIANGLES};
    for (int a = 0; a < ORIENTATIONS; ++a)
        s->angles[a] = 0.11 + 2.0 * OTX_PI * a / ORIENTATIONS;
    return otx_matcher_create(&s->run, &image, true, true, 0.3, 0, &s->matcher);
}

/* Best of `repeats`; `threads` 1 is the serial search. */
static double
time_search(
    scene *s, int32_t levels, bool threads, int32_t repeats, otx_match *best)
{
    otx_match_query query = otx_match_query_defaults(s->angles, ORIENTATIONS);
    const clockid_t clock = threads ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
    double fastest = INFINITY;
    int32_t count;

    query.coarse_levels = levels;
    for (int32_t r = 0; r < repeats; ++r)
    {
        const double start = now_ms(clock);
        const otx_status status =
            threads
                ? otx_matcher_search(
                      &s->run, s->matcher, &s->mask, &query, best, 1, &count)
                : otx_matcher_search_serial(
                      s->run.scratch, s->matcher, &s->mask, &query, best, 1,
                      &count);

        if (status != OSDTEX_OK || count != 1)
            return NAN;
        fastest = fmin(fastest, now_ms(clock) - start);
    }
    return fastest;
}

static int
bench_size(int32_t n, int32_t repeats)
{
    scene s;
    otx_match exact, coarse, coarser;
    int failed = scene_open(&s, n) != OSDTEX_OK;

    if (!failed)
    {
        const double floor_ms = time_floor(n, repeats);
        const double full = time_search(&s, 0, false, repeats, &exact);
        const double full2 = time_search(&s, 0, true, repeats, &exact);
        const double half = time_search(&s, 1, false, repeats, &coarse);
        const double half2 = time_search(&s, 1, true, repeats, &coarse);
        const double quarter = time_search(&s, 2, false, repeats, &coarser);

        failed = !(full + full2 + half + half2 + quarter > 0.0);
        printf(
            "%5d %9.2f %9.2f %6.2f %9.2f %9.2f %9.2f %9.2f   %.4f %.4f %.4f\n",
            n, floor_ms, full, full / floor_ms, full2, half, half2, quarter,
            exact.error, coarse.error, coarser.error);
    }
    scene_close(&s);
    return failed;
}

/* --------------------------------------------------------------- verify */

/* Mean square of one whole-texel placement by the definition; the drawing of
 * the mask is shared with the search, the sums are not. */
static double
largest_deviation(scene *s, double angle)
{
    const otx_plane *plane = &s->matcher->planes[0];
    otx_exhaust_buffers buffers;
    double largest = 0.0;

    if (otx_exhaust_buffers_create(s->run.arena, plane, &buffers) != OSDTEX_OK)
        return INFINITY;
    const otx_exhaust_sums sums =
        otx_exhaust_map(plane, &s->mask, angle, &buffers);

    for (uint64_t k = 0; k < 200; ++k)
    {
        const int32_t x = (int32_t)(otx_random_unit(1, 1, k) * plane->width);
        const int32_t y = (int32_t)(otx_random_unit(1, 2, k) * plane->height);
        const otx_match placement = {
            .angle = angle, .shift = {x - sums.base_x, y - sums.base_y}};
        const double value =
            (sums.energy +
             (double)buffers
                 .map[(size_t)y * otx_fft_stride(plane->fft) + (size_t)x]) /
            sums.weight;

        largest = fmax(
            largest,
            fabs(value - otx_matcher_square(s->matcher, &s->mask, &placement)));
    }
    return largest / (s->matcher->sigma * s->matcher->sigma);
}

static int
verify_size(int32_t n)
{
    scene s;
    double largest = INFINITY;

    if (scene_open(&s, n) == OSDTEX_OK)
    {
        largest = 0.0;
        for (int a = 0; a < ORIENTATIONS; ++a)
            largest = fmax(largest, largest_deviation(&s, s.angles[a]));
    }
    scene_close(&s);
    printf("match %d: FFT - direct <= %.2g sigma^2\n", n, largest);
    return !(largest < 1e-4);
}

int
bench_match(int verify)
{
    static const int32_t sizes[] = {128, 256, 480, 512};
    int failed = 0;

    if (!verify)
        printf(
            "match: ms for %d orientations (x: to floor; 2t: two threads,"
            " wall)\n"
            "%5s %9s %9s %6s %9s %9s %9s %9s   %s\n",
            ORIENTATIONS, "size", "floor", "full", "x", "full 2t", "half",
            "half 2t", "quarter", "errors");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
        failed |= verify ? verify_size(sizes[i]) : bench_size(sizes[i], 15);
    return failed;
}

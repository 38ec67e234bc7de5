/* bench_match.c -- the masked search against the transforms it is made of.
 *
 * The floor is 19 x (4 forward + 1 inverse) of FFTW's own two-dimensional real
 * transforms, planned with FFTW_ESTIMATE like ours: what the search would cost
 * if drawing masks, products and looking for minima were free, and no row of
 * the mask were known to be empty. */
#include "bench/bench_row.h"
#include "bench/match_scene.h"
#include "bench/stopwatch.h"

#include "base/random.h"
#include "match/exhaust.h"

#include <fftw3.h>
#include <stdio.h>
#include <string.h>

enum
{
    PLANES = 4,
    USUAL_TURNS = 9,
    LANES = 6
};

static const int32_t SIZES[] = {128, 256, 480, 512};

enum
{
    SIZE_COUNT = sizeof SIZES / sizeof SIZES[0]
};

/* -- floor --------------------------------------------------------------- */

typedef struct transforms
{
    float *real[PLANES], *map;
    fftwf_complex *spectrum[PLANES];
    fftwf_plan forward[PLANES], inverse;
} transforms;

static void
transforms_open(transforms *t, int32_t n)
{
    const size_t reals = (size_t)n * (size_t)n;
    const size_t complexes = (size_t)n * ((size_t)n / 2 + 1);

    t->map = fftwf_alloc_real(reals);
    for (int p = 0; p < PLANES; ++p)
    {
        t->real[p] = fftwf_alloc_real(reals);
        t->spectrum[p] = fftwf_alloc_complex(complexes);
        memset(t->real[p], 0, reals * sizeof(float));
        t->forward[p] = fftwf_plan_dft_r2c_2d(
            n, n, t->real[p], t->spectrum[p], FFTW_ESTIMATE);
    }
    t->inverse =
        fftwf_plan_dft_c2r_2d(n, n, t->spectrum[0], t->map, FFTW_ESTIMATE);
}

static void
transforms_close(transforms *t)
{
    for (int p = 0; p < PLANES; ++p)
    {
        fftwf_destroy_plan(t->forward[p]);
        fftwf_free(t->real[p]);
        fftwf_free(t->spectrum[p]);
    }
    fftwf_destroy_plan(t->inverse);
    fftwf_free(t->map);
}

static otx_status
run_transforms(void *context)
{
    const transforms *t = context;

    for (int a = 0; a < BENCH_ORIENTATIONS; ++a)
    {
        for (int p = 0; p < PLANES; ++p)
            fftwf_execute(t->forward[p]);
        fftwf_execute(t->inverse);
    }
    return OSDTEX_OK;
}

/* -- searches ------------------------------------------------------------ */

typedef struct fit
{
    bench_match_scene *scene;
    int32_t levels; /* halvings of the exhaustive search */
    bool threads;   /* over the pool, else in this thread */
    otx_match best;
} fit;

static otx_status
run_fit(void *context)
{
    fit *f = context;
    bench_match_scene *s = f->scene;
    otx_match_query query =
        otx_match_query_defaults(s->angles, BENCH_ORIENTATIONS);
    otx_worker alone = {.scratch = s->run.scratch};
    int32_t count = 0;

    query.coarse_levels = f->levels;
    OTX_TRY(
        f->threads
            ? otx_matcher_search(
                  &s->run, s->matcher, &s->mask, &query, &f->best, 1, &count)
            : otx_matcher_search_within(
                  &alone, s->matcher, &s->mask, &query, &f->best, 1, &count));
    return count == 1 ? OSDTEX_OK : OSDTEX_ERROR_NUMERIC;
}

static bool
time_size(int32_t n, const bench_options *options, bench_report *report)
{
    transforms floor;
    bench_match_scene s;
    fit fits[LANES - 1] = {
        {.scene = &s, .levels = 0}, {.scene = &s, .levels = 0, .threads = true},
        {.scene = &s, .levels = 1}, {.scene = &s, .levels = 1, .threads = true},
        {.scene = &s, .levels = 2},
    };
    bench_lane lanes[LANES] = {{.body = run_transforms, .context = &floor}};
    otx_status status;
    char label[16];

    if (bench_match_scene_open(&s, n, options->threads) != OSDTEX_OK)
        return false;
    transforms_open(&floor, n);
    for (int l = 1; l < LANES; ++l)
        lanes[l] = (bench_lane){.body = run_fit, .context = &fits[l - 1]};
    status = bench_stopwatch_race(
        lanes, LANES, bench_row_repeat(options, USUAL_TURNS));
    if (status == OSDTEX_OK)
    {
        const double values[] = {
            1e3 * lanes[0].best.cpu,
            1e3 * lanes[1].best.cpu,
            lanes[1].best.cpu / lanes[0].best.cpu,
            lanes[1].median.cpu / lanes[0].median.cpu,
            1e3 * lanes[2].best.wall,
            1e3 * lanes[3].best.cpu,
            1e3 * lanes[4].best.wall,
            1e3 * lanes[5].best.cpu,
            fits[2].best.error / fits[0].best.error,
            fits[4].best.error / fits[0].best.error,
        };

        snprintf(label, sizeof label, "%d", n);
        bench_report_row(report, label, values);
    }
    transforms_close(&floor);
    bench_match_scene_close(&s);
    return status == OSDTEX_OK;
}

static bool
time_match(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "size",
        "floor",
        "full",
        "full / floor",
        "same, median",
        "full, wall N",
        "half",
        "half, wall N",
        "quarter",
        "error of half / full",
        "of quarter / full",
        NULL};
    bool right = true;

    bench_report_begin(
        report,
        "match: one fit over 19 orientations, ms of one core (wall N: elapsed "
        "with all threads)",
        columns);
    for (int i = 0; i < SIZE_COUNT; ++i)
        right = right && time_size(SIZES[i], options, report);
    return right;
}

/* -- verification -------------------------------------------------------- */

/* Largest difference between the map of one angle and direct sums at 200
 * translations, in sigma squared. Drawing the mask is shared, sums are not. */
static double
largest_deviation(bench_match_scene *s, double angle)
{
    const otx_plane *plane = &s->matcher->planes[0];
    const otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_exhaust_buffers buffers;
    double largest = 0.0;

    if (otx_exhaust_buffers_create(s->run.arena, plane, &query, &buffers) !=
        OSDTEX_OK)
        return INFINITY;
    const otx_exhaust_sums sums =
        otx_exhaust_map(plane, &s->mask, angle, &buffers);

    for (uint64_t k = 0; k < 200; ++k)
    {
        const int32_t x = (int32_t)(otx_random_unit(1, 1, k) * plane->width);
        const int32_t y = (int32_t)(otx_random_unit(1, 2, k) * plane->height);
        const otx_match placement = {
            .angle = angle, .shift = {x - sums.base_x, y - sums.base_y}};
        const size_t at = (size_t)y * otx_fft_stride(plane->fft) + (size_t)x;
        const double value =
            (sums.energy + (double)buffers.map[at]) / sums.weight;

        largest = fmax(
            largest,
            fabs(value - otx_matcher_square(s->matcher, &s->mask, &placement)));
    }
    return largest / (s->matcher->sigma * s->matcher->sigma);
}

static bool
verify_match(const bench_options *options)
{
    bool right = true;

    for (int i = 0; i < SIZE_COUNT; ++i)
    {
        bench_match_scene s;
        double largest = 0.0;

        if (bench_match_scene_open(&s, SIZES[i], options->threads) != OSDTEX_OK)
            return false;
        for (int a = 0; a < BENCH_ORIENTATIONS; ++a)
            largest = fmax(largest, largest_deviation(&s, s.angles[a]));
        bench_match_scene_close(&s);
        right &= bench_row_check(
            largest < 1e-4,
            "match %d: FFT and direct sums differ by %.2g sigma^2", SIZES[i],
            largest);
    }
    return right;
}

const bench_row bench_row_match = {
    .name = "match",
    .summary = "One fit over 19 orientations against the bare FFTW "
               "transforms of the same job.",
    .time = time_match,
    .verify = verify_match,
};

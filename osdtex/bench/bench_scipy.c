/* bench_scipy.c -- the exhaustive search against scipy's FFT.
 *
 * tools/bench-scipy.py gets the exemplar and, for every orientation, the mask
 * as it is drawn here (weighted colours and weights), and looks for the best
 * translation as a numpy program would: spectra of the exemplar once, then four
 * forward and one inverse transform and an argmin for each orientation. Drawing
 * is not in its time, and is in ours. Both in single precision, both with one
 * thread and with all. The best match must be the same. */
#include "bench/bench_row.h"
#include "bench/match_scene.h"
#include "bench/stopwatch.h"

#include "image/view.h"
#include "match/mask.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum
{
    CHANNELS = 3,
    PLANES = CHANNELS + 1,
    USUAL_TURNS = 5
};

static const char SCRIPT[] = "tools/bench-scipy.py";
static const int32_t SIZES[] = {256, 512};

/* -- what the script is given -------------------------------------------- */

typedef struct drawing
{
    const bench_match_scene *scene;
    float *planes; /* [PLANES * n * n] */
    int32_t base_x, base_y;
} drawing;

static int32_t
fold(int32_t x, int32_t n)
{
    return (x % n + n) % n;
}

static void
draw_span(void *context, const otx_mask_span *span)
{
    const drawing *d = context;
    const int32_t n = d->scene->size;
    const size_t area = (size_t)n * (size_t)n;

    for (int32_t i = 0; i < span->count; ++i)
    {
        const size_t at = (size_t)fold(span->y - d->base_y, n) * (size_t)n +
                          (size_t)fold(span->x + i - d->base_x, n);
        const otx_vec2 source =
            otx_vec2_add(span->source, otx_vec2_scale(i, span->source_step));
        float color[CHANNELS];

        otx_view_value(
            otx_view_of(&d->scene->image, true, true), source, color);
        for (int c = 0; c < CHANNELS; ++c)
            d->planes[(size_t)c * area + at] += color[c];
        d->planes[CHANNELS * area + at] += 1.0f;
    }
}

/* n, channels, angles; the exemplar; for each angle base x, base y, planes. */
static bool
write_problem(const bench_match_scene *s, FILE *file)
{
    const int32_t head[] = {s->size, CHANNELS, BENCH_ORIENTATIONS};
    const size_t area = (size_t)s->size * (size_t)s->size;
    float *planes = malloc(PLANES * area * sizeof *planes);
    bool written =
        planes && fwrite(head, sizeof head, 1, file) == 1 &&
        fwrite(s->image.pixels, CHANNELS * sizeof(float), area, file) == area;

    for (int a = 0; a < BENCH_ORIENTATIONS && written; ++a)
    {
        const otx_mask_frame frame = {
            .rotation = otx_vec2_polar(s->angles[a]), .pixel = {1.0, 1.0}};
        const otx_mask_box box = otx_mask_bounds(&s->mask, &frame);
        drawing d = {
            s, planes, (int32_t)floor(box.low.x), (int32_t)floor(box.low.y)};
        const int32_t base[] = {d.base_x, d.base_y};

        memset(planes, 0, PLANES * area * sizeof *planes);
        otx_mask_draw(&s->mask, &frame, draw_span, &d);
        written = fwrite(base, sizeof base, 1, file) == 1 &&
                  fwrite(planes, PLANES * sizeof *planes, area, file) == area;
    }
    free(planes);
    return written;
}

/* -- what it answers ----------------------------------------------------- */

/* The script's JSON; NULL when it did not run. */
static json_t *
run_script(const char *problem, int32_t turns, int32_t threads)
{
    char command[512];
    json_t *answer;
    FILE *pipe;

    snprintf(
        command, sizeof command, "/usr/bin/python3 %s '%s' %d %d", SCRIPT,
        problem, turns, threads);
    pipe = popen(command, "r");
    if (!pipe)
        return NULL;
    answer = json_loadf(pipe, 0, NULL);
    if (pclose(pipe) == 0)
        return answer;
    json_decref(answer);
    return NULL;
}

static json_t *
ask_script(const bench_match_scene *s, const bench_options *options)
{
    char path[] = "/tmp/osdtex-bench-XXXXXX";
    const int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
    json_t *answer = NULL;
    bool written;

    if (!file)
        return NULL;
    written = write_problem(s, file);
    if (fclose(file) == 0 && written)
        answer = run_script(
            path, bench_row_repeat(options, USUAL_TURNS), options->threads);
    unlink(path);
    return answer;
}

static double
number(const json_t *answer, const char *key)
{
    const json_t *value = json_object_get(answer, key);

    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* -- ours ---------------------------------------------------------------- */

typedef struct fit
{
    bench_match_scene *scene;
    bool threads;
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

    query.coarse_levels = 0;
    OTX_TRY(
        f->threads
            ? otx_matcher_search(
                  &s->run, s->matcher, &s->mask, &query, &f->best, 1, &count)
            : otx_matcher_search_within(
                  &alone, s->matcher, &s->mask, &query, &f->best, 1, &count));
    return count == 1 ? OSDTEX_OK : OSDTEX_ERROR_NUMERIC;
}

/* Whether both chose the same angle and the same texel, modulo the period. */
static bool
is_same(
    const bench_match_scene *s, const otx_match *match, const json_t *answer)
{
    const int angle = (int)number(answer, "angle");
    const double dx = match->shift.x - number(answer, "x");
    const double dy = match->shift.y - number(answer, "y");

    return angle >= 0 && angle < BENCH_ORIENTATIONS &&
           s->angles[angle] == match->angle &&
           fabs(remainder(dx, s->size)) < 1e-6 &&
           fabs(remainder(dy, s->size)) < 1e-6;
}

static bool
can_run(void)
{
    if (access(SCRIPT, R_OK) != 0)
        bench_report_note(
            "scipy: skipped, %s is not here; start from the folder of the "
            "project",
            SCRIPT);
    else if (
        system("/usr/bin/python3 -c 'import numpy, scipy.fft' "
               "2>/dev/null") != 0)
        bench_report_note(
            "scipy: skipped, python3-numpy or python3-scipy is not installed");
    else
        return true;
    return false;
}

static bool
time_size(int32_t n, const bench_options *options, bench_report *report)
{
    bench_match_scene s;
    fit fits[2] = {{.scene = &s}, {.scene = &s, .threads = true}};
    bench_lane lanes[2] = {
        {.body = run_fit, .context = &fits[0]},
        {.body = run_fit, .context = &fits[1]}};
    json_t *answer;
    bool right;
    char label[16];

    if (bench_match_scene_open(&s, n, options->threads) != OSDTEX_OK)
        return false;
    answer = ask_script(&s, options);
    right = answer &&
            bench_stopwatch_race(
                lanes, 2, bench_row_repeat(options, USUAL_TURNS)) == OSDTEX_OK;
    if (right)
    {
        const double values[] = {
            1e3 * number(answer, "cpu"),
            1e3 * lanes[0].best.cpu,
            number(answer, "cpu") / lanes[0].best.cpu,
            1e3 * number(answer, "wall"),
            1e3 * lanes[1].best.wall,
            number(answer, "wall") / lanes[1].best.wall,
            is_same(&s, &fits[0].best, answer),
        };

        snprintf(label, sizeof label, "%d", n);
        bench_report_row(report, label, values);
    }
    json_decref(answer);
    bench_match_scene_close(&s);
    return right;
}

static bool
time_scipy(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "size",
        "scipy, cpu ms",
        "ours, cpu ms",
        "scipy / ours",
        "scipy, wall N",
        "ours, wall N",
        "scipy / ours, wall",
        "same match",
        NULL};
    bool right = true;

    if (!can_run())
        return true;
    bench_report_begin(
        report,
        "scipy: one fit over 19 orientations at full resolution (cpu: one "
        "thread; wall N: all threads, workers=N)",
        columns);
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; ++i)
        right = right && time_size(SIZES[i], options, report);
    return right;
}

static bool
verify_scipy(const bench_options *options)
{
    bench_match_scene s;
    fit one = {.scene = &s};
    json_t *answer;
    bool right;

    if (!can_run())
        return true;
    if (bench_match_scene_open(&s, SIZES[0], options->threads) != OSDTEX_OK)
        return false;
    answer = ask_script(&s, options);
    right =
        answer && run_fit(&one) == OSDTEX_OK && is_same(&s, &one.best, answer);
    json_decref(answer);
    bench_match_scene_close(&s);
    return bench_row_check(right, "scipy: the same best match at %d", SIZES[0]);
}

const bench_row bench_row_scipy = {
    .name = "scipy",
    .summary = "The same fit at full resolution against scipy's FFT; skipped "
               "where scipy is not installed.",
    .time = time_scipy,
    .verify = verify_scipy,
};

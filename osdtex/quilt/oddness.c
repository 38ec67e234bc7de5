/* oddness.c -- little windows, and how far the nearest like them is.
 *
 * At full size and at half, where pictures have up to about 512 texels a side,
 * larger ones accordingly: windows of eight texels then are as wide as a joint
 * or a pebble, and see one that ends or grows together. At a quarter they are
 * as wide as a course, and see one that meets another; fused stones they do not
 * see, nor do medians, which see that most of a cut is good. */
#include "quilt/oddness.h"

#include "base/sort.h"
#include "quilt/window_search.h"

#include <stdlib.h>

enum
{
    SIDE = 8, /* of a window */
    PROBES = 96,
    PLACES = 8000, /* that are compared with, about */
    USUAL_SIDE = 512,
    MIN_SIDE = 3 * SIDE
};

static const double QUANTILE = 0.9;

/* RMS Lab distance that nobody sees; pictures may repeat exactly. */
static const double UNSEEN = 0.5;

/* Windows of `image`, each with how far it is from all of `source`. */
typedef struct survey
{
    const otx_image *image;
    const otx_image *source;
    bool own; /* the windows are the source's: not beside themselves */
    int32_t stride;
    int32_t count;
    int32_t places[PROBES]; /* y * width + x */
    double found[PROBES];
} survey;

/* Squared distance of two windows, or more than `limit`. */
static double
window_distance(
    const survey *s, int32_t x, int32_t y, int32_t u, int32_t v, double limit)
{
    double sum = 0.0;

    for (int32_t j = 0; j < SIDE && sum < limit; ++j)
        for (int32_t i = 0; i < SIDE; ++i)
            sum += otx_image_distance_sq(
                otx_image_at(
                    s->image, otx_image_wrap(x + i, s->image->width),
                    otx_image_wrap(y + j, s->image->height)),
                otx_image_at(s->source, u + i, v + j));
    return sum;
}

static otx_status
probe(void *context, int64_t index, otx_worker *worker)
{
    survey *s = context;
    const int32_t x = s->places[index] % s->image->width;
    const int32_t y = s->places[index] / s->image->width;
    double best = INFINITY;

    (void)worker;
    for (int32_t v = 0; v + SIDE <= s->source->height; v += s->stride)
        for (int32_t u = 0; u + SIDE <= s->source->width; u += s->stride)
        {
            if (s->own && abs(u - x) < SIDE && abs(v - y) < SIDE)
                continue;
            best = fmin(best, window_distance(s, x, y, u, v, best));
        }
    s->found[index] = best;
    return OSDTEX_OK;
}

static otx_status
run_survey(otx_run *run, survey *s, double *out)
{
    const double places = (double)s->source->width * (double)s->source->height;

    *out = 0.0;
    if (s->count == 0)
        return OSDTEX_OK;
    s->stride = (int32_t)fmax(1.0, sqrt(places / PLACES));
    OTX_TRY(otx_pool_for(run->pool, s->count, probe, s));
    otx_sort_doubles(s->found, (size_t)s->count);
    *out = sqrt(s->found[(int32_t)(QUANTILE * s->count)]);
    return OSDTEX_OK;
}

/* Whether two texels meet in a block that are no neighbours in the picture. */
static bool
is_cut(const otx_texel_map *map, int32_t factor, int32_t x, int32_t y)
{
    for (int32_t j = factor * y; j < factor * (y + 1); ++j)
        for (int32_t i = factor * x; i < factor * (x + 1); ++i)
        {
            const int32_t at = otx_texel_map_at(map, i, j);
            const int32_t right =
                otx_texel_map_at(map, otx_image_wrap(i + 1, map->width), j);
            const int32_t above =
                otx_texel_map_at(map, i, otx_image_wrap(j + 1, map->height));

            if (right - at != 1 || above - at != map->width)
                return true;
        }
    return false;
}

/* PROBES windows across cuts, evenly along the rows. */
static otx_status
place_on_cuts(otx_run *run, const otx_texel_map *map, int32_t factor, survey *s)
{
    const int32_t width = s->image->width, height = s->image->height;
    int32_t *places = OTX_NEW(run->scratch, int32_t, (int64_t)width * height);
    int32_t total = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            if (is_cut(map, factor, x, y))
                places[total++] = otx_image_wrap(y - SIDE / 2, height) * width +
                                  otx_image_wrap(x - SIDE / 2, width);
    s->count = total < PROBES ? total : PROBES;
    for (int32_t i = 0; i < s->count; ++i)
        s->places[i] = places[(int64_t)i * total / s->count];
    return OSDTEX_OK;
}

/* PROBES windows all over the picture, 12 x 8. */
static void
place_evenly(survey *s)
{
    const int32_t columns = s->image->width - SIDE;
    const int32_t rows = s->image->height - SIDE;

    for (s->count = 0; s->count < PROBES; ++s->count)
    {
        const int32_t x = (2 * (s->count % 12) + 1) * columns / 24;
        const int32_t y = (2 * (s->count / 12) + 1) * rows / 16;

        s->places[s->count] = y * s->image->width + x;
    }
}

static otx_status
measure_at(
    otx_run *run, const otx_texel_pool *pool, const otx_texel_map *source,
    const otx_texel_map *map, int32_t factor, double *out)
{
    otx_image before, after;
    survey cuts = {.image = &after, .source = &before};
    survey usual = {.image = &before, .source = &before, .own = true};
    double far, near;

    *out = 0.0;
    OTX_TRY(otx_window_search_shrink(
        run, run->scratch, pool, source, factor, &before, NULL));
    OTX_TRY(otx_window_search_shrink(
        run, run->scratch, pool, map, factor, &after, NULL));
    if (before.width < MIN_SIDE || before.height < MIN_SIDE)
        return OSDTEX_OK;
    OTX_TRY(place_on_cuts(run, map, factor, &cuts));
    place_evenly(&usual);
    OTX_TRY(run_survey(run, &cuts, &far));
    OTX_TRY(run_survey(run, &usual, &near));
    *out = far / fmax(near, SIDE * UNSEEN);
    return OSDTEX_OK;
}

otx_status
otx_oddness_measure(
    otx_run *run, const otx_texel_pool *pool, const otx_texel_map *map,
    double *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t least = map->width < map->height ? map->width : map->height;
    const int32_t factor = (least + USUAL_SIDE / 2) / USUAL_SIDE;
    const int32_t fine = factor > 1 ? factor : 1;
    otx_texel_map source;
    double most = 0.0;

    OTX_TRY(otx_texel_map_create(
        run, run->scratch, map->width, map->height, &source));
    otx_texel_pool_lay(pool, (otx_texel_window){0, 0, 0}, &source);
    for (int32_t f = fine; f <= 4 * fine; f *= 2)
    {
        double odd;

        OTX_TRY(measure_at(run, pool, &source, map, f, &odd));
        most = fmax(most, odd);
    }
    *out = most;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

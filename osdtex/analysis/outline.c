/* outline.c -- outlines are where colours change most; depth is the distance
 * to them. */
#include "analysis/outline.h"

#include "image/view.h"

#include <string.h>

enum
{
    SIDE_MAX = 340, /* of the picture that is looked at */
    BLURS = 2       /* of variance 1/2 */
};

/* A texel this deep is deep enough, relative to the shorter side. */
static const double DEEP = 0.025;

/* An area that takes as much of the picture is the ground. */
static const double GROUND = 0.5;

typedef struct plane
{
    int32_t width, height;
    bool wrap_x, wrap_y;
    float *values; /* [height * width] */
} plane;

/* The index of the texel dx, dy away; at borders that do not wrap, that of the
 * border. */
static size_t
beside(const plane *p, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    return (size_t)otx_view_fold(y + dy, p->height, p->wrap_y) *
               (size_t)p->width +
           (size_t)otx_view_fold(x + dx, p->width, p->wrap_x);
}

/* [1 2 1] / 4 along one axis, of three channels. */
static void
blur_along(const plane *p, const float *from, int32_t dx, int32_t dy, float *to)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
        {
            const float *a = from + 3 * beside(p, x, y, -dx, -dy);
            const float *b = from + 3 * beside(p, x, y, 0, 0);
            const float *c = from + 3 * beside(p, x, y, dx, dy);
            float *out = to + 3 * beside(p, x, y, 0, 0);

            for (int k = 0; k < 3; ++k)
                out[k] = 0.25f * (a[k] + c[k]) + 0.5f * b[k];
        }
}

static void
find_slopes(const plane *p, const float *colors)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
            p->values[beside(p, x, y, 0, 0)] = (float)sqrt(
                otx_image_distance_sq(
                    colors + 3 * beside(p, x, y, 1, 0),
                    colors + 3 * beside(p, x, y, -1, 0)) +
                otx_image_distance_sq(
                    colors + 3 * beside(p, x, y, 0, 1),
                    colors + 3 * beside(p, x, y, 0, -1)));
}

/* 1 where the slope is above its mean by more than its deviation, else 0. */
static void
mark_outlines(const plane *p)
{
    const int64_t count = (int64_t)p->width * p->height;
    double sum = 0.0, sum_sq = 0.0, limit;

    for (int64_t i = 0; i < count; ++i)
    {
        sum += p->values[i];
        sum_sq += (double)p->values[i] * p->values[i];
    }
    limit = sum / (double)count;
    limit += sqrt(fmax(0.0, sum_sq / (double)count - limit * limit));
    for (int64_t i = 0; i < count; ++i)
        p->values[i] = p->values[i] > limit ? 1.0f : 0.0f;
}

/* From marks to squared distances, up to `most` texels: along columns, and of
 * these along rows. */
static void
measure_columns(const plane *p, int32_t most, float *out)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
        {
            int32_t d = 0;

            while (d < most && p->values[beside(p, x, y, 0, d)] == 0.0f &&
                   p->values[beside(p, x, y, 0, -d)] == 0.0f)
                ++d;
            out[beside(p, x, y, 0, 0)] = (float)(d * d);
        }
}

static void
measure_rows(const plane *p, const float *columns, int32_t most)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
        {
            float least = (float)(most * most);

            for (int32_t d = -most; d <= most; ++d)
                least = fminf(
                    least, columns[beside(p, x, y, d, 0)] + (float)(d * d));
            p->values[beside(p, x, y, 0, 0)] = least;
        }
}

/* Labels the area around a texel that no outline parts from it; its size. */
static int64_t
flood(
    const plane *p, int32_t seed, int32_t label, int32_t *labels,
    int32_t *queue)
{
    static const int32_t steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    int64_t count = 0;

    labels[seed] = label;
    queue[count++] = seed;
    for (int64_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k)
        {
            const size_t next = beside(
                p, queue[i] % p->width, queue[i] / p->width, steps[k][0],
                steps[k][1]);

            /* Two texels wide at least, lest outlines leak. */
            if (labels[next] != 0 || p->values[next] < 2.0f)
                continue;
            labels[next] = label;
            queue[count++] = (int32_t)next;
        }
    return count;
}

/* The label of the area that is the ground; 0 none. */
static otx_status
find_ground(otx_run *run, const plane *p, int32_t **out, int32_t *ground)
{
    const int32_t count = p->width * p->height;
    int32_t *labels = OTX_ZNEW(run->scratch, int32_t, count);
    int32_t *queue = OTX_NEW(run->scratch, int32_t, count);

    *ground = 0;
    *out = labels;
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
        if (labels[i] == 0 && p->values[i] >= 2.0f &&
            flood(p, i, i + 1, labels, queue) > GROUND * count)
            *ground = i + 1;
    return OSDTEX_OK;
}

static void
turn_to_depths(
    const plane *p, int32_t most, const int32_t *labels, int32_t ground)
{
    for (int64_t i = 0; i < (int64_t)p->width * p->height; ++i)
    {
        const float depth = sqrtf(p->values[i]) / (float)most;

        if (ground == 0)
            p->values[i] = depth;
        else
            p->values[i] = labels[i] == ground ? 1.0f - depth : 1.0f;
    }
}

static otx_status
find(otx_run *run, const plane *p, const otx_image *small, float *aside)
{
    const int32_t shorter = p->width < p->height ? p->width : p->height;
    const int32_t most = (int32_t)fmax(2.0, floor(DEEP * shorter + 0.5));
    int32_t *labels, ground;

    for (int k = 0; k < BLURS; ++k)
    {
        blur_along(p, small->pixels, 1, 0, aside);
        blur_along(p, aside, 0, 1, small->pixels);
    }
    find_slopes(p, small->pixels);
    mark_outlines(p);
    measure_columns(p, most, aside);
    measure_rows(p, aside, most);
    OTX_TRY(find_ground(run, p, &labels, &ground));
    turn_to_depths(p, most, labels, ground);
    return OSDTEX_OK;
}

/* A picture of its own, small enough. */
static otx_status
shrink(otx_run *run, const otx_image *from, otx_image *out)
{
    otx_image large = *from;

    while (large.width > SIDE_MAX || large.height > SIDE_MAX)
    {
        OTX_TRY(otx_image_halve(run, run->scratch, &large, out));
        large = *out;
    }
    if (large.pixels != from->pixels)
        return OSDTEX_OK;
    OTX_TRY(otx_image_create(
        run, run->scratch, from->width, from->height, from->channels, out));
    memcpy(
        out->pixels, from->pixels,
        (size_t)from->width * (size_t)from->height * (size_t)from->channels *
            sizeof *out->pixels);
    return OSDTEX_OK;
}

otx_status
otx_outline_find(otx_run *run, const otx_exemplar *exemplar, otx_image *out)
{
    otx_image small;
    float *aside;
    plane p;

    OTX_TRY(shrink(run, &exemplar->lab, &small));
    OTX_TRY(
        otx_image_create(run, run->scratch, small.width, small.height, 1, out));
    aside =
        OTX_NEW(run->scratch, float, 3 * (int64_t)small.width * small.height);
    OTX_TRY(otx_run_ok(run));
    p = (plane){
        small.width, small.height, exemplar->wrap_x, exemplar->wrap_y,
        out->pixels};
    return find(run, &p, &small, aside);
}

/* courses.c -- rows that may slide along each other: masonry, planks.
 *
 * Lines across the courses are averaged along them. The mean line has a period
 * where there are courses; its joints are where lines vary least along
 * themselves and differ most from the picture's mean. */
#include "analysis/courses.h"

#include <math.h>
#include <string.h>

/* Fewest texels to a course. */
static const int32_t COURSE_MIN = 12;

/* How far courses of one picture may differ in height. */
static const double UNEVEN = 0.25;

/* Masonry has .11 to .23 of its variance in the courses, and .2 to .4 of it
 * along the joints; photographs without courses less than .07 or more than .5.
 */
static const double STRENGTH = 0.1, SLIP = 0.45;

typedef struct profile
{
    int32_t size;
    double *mean, *variance; /* [size] of each line, of all the variance 1 */
    double *cost;            /* [size] of a joint there */
} profile;

static otx_status
measure(otx_run *run, const otx_image *lab, bool upright, profile *p)
{
    const int32_t size = upright ? lab->width : lab->height;
    const int32_t along = upright ? lab->height : lab->width;
    double all = 0.0, sum = 0.0;

    p->size = size;
    p->mean = OTX_ZNEW(run->scratch, double, size);
    p->variance = OTX_ZNEW(run->scratch, double, size);
    p->cost = OTX_NEW(run->scratch, double, size);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < size; ++i)
    {
        for (int32_t k = 0; k < along; ++k)
        {
            const double v = upright ? *otx_image_at(lab, size - 1 - i, k)
                                     : *otx_image_at(lab, k, i);

            p->mean[i] += v / along;
            p->variance[i] += v * v / along;
        }
        sum += p->mean[i] / size;
        all += p->variance[i] / size;
        p->variance[i] -= p->mean[i] * p->mean[i];
    }
    all = fmax(all - sum * sum, 1e-12);
    for (int32_t i = 0; i < size; ++i)
    {
        p->mean[i] = (p->mean[i] - sum) / sqrt(all);
        p->variance[i] /= all;
    }
    return OSDTEX_OK;
}

/* Share of the variance in the period of `count` courses. */
static double
strength_of(const profile *p, int32_t count)
{
    double re = 0.0, im = 0.0;

    for (int32_t i = 0; i < p->size; ++i)
    {
        const double a = 2.0 * OTX_PI * count * i / p->size;

        re += p->mean[i] * cos(a) / p->size;
        im += p->mean[i] * sin(a) / p->size;
    }
    return 2.0 * (re * re + im * im);
}

/* What joints cost, smoothed over a tenth of a course. */
static void
rate_lines(const profile *p, int32_t count)
{
    const int32_t half = p->size / (20 * count);

    for (int32_t i = 0; i < p->size; ++i)
    {
        p->cost[i] = 0.0;
        for (int32_t k = -half; k <= half; ++k)
        {
            const int32_t at = otx_image_wrap(i + k, p->size);

            p->cost[i] +=
                (p->variance[at] - p->mean[at] * p->mean[at]) / (2 * half + 1);
        }
    }
}

/* -- where the joints are ------------------------------------------------ */

typedef struct chain
{
    const profile *p;
    int32_t count, low, high; /* courses, and their least and most height */
    double *best;             /* [2 size] cost of coming as far */
    double *next;
    int32_t *step; /* [count * 2 size] height of the course that ended here */
} chain;

/* The cheapest joints of which the first is at `start`; their cost. */
static double
solve_chain(chain *c, int32_t start)
{
    const int32_t size = c->p->size, span = 2 * size;
    double *best = c->best, *next = c->next;

    for (int32_t i = 0; i < span; ++i)
        best[i] = INFINITY;
    best[start] = 0.0;
    for (int32_t k = 0; k < c->count; ++k)
    {
        int32_t *step = c->step + (size_t)k * (size_t)span;
        double *swap = best;

        for (int32_t i = 0; i < span; ++i)
        {
            next[i] = INFINITY;
            for (int32_t d = c->low; d <= c->high && d <= i; ++d)
                if (best[i - d] < next[i])
                {
                    next[i] = best[i - d];
                    step[i] = d;
                }
            next[i] += c->p->cost[i % size];
        }
        best = next;
        next = swap;
    }
    return best[start + size];
}

/* Joints from the steps of the last solution. */
static void
trace_chain(const chain *c, int32_t start, otx_courses *out)
{
    const int32_t span = 2 * c->p->size;
    int32_t at = start + c->p->size;

    for (int32_t k = c->count; k >= 0; --k)
    {
        out->joints[k] = at + 0.5;
        if (k > 0)
            at -= c->step[(size_t)(k - 1) * (size_t)span + (size_t)at];
    }
}

static otx_status
place_joints(
    otx_run *run, const profile *p, int32_t count, double along,
    otx_courses *out)
{
    const double height = (double)p->size / count;
    chain c = {
        .p = p,
        .count = count,
        .low = (int32_t)((1.0 - UNEVEN) * height),
        .high = (int32_t)ceil((1.0 + UNEVEN) * height),
        .best = OTX_NEW(run->scratch, double, 2 * (int64_t)p->size),
        .next = OTX_NEW(run->scratch, double, 2 * (int64_t)p->size),
        .step = OTX_ZNEW(run->scratch, int32_t, 2 * (int64_t)count * p->size)};
    int32_t start = 0;

    OTX_TRY(otx_run_ok(run));
    /* The clearest joint of all is one of them. */
    for (int32_t i = 1; i < p->size; ++i)
        if (p->cost[i] < p->cost[start])
            start = i;
    if (!isfinite(solve_chain(&c, start)))
        return OSDTEX_OK;
    out->count = count;
    out->period = along;
    trace_chain(&c, start, out);
    for (int32_t k = 0; k < count; ++k)
        out->slip += p->variance[(int32_t)out->joints[k] % p->size] / count;
    return OSDTEX_OK;
}

static otx_status
find_along(otx_run *run, const otx_image *lab, bool upright, otx_courses *out)
{
    int32_t best = 2;
    profile p;

    *out = (otx_courses){.upright = upright};
    OTX_TRY(measure(run, lab, upright, &p));
    for (int32_t k = 2; k <= OTX_COURSES_MAX && k * COURSE_MIN <= p.size; ++k)
    {
        const double strength = strength_of(&p, k);

        if (strength > out->strength)
        {
            out->strength = strength;
            best = k;
        }
    }
    if (best * COURSE_MIN > p.size)
        return OSDTEX_OK;
    rate_lines(&p, best);
    OTX_TRY(
        place_joints(run, &p, best, upright ? lab->height : lab->width, out));
    if (upright) /* of -x, not of width - x */
        for (int32_t k = 0; k <= out->count; ++k)
            out->joints[k] -= lab->width;
    return OSDTEX_OK;
}

otx_status
otx_courses_find(otx_run *run, const otx_image *lab, otx_courses *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_courses upright;

    OTX_TRY(find_along(run, lab, false, out));
    OTX_TRY(find_along(run, lab, true, &upright));
    if (out->count == 0 ||
        (upright.count > 0 && upright.strength > out->strength))
        *out = upright;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

bool
otx_courses_are_plain(const otx_courses *courses)
{
    return courses->count > 0 && courses->strength >= STRENGTH &&
           courses->slip <= SLIP;
}

otx_vec2
otx_courses_texel(const otx_courses *c, double along, double course)
{
    const double side = c->joints[c->count] - c->joints[0];
    const double turns = floor(course / c->count);
    const double rest = course - turns * c->count;
    const int32_t k = rest < c->count ? (int32_t)rest : c->count - 1;
    const double across = turns * side + c->joints[k] +
                          (rest - k) * (c->joints[k + 1] - c->joints[k]);

    return c->upright ? (otx_vec2){-across, along} : (otx_vec2){along, across};
}

/* feature.c -- joints by contrast to their surroundings, features by what is
 * deep enough between them. */
#include "analysis/feature.h"

#include "image/threshold.h"
#include "image/view.h"

#include <string.h>

enum
{
    SPECK = 60,  /* texels: smaller joints and features are none */
    FEWEST = 6,  /* features */
    PASSES = 3,  /* boxes to a Gaussian */
    MARKER = 3,  /* texels from a joint, so that bridges do not join */
    CHAMFER = 3, /* of a step along an axis; a diagonal one is 4 */
    FAR = 1 << 20
};

/* Standard deviations of the surroundings, relative to the shorter side, and of
 * the noise, texels. */
static const double AROUND = 1.0 / 14.0, NOISE = 1.1;

/* Areas in those of a mean feature, and radii in those of a circle of its area,
 * beyond which a feature is several. */
static const double LARGE = 4.0, LONG = 3.0;

typedef struct plane
{
    int32_t width, height;
    bool wrap_x, wrap_y;
    int32_t *queue; /* [texels] */
} plane;

static int32_t
at(const plane *p, int32_t x, int32_t y)
{
    return otx_view_fold(y, p->height, p->wrap_y) * p->width +
           otx_view_fold(x, p->width, p->wrap_x);
}

/* The texel k of four beside another; -1 beyond a border. */
static int32_t
beside(const plane *p, int32_t texel, int32_t k)
{
    static const int32_t X[] = {1, -1, 0, 0}, Y[] = {0, 0, 1, -1};
    const int32_t x = texel % p->width + X[k], y = texel / p->width + Y[k];

    if ((!p->wrap_x && (x < 0 || x >= p->width)) ||
        (!p->wrap_y && (y < 0 || y >= p->height)))
        return -1;
    return at(p, x, y);
}

/* ---- joints ---- */

/* The mean of 2 r + 1 values along an axis. */
static void
box(const plane *p, const float *from, int32_t r, bool along_x, float *to)
{
    const int32_t lines = along_x ? p->height : p->width;
    const int32_t length = along_x ? p->width : p->height;

    for (int32_t line = 0; line < lines; ++line)
    {
        double sum = 0.0;

#define OTX_AT(i) (along_x ? at(p, (i), line) : at(p, line, (i)))
        for (int32_t i = -r; i <= r; ++i)
            sum += (double)from[OTX_AT(i)];
        for (int32_t i = 0; i < length; ++i)
        {
            to[OTX_AT(i)] = (float)(sum / (2 * r + 1));
            sum +=
                (double)from[OTX_AT(i + r + 1)] - (double)from[OTX_AT(i - r)];
        }
#undef OTX_AT
    }
}

static void
blur(const plane *p, float *values, double sigma, float *aside)
{
    /* The variance of a box of 2 r + 1 is r (r + 1) / 3. */
    const double r = 0.5 * (sqrt(1.0 + 12.0 * sigma * sigma / PASSES) - 1.0);
    const int32_t reach = (int32_t)fmax(1.0, floor(r + 0.5));

    for (int k = 0; k < PASSES; ++k)
    {
        box(p, values, reach, true, aside);
        box(p, aside, reach, false, values);
    }
}

/* How much darker than its surroundings each texel is. */
static otx_status
contrast(otx_run *run, const plane *p, const otx_image *lab, float **out)
{
    const int32_t n = p->width * p->height;
    const double side = fmin(p->width, p->height);
    float *near = OTX_NEW(run->scratch, float, n);
    float *wide = OTX_NEW(run->scratch, float, n);
    float *aside = OTX_NEW(run->scratch, float, n);

    *out = wide;
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < n; ++i)
        near[i] = wide[i] = lab->pixels[(ptrdiff_t)i * lab->channels];
    blur(p, near, NOISE, aside);
    blur(p, wide, AROUND * side, aside);
    for (int32_t i = 0; i < n; ++i)
        wide[i] -= near[i];
    return OSDTEX_OK;
}

/* Labels what hangs together with a texel of the same `kind`; how much that
 * is. */
static int32_t
flood(
    const plane *p, const uint8_t *kind, int32_t seed, int32_t label,
    int32_t *labels)
{
    int32_t count = 0;

    labels[seed] = label;
    p->queue[count++] = seed;
    for (int32_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k)
        {
            const int32_t next = beside(p, p->queue[i], k);

            if (next < 0 || labels[next] != 0 || kind[next] != kind[seed])
                continue;
            labels[next] = label;
            p->queue[count++] = next;
        }
    return count;
}

/* Specks of joint become feature. Sets how much of the rest is in one piece,
 * and how much of the picture it takes. */
static void
clean_joints(
    const plane *p, uint8_t *joint, int32_t *labels, double *network,
    double *share)
{
    const int32_t n = p->width * p->height;
    int32_t largest = 0, all = 0;

    memset(labels, 0, (size_t)n * sizeof *labels);
    for (int32_t i = 0; i < n; ++i)
    {
        int32_t count;

        if (!joint[i] || labels[i])
            continue;
        count = flood(p, joint, i, i + 1, labels);
        if (count < SPECK)
            for (int32_t k = 0; k < count; ++k)
                joint[p->queue[k]] = 0;
        else
        {
            all += count;
            largest = count > largest ? count : largest;
        }
    }
    *network = all > 0 ? (double)largest / all : 0.0;
    *share = (double)all / n;
}

/* Joints are dark or light: those that hang together better are. */
static otx_status
find_joints(
    otx_run *run, const plane *p, const otx_image *lab, uint8_t *joint,
    int32_t *labels, double *network)
{
    const int32_t n = p->width * p->height;
    uint8_t *other = OTX_NEW(run->scratch, uint8_t, n);
    double best = -1.0;
    float *darker;

    OTX_TRY(contrast(run, p, lab, &darker));
    for (int side = 0; side < 2; ++side)
    {
        otx_threshold cut;
        double hangs, share;

        if (side == 1)
            for (int32_t i = 0; i < n; ++i)
                darker[i] = -darker[i];
        cut = otx_threshold_find(darker, n);
        for (int32_t i = 0; i < n; ++i)
            other[i] = cut.clarity > 0.0 && (double)darker[i] >= cut.value;
        clean_joints(p, other, labels, &hangs, &share);
        if (share > 0.55 || hangs * (1.0 - share) <= best)
            continue;
        best = hangs * (1.0 - share);
        *network = hangs;
        memcpy(joint, other, (size_t)n);
    }
    return OSDTEX_OK;
}

/* ---- features ---- */

/* One sweep over the plane, up or down: distances to a joint, three to a step.
 */
static void
sweep(const plane *p, bool down, int32_t *distance)
{
    for (int32_t r = 0; r < p->height; ++r)
        for (int32_t c = 0; c < p->width; ++c)
        {
            const int32_t y = down ? p->height - 1 - r : r;
            const int32_t x = down ? p->width - 1 - c : c;
            const int32_t step = down ? 1 : -1;
            const int32_t around[4] = {
                distance[at(p, x + step, y)] + CHAMFER,
                distance[at(p, x, y + step)] + CHAMFER,
                distance[at(p, x + step, y + step)] + CHAMFER + 1,
                distance[at(p, x - step, y + step)] + CHAMFER + 1};
            int32_t *here = &distance[at(p, x, y)];

            for (int k = 0; k < 4; ++k)
                *here = around[k] < *here ? around[k] : *here;
        }
}

/* Joints are 0. The second round goes on across the sides of what wraps. */
static void
measure(const plane *p, const uint8_t *joint, int32_t *distance)
{
    for (int32_t i = 0; i < p->width * p->height; ++i)
        distance[i] = joint[i] ? 0 : FAR;
    for (int k = 0; k < 4; ++k)
        sweep(p, k & 1, distance);
}

/* What is deep enough is a feature; the rest of it belongs to the nearest. */
static int32_t
grow_features(
    const plane *p, const uint8_t *joint, uint8_t *deep, int32_t *labels)
{
    const int32_t n = p->width * p->height;
    int32_t found = 0, count = 0;

    memset(labels, 0, (size_t)n * sizeof *labels);
    for (int32_t i = 0; i < n; ++i)
        if (deep[i] && !labels[i])
            flood(p, deep, i, ++found, labels);
    for (int32_t i = 0; i < n; ++i)
        if (labels[i])
            p->queue[count++] = i;
    for (int32_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k)
        {
            const int32_t next = beside(p, p->queue[i], k);

            if (next < 0 || labels[next] || joint[next])
                continue;
            labels[next] = labels[p->queue[i]];
            p->queue[count++] = next;
        }
    return found;
}

/* ---- the list ---- */

/* The place of a texel that is nearest to another, across sides that wrap. */
static otx_vec2
unwrapped(const plane *p, int32_t texel, otx_vec2 near)
{
    otx_vec2 out = {texel % p->width + 0.5, texel / p->width + 0.5};

    if (p->wrap_x)
        out.x += p->width * floor((near.x - out.x) / p->width + 0.5);
    if (p->wrap_y)
        out.y += p->height * floor((near.y - out.y) / p->height + 0.5);
    return out;
}

/* Sums over the texels of each label. `first` is one of them. */
static void
sum_up(const plane *p, const int32_t *labels, int32_t *first, otx_feature *list)
{
    for (int32_t i = 0; i < p->width * p->height; ++i)
    {
        const int32_t label = labels[i] - 1;
        const int32_t x = i % p->width, y = i / p->width;
        otx_vec2 place;

        if (label < 0)
            continue;
        if (first[label] < 0)
            first[label] = i;
        place = unwrapped(
            p, i,
            (otx_vec2){
                first[label] % p->width + 0.5, first[label] / p->width + 0.5});
        list[label].middle = otx_vec2_add(list[label].middle, place);
        list[label].area += 1.0;
        if ((!p->wrap_x && (x == 0 || x == p->width - 1)) ||
            (!p->wrap_y && (y == 0 || y == p->height - 1)))
            list[label].whole = false;
    }
}

/* What is much larger than the others, or straggles, is rather several that
 * nothing parts. */
static void
drop_odd(otx_features *f)
{
    double mean = 0.0;

    for (int32_t i = 0; i < f->count; ++i)
        mean += f->list[i].area / f->count;
    for (int32_t i = 0; i < f->count && !f->by_alpha; ++i)
    {
        otx_feature *one = &f->list[i];

        if (one->area > LARGE * mean ||
            one->radius > LONG * sqrt(one->area / 3.14159265358979323846))
            one->whole = false;
    }
}

static double
agreement(const otx_vec2 *list, int32_t count)
{
    otx_vec2 sum = {0, 0};
    double lengths = 0.0;

    for (int32_t i = 0; i < count; ++i)
    {
        sum = otx_vec2_add(sum, list[i]);
        lengths += otx_vec2_length(list[i]);
    }
    return lengths > 0.0 ? otx_vec2_length(sum) / lengths : 0.0;
}

/* By long axes, doubled so that either end is the same, or by the side to which
 * features reach out further: round ones have no axis, and bars no side.
 *
 *   moments  [2 * count] zeros */
static double
alignment(const plane *p, const otx_features *f, otx_vec2 *moments)
{
    otx_vec2 *sides = moments + f->count;

    for (int32_t i = 0; i < p->width * p->height; ++i)
    {
        const int32_t index = f->labels[i] - 1;
        otx_vec2 d;

        if (index < 0)
            continue;
        d = otx_vec2_sub(
            unwrapped(p, i, f->list[index].middle), f->list[index].middle);
        moments[index] = otx_vec2_add(moments[index], otx_vec2_mul(d, d));
        sides[index] =
            otx_vec2_add(sides[index], otx_vec2_scale(otx_vec2_dot(d, d), d));
    }
    return fmax(agreement(moments, f->count), agreement(sides, f->count));
}

/* Specks are dropped, the others numbered anew. */
static otx_status
list_features(otx_run *run, const plane *p, int32_t found, otx_features *out)
{
    const int32_t n = p->width * p->height;
    int32_t *first = OTX_NEW(run->scratch, int32_t, found + 1);
    int32_t *number = OTX_ZNEW(run->scratch, int32_t, found + 1);
    otx_feature *list = OTX_ZNEW(run->arena, otx_feature, found + 1);
    otx_vec2 *axes = OTX_ZNEW(run->scratch, otx_vec2, 2 * (found + 1));

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < found; ++i)
    {
        first[i] = -1;
        list[i].whole = true;
    }
    sum_up(p, out->labels, first, list);
    for (int32_t i = 0; i < found; ++i)
    {
        if (list[i].area < SPECK)
            continue;
        list[i].middle = otx_vec2_scale(1.0 / list[i].area, list[i].middle);
        list[out->count++] = list[i];
        out->share += list[i].area / n;
        number[i + 1] = out->count;
    }
    out->list = list;
    for (int32_t i = 0; i < n; ++i)
    {
        otx_feature *f;

        out->labels[i] = number[out->labels[i]];
        if (out->labels[i] == 0)
            continue;
        f = &list[out->labels[i] - 1];
        f->radius = fmax(
            f->radius, otx_vec2_length(otx_vec2_sub(
                           unwrapped(p, i, f->middle), f->middle)));
    }
    drop_odd(out);
    out->aligned = alignment(p, out, axes);
    return OSDTEX_OK;
}

/* ---- alpha ---- */

/* Whether there is nothing at a place of `lab`. */
static bool
is_transparent(const otx_exemplar *e, int32_t index)
{
    const otx_image *from = &e->linear;
    const double x = (index % e->lab.width + 0.5) * from->width / e->lab.width;
    const double y =
        (index / e->lab.width + 0.5) * from->height / e->lab.height;

    return otx_image_at(from, (int32_t)x, (int32_t)y)[3] < 0.5f;
}

bool
otx_features_are_cut_out(const otx_exemplar *e)
{
    const int32_t n = e->lab.width * e->lab.height;
    int32_t count = 0;

    if (e->linear.channels != 4 || !e->linear.pixels)
        return false;
    for (int32_t i = 0; i < n; ++i)
        count += is_transparent(e, i);
    return count > 0.02 * n && count < 0.98 * n;
}

otx_status
otx_features_find(otx_run *run, const otx_exemplar *e, otx_features *out)
{
    const int32_t w = e->lab.width, h = e->lab.height, n = w * h;
    plane p = {w, h, e->wrap_x, e->wrap_y, OTX_NEW(run->scratch, int32_t, n)};
    uint8_t *joint = OTX_ZNEW(run->scratch, uint8_t, n);
    uint8_t *deep = OTX_NEW(run->scratch, uint8_t, n);
    int32_t *distance = OTX_NEW(run->scratch, int32_t, n);

    *out = (otx_features){
        .width = w, .height = h, .wrap_x = e->wrap_x, .wrap_y = e->wrap_y};
    out->labels = OTX_NEW(run->arena, int32_t, n);
    OTX_TRY(otx_run_ok(run));
    out->by_alpha = otx_features_are_cut_out(e);
    for (int32_t i = 0; out->by_alpha && i < n; ++i)
        joint[i] = is_transparent(e, i);
    out->network = 1.0;
    if (!out->by_alpha)
        OTX_TRY(
            find_joints(run, &p, &e->lab, joint, out->labels, &out->network));
    measure(&p, joint, distance);
    for (int32_t i = 0; i < n; ++i)
        deep[i] = distance[i] > (out->by_alpha ? 0 : CHAMFER * MARKER);
    return list_features(
        run, &p, grow_features(&p, joint, deep, out->labels), out);
}

bool
otx_features_are_clear(const otx_features *f)
{
    const double n = (double)f->width * f->height;
    int32_t sound = 0, whole = 0;

    for (int32_t i = 0; i < f->count; ++i)
    {
        const double share = f->list[i].area / n;

        sound += share > 4e-4 && share < 0.12;
        whole += f->list[i].whole;
    }
    if (f->by_alpha)
        return whole > 0;
    return whole >= FEWEST && sound >= 0.6 * f->count && f->share > 0.3 &&
           f->network > 0.6;
}

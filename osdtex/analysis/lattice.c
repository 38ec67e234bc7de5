/* lattice.c -- the vectors by which a picture repeats.
 *
 * Peaks of the autocorrelation that generate further peaks make a lattice. */
#include "analysis/lattice.h"

#include <string.h>

enum
{
    PEAKS_MAX = 40,
    ORDER_MAX = 12, /* multiples of a generator that are looked at */
    POINTS_MIN = 10 /* that a lattice generates, opposite ones counted twice */
};

static const double PAIR_SINE = 0.342; /* least angle of a pair: 20 degrees */
static const double NEARLY = 0.9;      /* of the best rating */

typedef struct peak
{
    otx_vec2 at;
    double value;
    /* Multiples of a generator are as like as it is, and there are more of
     * them: near ones go first. */
    double rank;
} peak;

/* Radius at which the correlation, averaged over a circle, has fallen to a
 * half: peaks closer than this are one. */
static double
correlation_length(const otx_lags *map)
{
    for (double r = 1.0; r < map->reach; r += 1.0)
    {
        double sum = 0.0;

        for (int k = 0; k < 64; ++k)
            sum += otx_lags_at(
                map, otx_vec2_scale(r, otx_vec2_polar(2.0 * OTX_PI * k / 64)));
        if (sum < 0.5 * 64)
            return r;
    }
    return map->reach;
}

static bool
is_peak(const otx_lags *map, int32_t x, int32_t y)
{
    const int32_t r = map->reach, w = 2 * r + 1;
    const float *at = map->at + (size_t)(y + r) * (size_t)w + (size_t)(x + r);

    for (int32_t j = -1; j <= 1; ++j)
        for (int32_t i = -1; i <= 1; ++i)
            if ((i != 0 || j != 0) && at[j * w + i] > *at)
                return false;
    return true;
}

/* The vertex of the parabola through three values. */
static double
parabola(double a, double b, double c)
{
    const double bend = a - 2.0 * b + c;

    return bend < 0.0 ? fmax(-0.5, fmin(0.5, 0.5 * (a - c) / bend)) : 0.0;
}

static otx_vec2
refine_peak(const otx_lags *map, int32_t x, int32_t y)
{
    const int32_t r = map->reach, w = 2 * r + 1;
    const float *at = map->at + (size_t)(y + r) * (size_t)w + (size_t)(x + r);

    return (otx_vec2){
        x + parabola(at[-1], at[0], at[1]), y + parabola(at[-w], at[0], at[w])};
}

/* Keeps `peaks` in descending order of rank, at least `apart` from each other.
 * Of a lag and its opposite the upper one is kept. */
static int32_t
insert_peak(peak *peaks, int32_t count, peak p, double apart)
{
    int32_t i;

    for (i = 0; i < count; ++i)
        if (otx_vec2_length(otx_vec2_sub(peaks[i].at, p.at)) < apart)
        {
            if (peaks[i].rank >= p.rank)
                return count;
            memmove(
                &peaks[i], &peaks[i + 1],
                (size_t)(--count - i) * sizeof *peaks);
            --i;
        }
    for (i = count; i > 0 && peaks[i - 1].rank < p.rank; --i)
        if (i < PEAKS_MAX)
            peaks[i] = peaks[i - 1];
    if (i < PEAKS_MAX)
        peaks[i] = p;
    return count < PEAKS_MAX ? count + 1 : count;
}

static int32_t
find_peaks(const otx_lags *map, peak peaks[PEAKS_MAX])
{
    const double apart = fmax(2.5, 1.2 * correlation_length(map));
    const int32_t r = map->reach, w = 2 * r + 1;
    int32_t count = 0;

    for (int32_t y = 0; y < r; ++y)
        for (int32_t x = 1 - r; x < r; ++x)
        {
            peak p = {.value = map->at[(y + r) * w + x + r]};

            if ((y == 0 && x <= 0) || p.value < 0.05 || !is_peak(map, x, y))
                continue;
            p.at = refine_peak(map, x, y);
            if (otx_vec2_length(p.at) < apart || otx_vec2_length(p.at) > r - 1)
                continue;
            p.rank = p.value * (1.0 - 0.5 * otx_vec2_length(p.at) / r);
            count = insert_peak(peaks, count, p, apart);
        }
    return count;
}

/* Mean correlation at the points i g0 + j g1 + offset within reach. */
static double
mean_at(
    const otx_lags *map, const otx_vec2 g[2], otx_vec2 offset, int32_t *count)
{
    const double reach = map->reach - 1.0;
    double sum = 0.0;

    *count = 0;

    for (int32_t j = -ORDER_MAX; j <= ORDER_MAX; ++j)
        for (int32_t i = -ORDER_MAX; i <= ORDER_MAX; ++i)
        {
            const otx_vec2 p = otx_vec2_add(
                offset,
                otx_vec2_add(otx_vec2_scale(i, g[0]), otx_vec2_scale(j, g[1])));

            if (otx_vec2_length(p) > reach ||
                otx_vec2_dot(p, p) < 1e-6 * otx_vec2_dot(g[0], g[0]))
                continue;
            sum += otx_lags_at(map, p);
            ++*count;
        }
    return *count > 0 ? sum / *count : 0.0;
}

/* Lagrange's reduction: the shortest pair that generates the same points. */
static void
reduce(otx_vec2 g[2])
{
    for (int turn = 0; turn < 64; ++turn)
    {
        const int longer =
            otx_vec2_dot(g[0], g[0]) > otx_vec2_dot(g[1], g[1]) ? 0 : 1;
        const otx_vec2 s = g[1 - longer];
        const double k = round(otx_vec2_dot(g[longer], s) / otx_vec2_dot(s, s));

        if (k == 0.0 || !isfinite(k))
            return;
        g[longer] = otx_vec2_sub(g[longer], otx_vec2_scale(k, s));
    }
}

void
otx_lattice_order(otx_vec2 g[2])
{
    if (fabs(g[0].x) * otx_vec2_length(g[1]) <
        fabs(g[1].x) * otx_vec2_length(g[0]) * (1.0 - 1e-9))
    {
        const otx_vec2 t = g[0];

        g[0] = g[1];
        g[1] = t;
    }
    if (g[0].x < 0.0)
        g[0] = otx_vec2_scale(-1.0, g[0]);
    if (otx_vec2_cross(g[0], g[1]) < 0.0)
        g[1] = otx_vec2_scale(-1.0, g[1]);
}

/* Moves the generators so that the peaks near the points that they generate
 * lie on them: least squares, farther points first believed when nearer ones
 * have been fitted. */
static void
fit_generators(const otx_lags *map, otx_vec2 g[2])
{
    for (int32_t span = 1; span <= ORDER_MAX; ++span)
    {
        double ii = 0, ij = 0, jj = 0, det;
        otx_vec2 bi = {0, 0}, bj = {0, 0};

        for (int32_t j = -span; j <= span; ++j)
            for (int32_t i = -span; i <= span; ++i)
            {
                otx_vec2 p = otx_vec2_add(
                    otx_vec2_scale(i, g[0]), otx_vec2_scale(j, g[1]));
                int32_t x = (int32_t)lround(p.x), y = (int32_t)lround(p.y);
                double best;

                if ((i == 0 && j == 0) || otx_vec2_length(p) > map->reach - 4.0)
                    continue;
                best = otx_lags_at(map, (otx_vec2){x, y});
                for (bool up = true; up;)
                {
                    up = false;
                    for (int32_t k = 0; k < 9; ++k)
                    {
                        const int32_t nx = x + k % 3 - 1, ny = y + k / 3 - 1;
                        const double v = otx_lags_at(map, (otx_vec2){nx, ny});

                        if (!(v > best) || hypot(nx - p.x, ny - p.y) > 3.0)
                            continue;
                        best = v;
                        x = nx;
                        y = ny;
                        up = true;
                        break;
                    }
                }
                p = refine_peak(map, x, y);
                best = fmax(best, 0.0);
                ii += best * i * i;
                ij += best * i * j;
                jj += best * j * j;
                bi = otx_vec2_add(bi, otx_vec2_scale(best * i, p));
                bj = otx_vec2_add(bj, otx_vec2_scale(best * j, p));
            }
        det = ii * jj - ij * ij;
        if (!(det > 1e-9 * (ii + jj) * (ii + jj)))
            continue;
        g[0] = (otx_vec2){
            (jj * bi.x - ij * bj.x) / det, (jj * bi.y - ij * bj.y) / det};
        g[1] = (otx_vec2){
            (ii * bj.x - ij * bi.x) / det, (ii * bj.y - ij * bi.y) / det};
    }
}

typedef struct rated
{
    otx_vec2 g[2];
    double regularity, contrast;
} rated;

/* False where too few points lie within reach to speak of a lattice. */
static bool
rate_pair(const otx_lags *map, rated *l)
{
    const otx_vec2 half[3] = {
        otx_vec2_scale(0.5, l->g[0]), otx_vec2_scale(0.5, l->g[1]),
        otx_vec2_scale(0.5, otx_vec2_add(l->g[0], l->g[1]))};
    int32_t count;

    l->regularity = mean_at(map, l->g, (otx_vec2){0, 0}, &count);
    if (count < POINTS_MIN)
        return false;
    l->contrast = INFINITY;
    for (int k = 0; k < 3; ++k)
        l->contrast = fmin(
            l->contrast, l->regularity - mean_at(map, l->g, half[k], &count));
    return true;
}

/* Rates the lattice of two peaks; false where they generate none. */
static bool
rate_peaks(const otx_lags *map, const peak *a, const peak *b, rated *out)
{
    *out = (rated){.g = {a->at, b->at}};
    reduce(out->g);
    /* Two peaks in line reduce to a vector and nearly nothing. Written so that
     * NaN is refused too. */
    if (!(fabs(otx_vec2_cross(out->g[0], out->g[1])) >
          PAIR_SINE * otx_vec2_length(out->g[0]) *
              otx_vec2_length(out->g[1])) ||
        !(otx_vec2_length(out->g[0]) > 1.0) ||
        !(otx_vec2_length(out->g[1]) > 1.0))
        return false;
    return rate_pair(map, out);
}

/* The pair of peaks that generates the best lattice: the smallest cell among
 * those that are nearly as regular as the most regular one, since a multiple
 * of a cell is as regular as the cell. */
void
otx_lattice_find(const otx_lags *map, otx_lattice *out)
{
    peak peaks[PEAKS_MAX];
    rated pairs[PEAKS_MAX * (PEAKS_MAX - 1) / 2];
    const int32_t count = find_peaks(map, peaks);
    rated best = {.regularity = -INFINITY};
    double most = -INFINITY, smallest = INFINITY;
    int32_t pair_count = 0;

    for (int32_t i = 0; i < count; ++i)
        for (int32_t j = 0; j < i; ++j)
        {
            rated *l = &pairs[pair_count];

            if (!rate_peaks(map, &peaks[i], &peaks[j], l))
                continue;
            most = fmax(most, l->regularity + l->contrast);
            ++pair_count;
        }
    for (int32_t k = 0; k < pair_count; ++k)
    {
        const rated *l = &pairs[k];
        const double area = fabs(otx_vec2_cross(l->g[0], l->g[1]));

        if (l->regularity + l->contrast < NEARLY * most || area >= smallest)
            continue;
        smallest = (1.0 - 1e-6) * area;
        best = *l;
    }
    *out = (otx_lattice){0};
    if (!isfinite(best.regularity))
        return;
    fit_generators(map, best.g);
    otx_lattice_order(best.g);
    out->regularity = best.regularity;
    out->contrast = best.contrast;
    out->generators[0] = best.g[0];
    out->generators[1] = best.g[1];
}

void
otx_lattice_fit(const otx_image *image, bool wrap_x, bool wrap_y, otx_vec2 g[2])
{
    const double det = otx_vec2_cross(g[0], g[1]);
    const double w = image->width, h = image->height;
    const double a = round(g[1].y * w / det), b = round(-g[0].y * w / det);
    const double c = round(-g[1].x * h / det), d = round(g[0].x * h / det);
    const double whole = a * d - b * c;
    otx_vec2 fit[2];

    if (!wrap_x || !wrap_y || whole == 0.0)
        return;
    fit[0] = (otx_vec2){d * w / whole, -b * h / whole};
    fit[1] = (otx_vec2){-c * w / whole, a * h / whole};
    for (int k = 0; k < 2; ++k)
        if (otx_vec2_length(otx_vec2_sub(fit[k], g[k])) >
            0.06 * otx_vec2_length(g[k]))
            return;
    g[0] = fit[0];
    g[1] = fit[1];
}

/* analysis.c -- does a picture have a direction, or a lattice?
 *
 * The luminance of the centre square, freed of slow shading, is correlated
 * with itself, without assuming that it tiles: each lag is normalised by the
 * energy of what overlaps there. Peaks that generate further peaks make a
 * lattice. Thresholds were set on some twenty photographs and patterns; what
 * they gave is listed in docs/notes/material.md. */
#include "image/analysis.h"

#include "math/fft.h"

#include <string.h>

enum
{
    SIDE_MAX = 512, /* of the square that is looked at */
    PEAKS_MAX = 40,
    ORDER_MAX = 12, /* multiples of a generator that are looked at */
    POINTS_MIN = 10 /* that a lattice generates, opposite ones counted twice */
};

static const double LAG_SHARE = 0.62;    /* longest lag, of the side */
static const double OVERLAP_SHARE = 0.3; /* of the area, least, of a turn */
static const double PAIR_SINE = 0.342;   /* least angle of a pair: 20 degrees */
static const double LATTICE_REGULARITY = 0.45, LATTICE_CONTRAST = 0.12;
static const double WEAK_REGULARITY = 0.2, WEAK_CONTRAST = 0.15;
static const double NEARLY = 0.9; /* of the best rating */
static const double COHERENCE = 0.22;
static const double TURN_LIKENESS = 0.75;
static const double SKEW = 0.15;

typedef struct square
{
    otx_run *run;
    int32_t side;
    int32_t x0, y0; /* in the picture */
    int32_t texel;  /* of the picture, along a side of one of the square */
    float *f;       /* [side * side] mean 0 */
} square;

/* A map of lags or of turns; (0, 0) is at (middle, middle). */
typedef struct lags
{
    int32_t reach; /* |x|, |y| <= reach */
    float *at;     /* [(2 reach + 1)^2] */
} lags;

const char *
otx_analysis_name(otx_analysis_class kind)
{
    static const char *const names[OTX_ANALYSIS_CLASS_COUNT] = {
        "isotropic", "directional", "weak-lattice", "lattice"};

    return (unsigned)kind < OTX_ANALYSIS_CLASS_COUNT ? names[kind] : "?";
}

/* -- filters ------------------------------------------------------------- */

/* One pass of a Gaussian along x from `from` to the transposed of `to`;
 * normalised by what of the kernel lies inside. */
static void
blur_rows(const float *from, float *to, int32_t n, const float *k, int32_t r)
{
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
        {
            const int32_t low = x < r ? -x : -r;
            const int32_t high = x + r >= n ? n - 1 - x : r;
            float sum = 0.0f, weight = 0.0f;

            for (int32_t i = low; i <= high; ++i)
            {
                sum += k[i] * from[(size_t)y * (size_t)n + (size_t)(x + i)];
                weight += k[i];
            }
            to[(size_t)x * (size_t)n + (size_t)y] = sum / weight;
        }
}

/* Gaussian blur of a square; `temp` is as large. */
static otx_status
blur(otx_run *run, const float *from, float *to, int32_t n, double sigma)
{
    const int32_t r = (int32_t)ceil(2.5 * sigma);
    float *kernel = OTX_NEW(run->scratch, float, 2 * r + 1);
    float *temp = OTX_NEW(run->scratch, float, (int64_t)n *n);

    if (!kernel || !temp)
        return otx_fail_memory(run, "exemplar");
    for (int32_t i = -r; i <= r; ++i)
        kernel[r + i] = (float)exp(-0.5 * i * i / (sigma * sigma));
    blur_rows(from, temp, n, kernel + r, r);
    blur_rows(temp, to, n, kernel + r, r);
    return OSDTEX_OK;
}

/* Mean luminance of a texel of the square. */
static float
box_mean(const square *s, const otx_image *lab, int32_t x, int32_t y)
{
    float sum = 0.0f;

    for (int32_t j = 0; j < s->texel; ++j)
        for (int32_t i = 0; i < s->texel; ++i)
            sum += *otx_image_at(
                lab, s->x0 + x * s->texel + i, s->y0 + y * s->texel + j);
    return sum / (float)(s->texel * s->texel);
}

/* Cuts the centre square out, small enough to be quick. */
static otx_status
cut_square(otx_run *run, const otx_image *lab, square *out)
{
    const int32_t shorter = lab->width < lab->height ? lab->width : lab->height;
    const int32_t texel = (shorter + SIDE_MAX - 1) / SIDE_MAX;
    const int32_t n = shorter / texel;
    const size_t texels = (size_t)n * (size_t)n;
    float *slow = OTX_NEW(run->scratch, float, texels);
    double sum = 0.0;

    *out = (square){
        run,
        n,
        (lab->width - n * texel) / 2,
        (lab->height - n * texel) / 2,
        texel,
        OTX_NEW(run->scratch, float, texels)};
    if (!slow || !out->f)
        return otx_fail_memory(run, "exemplar");
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            out->f[y * n + x] = box_mean(out, lab, x, y);
    OTX_TRY(blur(run, out->f, slow, n, n / 6.0));
    for (size_t i = 0; i < texels; ++i)
        slow[i] = out->f[i] - slow[i];
    OTX_TRY(blur(run, slow, out->f, n, fmax(0.7, n / 400.0)));
    for (size_t i = 0; i < texels; ++i)
        sum += out->f[i];
    for (size_t i = 0; i < texels; ++i)
        out->f[i] -= (float)(sum / (double)texels);
    return OSDTEX_OK;
}

/* -- correlation --------------------------------------------------------- */

/* FFT planes and what they are made into. */
typedef struct correlator
{
    otx_fft *fft;
    int32_t size; /* of the padded square */
    size_t stride;
    float *plane, *scratch, *spectrum, *out;
} correlator;

static otx_status
make_correlator(const square *s, correlator *out)
{
    otx_arena *a = s->run->scratch;

    out->size = otx_fft_good_size(2 * s->side);
    /* Making plans uses up the scratch arena; they are kept in the other. */
    OTX_TRY(
        otx_fft_create(s->run, s->run->arena, out->size, out->size, &out->fft));
    out->stride = otx_fft_stride(out->fft);
    out->plane = OTX_NEW(a, float, out->stride *(size_t)out->size);
    out->scratch = OTX_NEW(a, float, otx_fft_scratch_floats(out->fft));
    out->spectrum = OTX_NEW(a, float, otx_fft_spectrum_floats(out->fft));
    out->out = OTX_NEW(a, float, out->stride *(size_t)out->size);
    if (!out->plane || !out->scratch || !out->spectrum || !out->out)
        return otx_fail_memory(s->run, "exemplar");
    return OSDTEX_OK;
}

static void
fill_plane(const correlator *c, const float *f, int32_t n)
{
    memset(c->plane, 0, c->stride * (size_t)c->size * sizeof *c->plane);
    for (int32_t y = 0; y < n; ++y)
        memcpy(
            c->plane + (size_t)y * c->stride, f + (size_t)y * (size_t)n,
            (size_t)n * sizeof *f);
}

/* out(x0) = sum over x of a(x) b(x + x0), zero outside the squares. */
static otx_status
correlate(
    const square *s, correlator *c, const float *a, const float *b, lags *out)
{
    const int32_t r = out->reach, w = 2 * r + 1;
    float *const planes[1] = {c->plane};
    const float *const spectra[1] = {c->spectrum};
    const double scale = 1.0 / ((double)c->size * c->size);

    out->at = OTX_NEW(s->run->scratch, float, (int64_t)w *w);
    if (!out->at)
        return otx_fail_memory(s->run, "exemplar");
    fill_plane(c, b, s->side);
    otx_fft_forward(c->fft, 1.0f, c->plane, c->scratch, c->spectrum);
    fill_plane(c, a, s->side);
    otx_fft_correlate(c->fft, 1, s->side, planes, spectra, c->scratch, c->out);
    for (int32_t y = -r; y <= r; ++y)
        for (int32_t x = -r; x <= r; ++x)
            out->at[(y + r) * w + x + r] =
                (float)(scale * c->out[(size_t)((y + c->size) % c->size) * c->stride + (size_t)((x + c->size) % c->size)]);
    return OSDTEX_OK;
}

/* Sum of v over the overlap of the square with itself moved by (-x, -y), by a
 * table of sums over rectangles from the origin, [(n + 1)^2]. */
static double
overlap_sum(const double *table, int32_t n, int32_t x, int32_t y)
{
    const int32_t x0 = x > 0 ? 0 : -x, x1 = x > 0 ? n - x : n;
    const int32_t y0 = y > 0 ? 0 : -y, y1 = y > 0 ? n - y : n;
    const int32_t w = n + 1;

    return table[y1 * w + x1] - table[y0 * w + x1] - table[y1 * w + x0] +
           table[y0 * w + x0];
}

static double *
sum_table(const square *s, const float *f)
{
    const int32_t n = s->side, w = n + 1;
    double *table = OTX_ZNEW(s->run->scratch, double, (int64_t)w *w);

    for (int32_t y = 0; table && y < n; ++y)
    {
        double row = 0.0;

        for (int32_t x = 0; x < n; ++x)
        {
            row += (double)f[y * n + x] * f[y * n + x];
            table[(y + 1) * w + x + 1] = table[y * w + x + 1] + row;
        }
    }
    return table;
}

/* Normalised correlation of `a` with `b`: 1 where they are proportional. */
static otx_status
likeness(
    const square *s, correlator *c, const float *a, const float *b, lags *out)
{
    const int32_t r = out->reach, w = 2 * r + 1;
    const double *ta = sum_table(s, a), *tb = sum_table(s, b);

    if (!ta || !tb)
        return otx_fail_memory(s->run, "exemplar");
    OTX_TRY(correlate(s, c, a, b, out));
    for (int32_t y = -r; y <= r; ++y)
        for (int32_t x = -r; x <= r; ++x)
        {
            const double energy = overlap_sum(ta, s->side, x, y) *
                                  overlap_sum(tb, s->side, -x, -y);
            float *at = &out->at[(y + r) * w + x + r];

            *at = energy > 0.0 ? (float)(*at / sqrt(energy)) : 0.0f;
        }
    return OSDTEX_OK;
}

static double
sample(const lags *map, otx_vec2 p)
{
    const int32_t r = map->reach, w = 2 * r + 1;
    const double x = p.x + r, y = p.y + r;
    const int32_t i = (int32_t)floor(x), j = (int32_t)floor(y);
    const double u = x - i, v = y - j;
    const float *at = map->at + (size_t)j * (size_t)w + (size_t)i;

    if (i < 0 || j < 0 || i + 1 >= w || j + 1 >= w)
        return NAN;
    return (1 - v) * ((1 - u) * at[0] + u * at[1]) +
           v * ((1 - u) * at[w] + u * at[w + 1]);
}

/* -- structure tensor ---------------------------------------------------- */

typedef struct tensor
{
    double xx, xy, yy;
} tensor;

static tensor
sum_gradients(const float *f, int32_t n)
{
    tensor t = {0, 0, 0};

    for (int32_t y = 1; y + 1 < n; ++y)
        for (int32_t x = 1; x + 1 < n; ++x)
        {
            const double gx = f[y * n + x + 1] - f[y * n + x - 1];
            const double gy = f[(y + 1) * n + x] - f[(y - 1) * n + x];

            t.xx += gx * gx;
            t.xy += gx * gy;
            t.yy += gy * gy;
        }
    return t;
}

/* Skewness of the derivative along `d`: of a surface lit from the side, or of
 * shingles, up and down differ. */
static double
derivative_skew(const float *f, int32_t n, otx_vec2 d)
{
    double square_sum = 0.0, cube_sum = 0.0, count = 0.0;

    for (int32_t y = 1; y + 1 < n; ++y)
        for (int32_t x = 1; x + 1 < n; ++x)
        {
            const double g = d.x * (f[y * n + x + 1] - f[y * n + x - 1]) +
                             d.y * (f[(y + 1) * n + x] - f[(y - 1) * n + x]);

            square_sum += g * g;
            cube_sum += g * g * g;
            ++count;
        }
    return square_sum > 0.0
               ? fabs(cube_sum / count) / pow(square_sum / count, 1.5)
               : 0.0;
}

/* Coherence and grain direction over two sizes of detail. */
static otx_status
measure_direction(const square *s, otx_analysis *out)
{
    static const double sigmas[2] = {1.0, 3.0};
    float *g = OTX_NEW(s->run->scratch, float, (int64_t)s->side * s->side);
    double best = -1.0;

    if (!g)
        return otx_fail_memory(s->run, "exemplar");
    for (int k = 0; k < 2; ++k)
    {
        tensor t;
        double trace, split;

        OTX_TRY(blur(s->run, s->f, g, s->side, sigmas[k]));
        t = sum_gradients(g, s->side);
        trace = t.xx + t.yy;
        split = hypot(t.xx - t.yy, 2.0 * t.xy);
        if (!(trace > 0.0) || split / trace <= best)
            continue;
        best = split / trace;
        /* Gradients stand across the grain. */
        out->angle = 0.5 * atan2(2.0 * t.xy, t.xx - t.yy) + 0.5 * OTX_PI;
        out->skew = fmax(
            derivative_skew(g, s->side, otx_vec2_polar(out->angle)),
            derivative_skew(
                g, s->side, otx_vec2_polar(out->angle + 0.5 * OTX_PI)));
    }
    out->coherence = fmax(best, 0.0);
    return OSDTEX_OK;
}

/* -- lattice ------------------------------------------------------------- */

typedef struct peak
{
    otx_vec2 at;
    double value;
} peak;

/* Radius at which the correlation, averaged over a circle, has fallen to a
 * half: peaks closer than this are one. */
static double
correlation_length(const lags *map)
{
    for (double r = 1.0; r < map->reach; r += 1.0)
    {
        double sum = 0.0;

        for (int k = 0; k < 64; ++k)
            sum += sample(
                map, otx_vec2_scale(r, otx_vec2_polar(2.0 * OTX_PI * k / 64)));
        if (sum < 0.5 * 64)
            return r;
    }
    return map->reach;
}

static bool
is_peak(const lags *map, int32_t x, int32_t y)
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
refine_peak(const lags *map, int32_t x, int32_t y)
{
    const int32_t r = map->reach, w = 2 * r + 1;
    const float *at = map->at + (size_t)(y + r) * (size_t)w + (size_t)(x + r);

    return (otx_vec2){
        x + parabola(at[-1], at[0], at[1]), y + parabola(at[-w], at[0], at[w])};
}

/* Keeps `peaks` in descending order, at least `apart` from each other. Of a
 * lag and its opposite the upper one is kept. */
static int32_t
insert_peak(peak *peaks, int32_t count, peak p, double apart)
{
    int32_t i;

    for (i = 0; i < count; ++i)
        if (otx_vec2_length(otx_vec2_sub(peaks[i].at, p.at)) < apart)
        {
            if (peaks[i].value >= p.value)
                return count;
            memmove(
                &peaks[i], &peaks[i + 1],
                (size_t)(--count - i) * sizeof *peaks);
            --i;
        }
    for (i = count; i > 0 && peaks[i - 1].value < p.value; --i)
        if (i < PEAKS_MAX)
            peaks[i] = peaks[i - 1];
    if (i < PEAKS_MAX)
        peaks[i] = p;
    return count < PEAKS_MAX ? count + 1 : count;
}

static int32_t
find_peaks(const lags *map, peak peaks[PEAKS_MAX])
{
    const double apart = fmax(2.5, 1.2 * correlation_length(map));
    const int32_t r = map->reach, w = 2 * r + 1;
    int32_t count = 0;

    for (int32_t y = 0; y < r; ++y)
        for (int32_t x = 1 - r; x < r; ++x)
        {
            const peak p = {
                refine_peak(map, x, y), map->at[(y + r) * w + x + r]};

            if ((y == 0 && x <= 0) || p.value < 0.05 ||
                otx_vec2_length(p.at) < apart ||
                otx_vec2_length(p.at) > r - 1 || !is_peak(map, x, y))
                continue;
            count = insert_peak(peaks, count, p, apart);
        }
    return count;
}

/* Mean correlation at the points i g0 + j g1 + offset within reach. */
static double
mean_at(const lags *map, const otx_vec2 g[2], otx_vec2 offset, int32_t *count)
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
            sum += sample(map, p);
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

/* First the more horizontal to the right, then counter-clockwise. */
static void
order(otx_vec2 g[2])
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
fit_generators(const lags *map, otx_vec2 g[2])
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
                best = sample(map, (otx_vec2){x, y});
                for (bool up = true; up;)
                {
                    up = false;
                    for (int32_t k = 0; k < 9; ++k)
                    {
                        const int32_t nx = x + k % 3 - 1, ny = y + k / 3 - 1;
                        const double v = sample(map, (otx_vec2){nx, ny});

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
rate_pair(const lags *map, rated *l)
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
rate_peaks(const lags *map, const peak *a, const peak *b, rated *out)
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
static void
find_lattice(const lags *map, otx_analysis *out)
{
    peak peaks[PEAKS_MAX];
    const int32_t count = find_peaks(map, peaks);
    rated best = {.regularity = -INFINITY}, l;
    double most = -INFINITY, smallest = INFINITY;

    for (int32_t i = 0; i < count; ++i)
        for (int32_t j = 0; j < i; ++j)
            if (rate_peaks(map, &peaks[i], &peaks[j], &l))
                most = fmax(most, l.regularity + l.contrast);
    for (int32_t i = 0; i < count; ++i)
        for (int32_t j = 0; j < i; ++j)
        {
            if (!rate_peaks(map, &peaks[i], &peaks[j], &l) ||
                l.regularity + l.contrast < NEARLY * most ||
                fabs(otx_vec2_cross(l.g[0], l.g[1])) >= smallest)
                continue;
            smallest = (1.0 - 1e-6) * fabs(otx_vec2_cross(l.g[0], l.g[1]));
            best = l;
        }
    if (!isfinite(best.regularity))
        return;
    fit_generators(map, best.g);
    order(best.g);
    out->regularity = best.regularity;
    out->contrast = best.contrast;
    out->generators[0] = best.g[0];
    out->generators[1] = best.g[1];
}

/* Where the picture tiles, whole pictures are whole cells: G = S M^-1 for the
 * picture's sides S and whole numbers M, where that is close. */
static void
fit_to_picture(const otx_image *image, bool wrap_x, bool wrap_y, otx_vec2 g[2])
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

/* -- turns --------------------------------------------------------------- */

/* The best likeness of the square with itself turned, and for half turns the
 * point about which. */
static otx_status
measure_turn(
    const square *s, correlator *c, int quarters, double *value,
    otx_vec2 *centre)
{
    const int32_t n = s->side;
    float *turned = OTX_NEW(s->run->scratch, float, (int64_t)n *n);
    lags map = {.reach = (int32_t)((1.0 - sqrt(OVERLAP_SHARE)) * n)};
    const int32_t w = 2 * map.reach + 1;
    int32_t best = 0;

    if (!turned)
        return otx_fail_memory(s->run, "exemplar");
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            turned[y * n + x] = quarters == 2
                                    ? s->f[(n - 1 - y) * n + n - 1 - x]
                                    : s->f[(n - 1 - x) * n + y];
    /* turned(x) against f(x + lag): x' = n - 1 - x has the same colour. */
    OTX_TRY(likeness(s, c, turned, s->f, &map));
    for (int32_t i = 1; i < w * w; ++i)
        if (map.at[i] > map.at[best])
            best = i;
    *value = map.at[best];
    *centre = (otx_vec2){
        s->x0 + 0.5 * s->texel * (n + best % w - map.reach),
        s->y0 + 0.5 * s->texel * (n + best / w - map.reach)};
    return OSDTEX_OK;
}

/* -- the whole ----------------------------------------------------------- */

static void
classify(otx_analysis *a)
{
    const bool lattice =
        a->regularity >= LATTICE_REGULARITY && a->contrast >= LATTICE_CONTRAST;
    /* Where there is a grain it says more than a weak lattice. */
    const bool weak = !lattice && a->coherence < COHERENCE &&
                      a->regularity >= WEAK_REGULARITY &&
                      a->contrast >= WEAK_CONTRAST;
    bool even;

    a->kind = lattice                     ? OTX_ANALYSIS_LATTICE
              : weak                      ? OTX_ANALYSIS_WEAK_LATTICE
              : a->coherence >= COHERENCE ? OTX_ANALYSIS_DIRECTIONAL
                                          : OTX_ANALYSIS_ISOTROPIC;
    even = lattice ? a->half_turn >= TURN_LIKENESS : a->skew < SKEW;
    a->symmetry =
        a->quarter_turn >= TURN_LIKENESS && !(a->coherence >= COHERENCE) ? 4
        : even                                                           ? 2
                                                                         : 1;
    if (a->kind == OTX_ANALYSIS_ISOTROPIC)
        a->symmetry = 0;
    if (lattice || a->kind == OTX_ANALYSIS_ISOTROPIC)
        a->angle = 0.0;
    else if (weak)
    {
        const otx_vec2 *g = a->generators;
        const otx_vec2 s =
            otx_vec2_length(g[0]) <= otx_vec2_length(g[1]) ? g[0] : g[1];

        a->angle = atan2(s.y, s.x);
    }
    a->angle -= OTX_PI * floor(a->angle / OTX_PI);
    if (!lattice && !weak)
        a->generators[0] = a->generators[1] = (otx_vec2){0, 0};
}

static otx_status
measure(const square *s, otx_analysis *out)
{
    lags map = {.reach = (int32_t)(LAG_SHARE * s->side)};
    correlator c;
    otx_vec2 unused;

    OTX_TRY(measure_direction(s, out));
    OTX_TRY(make_correlator(s, &c));
    OTX_TRY(likeness(s, &c, s->f, s->f, &map));
    find_lattice(&map, out);
    OTX_TRY(measure_turn(s, &c, 2, &out->half_turn, &out->centre));
    return measure_turn(s, &c, 1, &out->quarter_turn, &unused);
}

otx_status
otx_analysis_run(
    otx_run *run, const otx_image *lab, bool wrap_x, bool wrap_y,
    otx_analysis *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    square s;

    *out = (otx_analysis){0};
    OTX_TRY(cut_square(run, lab, &s));
    OTX_TRY(measure(&s, out));
    classify(out);
    for (int k = 0; k < 2; ++k)
        out->generators[k] = otx_vec2_scale(s.texel, out->generators[k]);
    if (out->kind == OTX_ANALYSIS_LATTICE)
        fit_to_picture(lab, wrap_x, wrap_y, out->generators);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_analysis_force_lattice(
    otx_run *run, const otx_image *lab, const otx_vec2 generators[2],
    otx_analysis *out)
{
    otx_vec2 g[2] = {generators[0], generators[1]};
    const double a = otx_vec2_length(g[0]), b = otx_vec2_length(g[1]);
    const double longest = hypot(lab->width, lab->height);

    /* Written so that NaN is refused too. */
    if (!(fabs(otx_vec2_cross(g[0], g[1])) >= 0.1 * a * b) || !(a >= 4.0) ||
        !(b >= 4.0) || a > longest || b > longest)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "exemplar", OTX_NOWHERE,
            "the generators (%g, %g) and (%g, %g) do not span a lattice cell "
            "inside the picture",
            g[0].x, g[0].y, g[1].x, g[1].y);
    OTX_TRY(otx_analysis_run(run, lab, false, false, out));
    order(g);
    out->kind = OTX_ANALYSIS_LATTICE;
    out->generators[0] = g[0];
    out->generators[1] = g[1];
    out->symmetry = out->half_turn >= TURN_LIKENESS ? 2 : 1;
    out->angle = 0.0;
    return OSDTEX_OK;
}

/* lags.c -- how like itself a square is when it is moved. */
#include "analysis/lags.h"

#include "image/view.h"

#include <string.h>

otx_status
otx_lags_prepare(const otx_square *s, otx_lags_correlator *out)
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
    OTX_TRY(otx_run_ok(s->run));
    return OSDTEX_OK;
}

static void
fill_plane(const otx_lags_correlator *c, const float *f, int32_t n)
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
    const otx_square *s, otx_lags_correlator *c, const float *a, const float *b,
    otx_lags *out)
{
    const int32_t r = out->reach, w = 2 * r + 1;
    float *const planes[1] = {c->plane};
    const float *const spectra[1] = {c->spectrum};
    const double scale = 1.0 / ((double)c->size * c->size);

    out->at = OTX_NEW(s->run->scratch, float, (int64_t)w *w);
    OTX_TRY(otx_run_ok(s->run));
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
sum_table(const otx_square *s, const float *f)
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

otx_status
otx_lags_likeness(
    const otx_square *s, otx_lags_correlator *c, const float *a, const float *b,
    otx_lags *out)
{
    const int32_t r = out->reach, w = 2 * r + 1;
    const double *ta = sum_table(s, a), *tb = sum_table(s, b);

    OTX_TRY(otx_run_ok(s->run));
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

double
otx_lags_at(const otx_lags *map, otx_vec2 p)
{
    const int32_t r = map->reach, w = 2 * r + 1;
    const double x = p.x + r, y = p.y + r;
    const int32_t i = (int32_t)floor(x), j = (int32_t)floor(y);
    const double u = x - i, v = y - j;
    const float *at = map->at + (size_t)j * (size_t)w + (size_t)i;

    if (i < 0 || j < 0 || i + 1 >= w || j + 1 >= w)
        return NAN;
    return otx_view_mix(at[0], at[1], at[w], at[w + 1], u, v);
}

/* Mean correlation from `near` to `far` texels away. */
static double
mean_along(const otx_lags *map, double angle, double near, double far)
{
    const otx_vec2 d = otx_vec2_polar(angle);
    double sum = 0.0;
    int32_t count = 0;

    for (double r = near; r <= far; r += 1.0, ++count)
        sum += otx_lags_at(map, otx_vec2_scale(r, d));
    return count > 0 ? sum / count : 0.0;
}

double
otx_lags_ridge(
    const otx_lags *map, double about, double within, double *likeness)
{
    const double last = 0.95 * map->reach;
    const double step = OTX_PI / 720;
    const otx_vec2 across = otx_vec2_polar(about + 0.5 * OTX_PI);
    double width = 1.0, best = -INFINITY, found = about;
    bool inside = true;

    while (width < last &&
           otx_lags_at(map, otx_vec2_scale(width, across)) >= 0.5)
        width += 0.5;
    /* Beyond a course's own height all that differs from it has its say. */
    const double near = fmax(3.0, 1.5 * width);
    const double far = fmin(last, fmax(10.0 * width, last / 3));

    for (double turn = 0.0; turn <= within; turn += step)
        for (int side = -1; side <= 1; side += 2)
        {
            const double angle = about + side * turn;
            const double v = mean_along(map, angle, near, far);

            if (!(v > best))
                continue;
            best = v;
            found = angle;
            inside = turn + step <= within;
        }
    if (likeness)
        *likeness = best;
    return inside ? found : about;
}

/* grain.c -- the direction in which a picture changes least. */
#include "analysis/grain.h"

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

otx_status
otx_grain_measure(const otx_square *s, otx_grain *out)
{
    static const double sigmas[2] = {1.0, 3.0};
    float *g = OTX_NEW(s->run->scratch, float, (int64_t)s->side * s->side);
    double best = -1.0;

    OTX_TRY(otx_run_ok(s->run));
    for (int k = 0; k < 2; ++k)
    {
        tensor t;
        double trace, split;

        OTX_TRY(otx_square_blur(s->run, s->f, g, s->side, sigmas[k]));
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

otx_status
otx_grain_slope(const otx_square *s, double angle, float **out)
{
    const int32_t n = s->side;
    const otx_vec2 d = otx_vec2_polar(angle);
    float *g = OTX_NEW(s->run->scratch, float, (int64_t)n *n);
    float *f = OTX_ZNEW(s->run->scratch, float, (int64_t)n *n);
    double sum = 0.0;

    OTX_TRY(otx_run_ok(s->run));
    OTX_TRY(otx_square_blur(s->run, s->f, g, n, fmax(1.0, n / 256.0)));
    for (int32_t y = 1; y + 1 < n; ++y)
        for (int32_t x = 1; x + 1 < n; ++x)
        {
            f[y * n + x] =
                (float)(d.x * (g[y * n + x + 1] - g[y * n + x - 1]) + d.y * (g[(y + 1) * n + x] - g[(y - 1) * n + x]));
            sum += f[y * n + x];
        }
    for (int32_t i = 0; i < n * n; ++i)
        f[i] -= (float)(sum / ((double)n * n));
    *out = f;
    return OSDTEX_OK;
}

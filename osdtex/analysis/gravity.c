/* gravity.c -- does a picture have a top? */
#include "analysis/gravity.h"

/* What masonry, text and tiles have, and grain, weaves and gravel lack; see
 * docs/notes/analysis.md. */
static const double LEVEL = 0.45, LEVEL_OVER_PLUMB = 2.0, ACROSS_MOST = 8.0;
static const double SKEW = 0.35, SKEW_ASIDE = 0.33;

/* Lag of the likenesses, as a share of the side. */
static const double LAG = 0.12;

/* Sums over the gradient of a blurred square. */
typedef struct slopes
{
    double xx, yy;     /* squares */
    double xxx, yyy;   /* cubes */
    double x_up, y_on; /* products of d/dx a lag up, and of d/dy a lag on */
    double x_at, y_at; /* squares of those that have such a partner */
} slopes;

static double
slope(const float *g, int32_t n, int32_t x, int32_t y, int32_t step)
{
    const int32_t at = y * n + x;

    return (double)g[at + step] - (double)g[at - step];
}

/* But for a margin, within which the blur sees the border. */
static slopes
sum_slopes(const float *g, int32_t n, int32_t margin, int32_t lag)
{
    slopes s = {0};

    for (int32_t y = margin; y < n - margin; ++y)
        for (int32_t x = margin; x < n - margin; ++x)
        {
            const double dx = slope(g, n, x, y, 1);
            const double dy = slope(g, n, x, y, n);

            s.xx += dx * dx;
            s.yy += dy * dy;
            s.xxx += dx * dx * dx;
            s.yyy += dy * dy * dy;
            if (y + lag < n - margin)
            {
                s.x_up += dx * slope(g, n, x, y + lag, 1);
                s.x_at += dx * dx;
            }
            if (x + lag < n - margin)
            {
                s.y_on += dy * slope(g, n, x + lag, y, n);
                s.y_at += dy * dy;
            }
        }
    return s;
}

static double
skew_of(double squares, double cubes, double count)
{
    return squares > 0.0 ? fabs(cubes) / count / pow(squares / count, 1.5)
                         : 0.0;
}

static bool
is_upright(const otx_gravity *g)
{
    const bool rows = g->level >= LEVEL &&
                      g->level >= LEVEL_OVER_PLUMB * g->plumb &&
                      g->across <= ACROSS_MOST;
    const bool lit = g->skew_y >= SKEW && g->skew_x <= SKEW_ASIDE * g->skew_y;

    return rows || lit;
}

otx_status
otx_gravity_measure(const otx_square *square, otx_gravity *out)
{
    const int32_t n = square->side, lag = (int32_t)(LAG * n);
    float *g = OTX_NEW(square->run->scratch, float, (int64_t)n *n);

    *out = (otx_gravity){.skew_y = INFINITY};
    OTX_TRY(otx_run_ok(square->run));
    for (int k = 0; k < 2; ++k)
    {
        const double sigma = (k + 1) * fmax(1.0, n / 256.0);
        const int32_t margin = (int32_t)(3.0 * sigma) + 2;
        const double count = (double)(n - 2 * margin) * (n - 2 * margin);
        slopes s;

        if (n < 2 * margin + 2 * lag || lag < 1)
            return OSDTEX_OK;
        OTX_TRY(otx_square_blur(square->run, square->f, g, n, sigma));
        s = sum_slopes(g, n, margin, lag);
        out->skew_y = fmin(out->skew_y, skew_of(s.yy, s.yyy, count));
        out->skew_x = fmax(out->skew_x, skew_of(s.xx, s.xxx, count));
        out->level = s.y_at > 0.0 ? s.y_on / s.y_at : 0.0;
        out->plumb = s.x_at > 0.0 ? s.x_up / s.x_at : 0.0;
        out->across = s.xx > 0.0 ? s.yy / s.xx : INFINITY;
    }
    out->upright = is_upright(out);
    return OSDTEX_OK;
}

/* mask_distance.c -- one axis after the other; a line is laid out three times.
 */
#include "image/mask_distance.h"

#include <math.h>

/* Room for the longest line, three times. */
typedef struct envelope
{
    double *from;    /* [3 n] squared distances so far */
    double *borders; /* [3 n + 1] where the next parabola takes over */
    int32_t *tops;   /* [3 n] of the parabolas */
} envelope;

static bool
is_far(double value)
{
    return value == (double)INFINITY;
}

/* Where the parabola on top of q passes the one on top of p. */
static double
meeting(const double *f, int32_t p, int32_t q)
{
    const double at_p = f[p] + (double)p * p, at_q = f[q] + (double)q * q;

    return (at_q - at_p) / (2.0 * (q - p));
}

static int32_t
lay_parabolas(const envelope *e, int32_t count)
{
    int32_t top = -1;

    for (int32_t q = 0; q < count; ++q)
    {
        double s = -(double)INFINITY;

        if (is_far(e->from[q]))
            continue;
        while (top >= 0 &&
               (s = meeting(e->from, e->tops[top], q)) <= e->borders[top])
            --top;
        ++top;
        e->tops[top] = q;
        e->borders[top] = top == 0 ? -(double)INFINITY : s;
        e->borders[top + 1] = (double)INFINITY;
    }
    return top + 1;
}

/* Squared distances along a line of n that closes, in place. */
static void
sweep(const envelope *e, double *line, ptrdiff_t stride, int32_t n)
{
    int32_t count, k = 0;

    for (int32_t i = 0; i < 3 * n; ++i)
        e->from[i] = line[(ptrdiff_t)(i % n) * stride];
    count = lay_parabolas(e, 3 * n);
    if (count == 0)
        return;
    for (int32_t i = 0; i < 2 * n; ++i)
    {
        while (e->borders[k + 1] < i)
            ++k;
        if (i >= n)
        {
            const double away = i - e->tops[k];

            line[(ptrdiff_t)(i - n) * stride] =
                away * away + e->from[e->tops[k]];
        }
    }
}

/* Squared distances to the nearest texel that is in the mask, or is not. */
static void
squared(
    const envelope *e, const uint8_t *mask, bool in, int32_t width,
    int32_t height, double *out)
{
    const int64_t texels = (int64_t)width * height;

    for (int64_t i = 0; i < texels; ++i)
        out[i] = (mask[i] != 0) == in ? 0.0 : (double)INFINITY;
    for (int32_t x = 0; x < width; ++x)
        sweep(e, out + x, width, height);
    for (int32_t y = 0; y < height; ++y)
        sweep(e, out + (ptrdiff_t)y * width, 1, width);
}

otx_status
otx_mask_distance(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    float *out)
{
    const int64_t texels = (int64_t)width * height;
    const int64_t line = 3 * (int64_t)(width > height ? width : height);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const envelope e = {
        OTX_NEW(run->scratch, double, line),
        OTX_NEW(run->scratch, double, line + 1),
        OTX_NEW(run->scratch, int32_t, line)};
    double *away = OTX_NEW(run->scratch, double, texels);

    OTX_TRY(otx_run_ok(run));
    squared(&e, mask, true, width, height, away);
    for (int64_t i = 0; i < texels; ++i)
        out[i] = (float)(0.5 - sqrt(away[i]));
    squared(&e, mask, false, width, height, away);
    for (int64_t i = 0; i < texels; ++i)
        if (mask[i])
            out[i] = (float)(sqrt(away[i]) - 0.5);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

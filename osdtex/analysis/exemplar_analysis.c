/* exemplar_analysis.c -- what structure an exemplar has. */
#include "analysis/exemplar_analysis.h"

/* Of the variance of all channels, that one worth a look has at the least; and
 * of its own, that lightness explains at the most. */
static const double SHARE_LEAST = 0.25, EXPLAINED_MOST = 0.5;

/* Second moments of a channel of `match`, and with lightness. */
typedef struct moments
{
    double variance, explained; /* share of it that lightness explains */
} moments;

static moments
measure(const otx_exemplar *e, int channel)
{
    const int64_t n = (int64_t)e->match.width * e->match.height;
    double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

    for (int64_t i = 0; i < n; ++i)
    {
        const double x = e->match.pixels[3 * i + channel];
        const double y = e->lab.pixels[3 * i];

        a += x;
        b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    aa = aa / (double)n - a / (double)n * (a / (double)n);
    bb = bb / (double)n - b / (double)n * (b / (double)n);
    ab = ab / (double)n - a / (double)n * (b / (double)n);
    return (moments){aa, aa * bb > 0.0 ? ab * ab / (aa * bb) : 0.0};
}

bool
otx_exemplar_analysis_channel(const otx_exemplar *e, otx_image *out)
{
    moments m[3];
    double all = 0.0, most = 0.0;
    int best = -1;

    if (e->match.width != e->lab.width || e->match.height != e->lab.height)
        return false;
    for (int k = 0; k < 3; ++k)
    {
        m[k] = measure(e, k);
        all += m[k].variance;
    }
    for (int k = 0; k < 3; ++k)
        if (m[k].variance >= SHARE_LEAST * all && m[k].variance > most &&
            m[k].explained <= EXPLAINED_MOST)
        {
            most = m[k].variance;
            best = k;
        }
    if (best < 0)
        return false;
    /* What is looked at is the first channel. */
    *out = e->match;
    out->pixels += best;
    return true;
}

otx_status
otx_exemplar_analysis(otx_run *run, const otx_exemplar *e, otx_analysis *out)
{
    otx_analysis other;
    otx_image channel;

    OTX_TRY(otx_analysis_run(run, &e->lab, e->wrap_x, e->wrap_y, out));
    if (out->kind == OTX_ANALYSIS_LATTICE ||
        !otx_exemplar_analysis_channel(e, &channel))
        return OSDTEX_OK;
    OTX_TRY(otx_analysis_run(run, &channel, e->wrap_x, e->wrap_y, &other));
    if (other.kind == OTX_ANALYSIS_LATTICE)
        *out = other;
    return OSDTEX_OK;
}

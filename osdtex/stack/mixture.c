/* mixture.c -- means, then deviations. */
#include "stack/mixture.h"

#include <math.h>
#include <string.h>

typedef struct moments
{
    double mean, deviation, low, high;
} moments;

/* Whether a channel is mixed by cube roots. */
static bool
is_seen(const otx_mixture *m, int32_t channel)
{
    return m->as_seen && !(m->plain >> channel & 1u);
}

/* Of a channel, as `texels` show it; NULL: as it is.
 *
 *   rooted  its cube roots */
static moments
moments_of(
    const otx_image *image, const int32_t *texels, int32_t channel, bool rooted)
{
    const int64_t count = (int64_t)image->width * image->height;
    double sum = 0.0, squares = 0.0, low = (double)INFINITY,
           high = -(double)INFINITY;

    for (int64_t i = 0; i < count; ++i)
    {
        const int64_t at = texels ? texels[i] : i;
        const double is = (double)image->pixels[at * image->channels + channel];
        const double v = rooted ? cbrt(is) : is;

        sum += v;
        squares += v * v;
        low = fmin(low, v);
        high = fmax(high, v);
    }
    sum /= (double)count;
    return (moments){
        sum, sqrt(fmax(squares / (double)count - sum * sum, 0.0)), low, high};
}

static void
copy(const otx_image *image, const int32_t *texels, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;
    const int32_t channels = out->channels;

    for (int64_t i = 0; i < count; ++i)
        memcpy(
            out->pixels + i * channels,
            image->pixels + (int64_t)texels[i] * channels,
            (size_t)channels * sizeof *out->pixels);
}

/* Of cube roots where it is mixed by them. */
static void
mean(const otx_mixture *m, int32_t channel, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;
    const int64_t channels = out->channels;
    const bool rooted = is_seen(m, channel);

    for (int64_t i = 0; i < count; ++i)
    {
        const double a =
            (double)m->from->pixels[m->from_texels[i] * channels + channel];
        const double b =
            (double)m->to->pixels[m->to_texels[i] * channels + channel];

        out->pixels[i * channels + channel] =
            (float)((1.0 - m->weight) * (rooted ? cbrt(a) : a) + m->weight * (rooted ? cbrt(b) : b));
    }
}

static void
unroot(const otx_mixture *m, int32_t channel, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;

    for (int64_t i = 0; i < count && is_seen(m, channel); ++i)
    {
        float *v = &out->pixels[i * out->channels + channel];

        *v = *v * *v * *v;
    }
}

static void
stretch(const otx_mixture *m, int32_t channel, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;
    const moments is = moments_of(out, NULL, channel, false);
    const moments a =
        moments_of(m->from, m->from_texels, channel, is_seen(m, channel));
    const moments b =
        moments_of(m->to, m->to_texels, channel, is_seen(m, channel));
    const double wanted =
        (1.0 - m->weight) * a.deviation + m->weight * b.deviation;
    const double gain = is.deviation > 0.0 ? wanted / is.deviation : 1.0;
    const double low = m->bounded                     ? fmin(a.low, b.low)
                       : a.low >= 0.0 && b.low >= 0.0 ? 0.0
                                                      : -(double)INFINITY;
    const double high = m->bounded ? fmax(a.high, b.high) : (double)INFINITY;

    for (int64_t i = 0; i < count; ++i)
    {
        float *v = &out->pixels[i * out->channels + channel];

        *v = (float)fmin(
            fmax(is.mean + gain * ((double)*v - is.mean), low), high);
    }
}

otx_status
otx_mixture_make(otx_run *run, const otx_mixture *mixture, otx_image *out)
{
    const otx_image *from = mixture->from;

    OTX_TRY(otx_image_create(
        run, run->arena, from->width, from->height, from->channels, out));
    if (!mixture->to_texels)
        copy(from, mixture->from_texels, out);
    else if (!mixture->from_texels)
        copy(mixture->to, mixture->to_texels, out);
    else
        for (int32_t c = 0; c < out->channels; ++c)
        {
            mean(mixture, c, out);
            if (!(mixture->plain >> c & 1u))
                stretch(mixture, c, out);
            unroot(mixture, c, out);
        }
    return OSDTEX_OK;
}

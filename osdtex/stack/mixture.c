/* mixture.c -- means, then deviations. */
#include "stack/mixture.h"

#include <math.h>
#include <string.h>

typedef struct moments
{
    double mean, deviation, low, high;
} moments;

/* Of a channel, as `texels` show it; NULL: as it is. */
static moments
moments_of(const otx_image *image, const int32_t *texels, int32_t channel)
{
    const int64_t count = (int64_t)image->width * image->height;
    double sum = 0.0, squares = 0.0, low = (double)INFINITY,
           high = -(double)INFINITY;

    for (int64_t i = 0; i < count; ++i)
    {
        const int64_t at = texels ? texels[i] : i;
        const double v = (double)image->pixels[at * image->channels + channel];

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

static void
mean(const otx_mixture *m, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;
    const int32_t channels = out->channels;
    const float b = (float)m->weight, a = 1.0f - b;

    for (int64_t i = 0; i < count; ++i)
        for (int32_t c = 0; c < channels; ++c)
            out->pixels[i * channels + c] =
                a * m->from->pixels[(int64_t)m->from_texels[i] * channels + c] +
                b * m->to->pixels[(int64_t)m->to_texels[i] * channels + c];
}

static void
stretch(const otx_mixture *m, int32_t channel, otx_image *out)
{
    const int64_t count = (int64_t)out->width * out->height;
    const moments is = moments_of(out, NULL, channel);
    const moments a = moments_of(m->from, m->from_texels, channel);
    const moments b = moments_of(m->to, m->to_texels, channel);
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
    {
        mean(mixture, out);
        for (int32_t c = 0; c < out->channels; ++c)
            if (!(mixture->plain >> c & 1u))
                stretch(mixture, c, out);
    }
    return OSDTEX_OK;
}

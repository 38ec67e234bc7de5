/* pyramid.c -- mip levels by a box of the true source area.
 *
 * The filter is separable: texel i of n covers [i s, (i + 1) s) of a source
 * side, s = side / n. s is 2 for even sides and at most 3 (3 texels to 1), so
 * a texel has up to four sources an axis. */
#include "image/pyramid.h"

enum
{
    MAX_SOURCES = 4
};

/* Sources of one texel along one axis; the weights sum to 1. */
typedef struct span
{
    int32_t first;
    int32_t count;
    double weights[MAX_SOURCES];
} span;

int32_t
otx_pyramid_count(int32_t width, int32_t height)
{
    int32_t side = width > height ? width : height;
    int32_t count = 1;

    for (; side > 1; side >>= 1)
        ++count;
    return count;
}

/* In units of 1/n texel all bounds are integers, so weights are exact up to
 * one division and the span never reaches past the side. */
static span
span_of(int32_t i, int32_t n, int32_t side)
{
    const int64_t begin = (int64_t)i * side;
    const int64_t end = begin + side;
    span s = {(int32_t)(begin / n), 0, {0.0}};

    for (int64_t at = begin; at < end; ++s.count)
    {
        const int64_t texel_end = (at / n + 1) * n;
        const int64_t next = texel_end < end ? texel_end : end;

        s.weights[s.count] = (double)(next - at) / side;
        at = next;
    }
    return s;
}

static void
reduce_texel(const otx_image *image, span sx, span sy, float *color)
{
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};

    for (int32_t j = 0; j < sy.count; ++j)
        for (int32_t i = 0; i < sx.count; ++i)
        {
            const float *c = otx_image_at(image, sx.first + i, sy.first + j);
            const double weight = sx.weights[i] * sy.weights[j];

            for (int32_t k = 0; k < image->channels; ++k)
                sum[k] += weight * c[k];
        }
    for (int32_t k = 0; k < image->channels; ++k)
        color[k] = (float)sum[k];
}

otx_status
otx_pyramid_reduce(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_image *out)
{
    OTX_TRY(otx_image_create(
        run, arena, otx_pyramid_side(image->width, 1),
        otx_pyramid_side(image->height, 1), image->channels, out));
    for (int32_t y = 0; y < out->height; ++y)
    {
        const span sy = span_of(y, out->height, image->height);

        for (int32_t x = 0; x < out->width; ++x)
            reduce_texel(
                image, span_of(x, out->width, image->width), sy,
                otx_image_at(out, x, y));
    }
    return OSDTEX_OK;
}

otx_status
otx_pyramid_build(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_pyramid *out)
{
    *out =
        (otx_pyramid){.count = otx_pyramid_count(image->width, image->height)};
    out->levels[0] = *image;
    for (int32_t level = 1; level < out->count; ++level)
        OTX_TRY(otx_pyramid_reduce(
            run, arena, &out->levels[level - 1], &out->levels[level]));
    return OSDTEX_OK;
}

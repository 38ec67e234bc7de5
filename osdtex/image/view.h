/* view.h -- a picture as a function over the plane.
 *
 * The only place where texel positions beyond the border are brought back (on
 * a picture that tiles they wrap, on another they are held at the border) and
 * where neighbouring texels are interpolated. Positions are in texels: texel
 * (x, y) has its centre at (x + 1/2, y + 1/2).
 *
 *     const otx_image_view view = otx_view_of(picture, wrap_x, wrap_y);
 *     float color[3];
 *
 *     otx_view_value(view, texel, color);
 *
 * Views are small and passed by value; they borrow the picture. All functions
 * may be called from several threads. Where nothing wraps or is held, which is
 * most of the time, a lookup is inline, and a line takes one test for all of
 * its samples. */
#ifndef OTX_IMAGE_VIEW_H
#define OTX_IMAGE_VIEW_H

#include "image/image.h"

#include <math.h>

typedef struct otx_image_view
{
    const otx_image *image;
    bool wrap_x, wrap_y;
} otx_image_view;

static inline otx_image_view
otx_view_of(const otx_image *image, bool wrap_x, bool wrap_y)
{
    return (otx_image_view){image, wrap_x, wrap_y};
}

/* The multiple of `size` at or below a position. */
static inline double
otx_view_period(double x, int32_t size)
{
    return size * floor(x / size);
}

/* A position brought back into [0, size] by whole periods. The end is reached
 * where a position just below 0 is rounded. */
static inline double
otx_view_wrap(double x, int32_t size)
{
    return x - otx_view_period(x, size);
}

/* The texel that index `i` shows along an axis of `size` texels. */
static inline int32_t
otx_view_fold(int32_t i, int32_t size, bool wrap)
{
    if (i >= 0 && i < size)
        return i;
    if (wrap)
    {
        i %= size;
        return i < 0 ? i + size : i;
    }
    return i < 0 ? 0 : size - 1;
}

/* Bilinear between four values; u and v in [0, 1] lead from the first of each
 * pair to the second. A constant stays that constant, to the bit. */
static inline double
otx_view_mix(
    double below_0, double below_1, double above_0, double above_1, double u,
    double v)
{
    const double below = (1.0 - u) * below_0 + u * below_1;
    const double above = (1.0 - u) * above_0 + u * above_1;

    return (1.0 - v) * below + v * above;
}

/* The same for `channels` values: of the texel below and the one to its right,
 * and of the two above. */
static inline void
otx_view_mix_texels(
    const float *low, const float *high, int32_t channels, double u, double v,
    float *restrict color)
{
    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)otx_view_mix(
            low[c], low[c + channels], high[c], high[c + channels], u, v);
}

/* Of a position beyond the middles of the outermost texels, and of NaN and
 * infinities, which land on a texel too. */
void
otx_view_value_at_border(otx_image_view view, otx_vec2 texel, float *color);

/* The value at a position.
 *
 *   color  [view.image->channels], out */
static inline void
otx_view_value(otx_image_view view, otx_vec2 texel, float *color)
{
    const otx_image *image = view.image;
    const double x = texel.x - 0.5, y = texel.y - 0.5;

    if (!(x >= 0.0 && y >= 0.0 && x < image->width - 1 &&
          y < image->height - 1))
    {
        otx_view_value_at_border(view, texel, color);
        return;
    }

    const int32_t i = (int32_t)x, j = (int32_t)y;
    const float *low = otx_image_at(image, i, j);
    const float *high = low + (size_t)image->width * (size_t)image->channels;

    /* Loops of a known length, which take half the time. */
    switch (image->channels)
    {
    case 1:
        otx_view_mix_texels(low, high, 1, x - i, y - j, color);
        return;
    case 3:
        otx_view_mix_texels(low, high, 3, x - i, y - j, color);
        return;
    case 6:
        otx_view_mix_texels(low, high, 6, x - i, y - j, color);
        return;
    case 7:
        otx_view_mix_texels(low, high, 7, x - i, y - j, color);
        return;
    default:
        otx_view_mix_texels(low, high, image->channels, x - i, y - j, color);
    }
}

/* The value at a position and its derivative by the position, per texel. The
 * derivative is that of the bilinear surface: it jumps at texel centres.
 *
 *   color, slope  [3], out; the picture has three channels or more */
void otx_view_slope(
    otx_image_view view, otx_vec2 texel, double color[3], otx_vec2 slope[3]);

/* Values along a segment, at the middles of `count` equal pieces of it.
 *
 *   ends    texel positions
 *   offset  texels to the left of ends[0] -> ends[1]
 *   colors  [count * 3], out; the picture has three channels */
void otx_view_line(
    otx_image_view view, const otx_vec2 ends[2], double offset, int32_t count,
    float *colors);

#endif

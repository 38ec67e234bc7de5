/* plane.h -- the match image at one resolution, ready to be compared with.
 *
 * A plane of level l has about N / 2^l pixels a side. Texel centres of all
 * levels agree: pixel coordinate = texel coordinate / `pixel`, with its own
 * factor per axis, because a tiling exemplar of odd size must keep its period
 * exactly and is then resampled by a factor that is not a power of two. */
#ifndef OTX_MATCH_PLANE_H
#define OTX_MATCH_PLANE_H

#include "image/view.h"
#include "math/fft.h"

enum
{
    OTX_PLANE_LANES = 4,  /* floats of a pixel; channels beyond are zero */
    OTX_PLANE_APRON = 4,  /* pixels repeated around the plane */
    OTX_PLANE_SPECTRA = 5 /* -2 T_c for each channel, and sum_c T_c^2 */
};

typedef struct otx_plane
{
    int32_t width;
    int32_t height;
    int32_t channels;
    int32_t level; /* halvings */
    bool wrap_x;
    bool wrap_y;
    otx_vec2 pixel; /* size of a pixel, texels of the exemplar */

    float *pixels; /* [(height + 2 APRON) * row_floats], mean subtracted; the
                    * apron repeats what tiles and clamps what does not */
    size_t row_floats;

    const otx_fft *fft; /* NULL where the level is not searched */
    int32_t fft_width;  /* = width where it tiles, else padded with zeros, and
                         * in the sum of squares with `beyond` */
    int32_t fft_height;
    /* What a mask shows beyond the rim costs its squared distance from the mean
     * colour, and this. */
    double beyond;
    int32_t pad_x, pad_y; /* of these, before the first column and row;
                           * there are as many behind the last */
    /* Divided by fft_width * fft_height, so that a correlation needs no
     * further factor. The weights go with spectra[channels]. */
    float *spectra[OTX_PLANE_SPECTRA];
} otx_plane;

/* x in [-APRON, width + APRON), y likewise. */
static inline float *
otx_plane_at(const otx_plane *plane, int32_t x, int32_t y)
{
    return plane->pixels + (size_t)(y + OTX_PLANE_APRON) * plane->row_floats +
           (size_t)(x + OTX_PLANE_APRON) * OTX_PLANE_LANES;
}

/* Brings a pixel coordinate into [0, size) where it wraps, else to the
 * nearest pixel centre. */
static inline double
otx_plane_wrap(double x, int32_t size, bool wrap)
{
    if (!wrap)
        return x < 0.5 ? 0.5 : x > size - 0.5 ? size - 0.5 : x;
    if (x >= 0.0 && x < size)
        return x;
    /* Mostly it is the next period: no division, no call of floor. */
    const double near = x < 0.0 ? x + size : x - size;

    if (near >= 0.0 && near < size)
        return near;
    x = otx_view_wrap(x, size);
    return x < size ? x : 0.0; /* -epsilon rounds up to size */
}

/* Bilinear sample at pixel coordinates that otx_plane_wrap has brought in. */
static inline void
otx_plane_sample(
    const otx_plane *plane, double x, double y, float color[OTX_PLANE_LANES])
{
    /* + 1 keeps the truncation a floor for x in [0, 1/2). */
    const int32_t i = (int32_t)(x + 0.5) - 1;
    const int32_t j = (int32_t)(y + 0.5) - 1;
    const float u = (float)(x - 0.5 - i);
    const float v = (float)(y - 0.5 - j);
    const float *a = otx_plane_at(plane, i, j);
    const float *b = a + plane->row_floats;
    const float w00 = (1.0f - u) * (1.0f - v);
    const float w10 = u * (1.0f - v);
    const float w01 = (1.0f - u) * v;
    const float w11 = u * v;

    for (int k = 0; k < OTX_PLANE_LANES; ++k)
        color[k] = w00 * a[k] + w10 * a[k + OTX_PLANE_LANES] + w01 * b[k] +
                   w11 * b[k + OTX_PLANE_LANES];
}

/* Whether pixel x lies beyond the rim of what does not tile. */
static inline bool
otx_plane_ends(int32_t x, int32_t size, bool wrap)
{
    return !wrap && (x < 0 || x >= size);
}

/* Resamples `match` to the plane of `level` in run->arena, less `mean`
 * [channels], by exact area averages; with spectra when `searched`.
 *
 *   overhang  texels by which masks may reach over the rim
 *   beyond    what they cost there, see otx_plane */
otx_status otx_plane_create(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    int32_t level, const double *mean, otx_vec2 overhang, double beyond,
    bool searched, otx_plane *out);

#endif

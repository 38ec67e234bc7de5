/* image.h -- float pixels in memory.
 *
 * Row 0 is the BOTTOM row: texel (x, y) has its centre at (x + 1/2, y + 1/2),
 * and UV = texel position / size, v up. Files store the top row first; they
 * are flipped once, in the readers and writers of file/, and nowhere else. */
#ifndef OTX_IMAGE_IMAGE_H
#define OTX_IMAGE_IMAGE_H

#include "base/run.h"
#include "math/vec.h"

enum
{
    OTX_IMAGE_MAX_SIDE = 32768,
    OTX_IMAGE_MAX_CHANNELS = 8
};

typedef struct otx_image
{
    int32_t width;
    int32_t height;
    int32_t channels; /* interleaved */
    float *pixels;    /* [height * width * channels] */
} otx_image;

/* Uninitialised pixels in `arena`. LIMIT past the maxima above, MEMORY. */
otx_status otx_image_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    int32_t channels, otx_image *out);

static inline float *
otx_image_at(const otx_image *image, int32_t x, int32_t y)
{
    return image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) *
                               (size_t)image->channels;
}

/* The row or column that `i` is on a torus of `size`. */
static inline int32_t
otx_image_wrap(int32_t i, int32_t size)
{
    return ((i % size) + size) % size;
}

/* Squared distance of two texels of three channels. */
static inline double
otx_image_distance_sq(const float *a, const float *b)
{
    const double x = (double)a[0] - (double)b[0];
    const double y = (double)a[1] - (double)b[1];
    const double z = (double)a[2] - (double)b[2];

    return x * x + y * y + z * z;
}

/* Half size by a 2 × 2 box (odd sizes: the last row and column are averaged
 * over what is there), at least 1 × 1. */
otx_status otx_image_halve(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_image *out);

#endif

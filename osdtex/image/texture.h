/* texture.h -- filtered lookups into a picture.
 *
 * The footprint of a sample on the picture is a parallelogram, given by two
 * derivatives. Its long axis is walked with trilinear probes as wide as its
 * short one [McCormack99], so that grazing and distant views neither alias nor
 * blur, and a close view is plain bilinear. */
#ifndef OTX_IMAGE_TEXTURE_H
#define OTX_IMAGE_TEXTURE_H

#include "image/pyramid.h"

typedef struct otx_texture
{
    otx_pyramid pyramid;
    bool wrap_x, wrap_y;
} otx_texture;

/* What a footprint comes to: the same for all samples of an affine piece. */
typedef struct otx_texture_probes
{
    int32_t count;
    int32_t level;
    double fraction; /* of level + 1 */
    otx_vec2 first;  /* from the sample to the first probe, UV */
    otx_vec2 step;   /* from probe to probe, UV */
} otx_texture_probes;

/* Makes the mip levels of `image`, which it borrows, in `arena`. MEMORY. */
otx_status otx_texture_create(
    otx_run *run, otx_arena *arena, const otx_image *image, bool wrap_x,
    bool wrap_y, otx_texture *out);

/* Probes for the parallelogram spanned by uv_dx and uv_dy (UV from a sample to
 * the next). */
otx_texture_probes
otx_texture_measure(const otx_texture *texture, otx_vec2 uv_dx, otx_vec2 uv_dy);

/* Color around `uv`, all channels of the picture. */
void otx_texture_probe(
    const otx_texture *texture, const otx_texture_probes *probes, otx_vec2 uv,
    float *color);

/* Both in one. Scene-linear R, G, B; grey pictures are spread. */
void otx_texture_filter(
    const otx_texture *texture, otx_vec2 uv, otx_vec2 uv_dx, otx_vec2 uv_dy,
    float rgb[3]);

#endif

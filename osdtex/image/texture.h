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
    /* Of a stack: one for each slice, alike in size and channels. */
    const struct otx_texture *slices; /* [slice_count]; NULL: this is one */
    int32_t slice_count;
} otx_texture;

/* Two neighbouring slices of a stack of `count`, and the share of the second.
 */
typedef struct otx_texture_between
{
    int32_t first;
    double share; /* 0: the first alone */
} otx_texture_between;

static inline otx_texture_between
otx_texture_slices_at(int32_t count, double along)
{
    const double at =
        (along > 0.0 ? along < 1.0 ? along : 1.0 : 0.0) * (double)(count - 1);
    const int32_t first = (int32_t)at;

    return first < count - 1 ? (otx_texture_between){first, at - first}
                             : (otx_texture_between){count - 1, 0.0};
}

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

/* Gives a texture the slices of a stack, which it borrows. MEMORY. */
otx_status otx_texture_add_slices(
    otx_run *run, otx_arena *arena, const otx_image *images, int32_t count,
    otx_texture *texture);

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

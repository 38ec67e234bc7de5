/* texture.h -- filtered lookups into a picture.
 *
 * The footprint of a sample on the picture is a parallelogram, given by two
 * derivatives. Its long axis is walked with trilinear probes as wide as its
 * short one [McCormack99], so that grazing and distant views neither alias nor
 * blur, and a close view is plain bilinear. */
#ifndef OTX_RENDER_TEXTURE_H
#define OTX_RENDER_TEXTURE_H

#include "image/pyramid.h"
#include "render/scene.h"

typedef struct otx_texture
{
    otx_pyramid pyramid;
    bool wrap_x, wrap_y;
} otx_texture;

/* Makes the mip levels in `arena`. MEMORY. */
otx_status otx_texture_create(
    otx_run *run, otx_arena *arena, const otx_scene_texture *source,
    otx_texture *out);

/* Color at `uv`, averaged over the parallelogram spanned by uv_dx and uv_dy
 * (UV from a sample to the next) around it. Scene-linear R, G, B; grey pictures
 * are spread. */
void otx_texture_filter(
    const otx_texture *texture, otx_vec2 uv, otx_vec2 uv_dx, otx_vec2 uv_dy,
    float rgb[3]);

#endif

/* shade.h -- the colour of a point of the model, and the light on it. */
#ifndef OTX_RENDER_SHADE_H
#define OTX_RENDER_SHADE_H

#include "image/texture.h"
#include "render/light.h"
#include "render/lines.h"
#include "render/render.h"
#include "render/tracer.h"

/* What all samples of a picture share. Lengths are in the tracer's units. */
typedef struct otx_shade
{
    const otx_scene *scene;
    const otx_render_options *options;
    const otx_tracer *tracer;
    otx_camera_frame frame;
    otx_light light;
    const otx_texture *textures; /* [scene->texture_count] */
    /* Made only when they are shown. */
    const int32_t *patch;
    const float *stretch;
    const uint8_t *seam, *wire; /* [corner_count]; wire NULL: all */
    otx_lines lines;
    otx_overlay_index overlay;
    int32_t light_rays; /* of each kind to a sample */
    double share;       /* of a pixel's side that a lookup covers */
} otx_shade;

/* One sample. */
typedef struct otx_shade_sample
{
    otx_vec2 at;                  /* in the picture, pixels */
    otx_vec3 direction;           /* of its ray, unit */
    int32_t number;               /* in its pixel */
    uint64_t pixel;               /* hash key of the pixel */
    const otx_light_known *known; /* of its light; NULL: nothing */
} otx_shade_sample;

/* Makes mip levels, islands and stretch as `options->show` asks for, in
 * run->scratch. Notes the mean stretch where it is shown. MEMORY. */
otx_status otx_shade_prepare(
    otx_run *run, const otx_scene *scene, const otx_render_options *options,
    const otx_tracer *tracer, const otx_camera_frame *frame, otx_shade *out);

/* The normal to shade with: unit, on the outside by the winding. */
otx_vec3 otx_shade_normal(const otx_scene *scene, const otx_hit *hit);

/* Whether a picture is lit: UVs and normals are numbers, which light would
 * falsify. */
bool otx_shade_is_lit(const otx_render_options *options);

void otx_shade_hit(
    const otx_shade *shade, const otx_hit *hit, const otx_shade_sample *sample,
    float rgb[3]);

/* The first surface on a sample's way; sets its direction. */
bool
otx_shade_trace(const otx_shade *shade, otx_shade_sample *sample, otx_hit *out);

#endif

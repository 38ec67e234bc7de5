/* render.h -- a picture of a textured model, traced with Embree.
 *
 * The same bytes for any number of threads: every sample is a function of its
 * pixel and its number. See docs/notes/render.md. */
#ifndef OTX_RENDER_RENDER_H
#define OTX_RENDER_RENDER_H

#include "render/camera.h"
#include "render/overlay.h"
#include "render/scene.h"

typedef enum otx_show
{
    OTX_SHOW_TEXTURE,       /* flat grey where there is no texture or UV */
    OTX_SHOW_PATCHES,       /* a colour for each patch */
    OTX_SHOW_STRETCH,       /* blue below 1, white at 1, red above */
    OTX_SHOW_SEAMS,         /* dark lines between patches on a pale texture */
    OTX_SHOW_UV,            /* (fraction of u, fraction of v, 0) */
    OTX_SHOW_NORMALS,       /* (n + 1) / 2 */
    OTX_SHOW_FLAT,          /* grey clay */
    OTX_SHOW_FIELD,         /* the overlay on clay */
    OTX_SHOW_SINGULARITIES, /* the overlay's dots on a pale texture */
    OTX_SHOW_CELLS,         /* the overlay on a pale texture */
    OTX_SHOW_WINDOWS,       /* scene.face_windows as STRETCH is shown */
    OTX_SHOW_CLAY,          /* grey with a highlight, and the normal map */
    OTX_SHOW_COUNT
} otx_show;

typedef struct otx_render_options
{
    int32_t width, height; /* pixels, up to OTX_IMAGE_MAX_SIDE */
    int32_t samples;       /* to a pixel's side: n * n, 1 .. 16 */
    otx_show show;
    bool unlit;               /* the colours as they are */
    bool plain;               /* lit colour: maps are not looked at */
    bool no_shadows;          /* light without rays to the model itself */
    bool transparent;         /* alpha 0 around the model, else a grey wall */
    const otx_camera *camera; /* NULL: `view` and `turn` */
    otx_view view;
    otx_up up;
    bool orbit;                 /* the view holds the model at every turn */
    double turn;                /* radians about what is up */
    double seam_width;          /* of the lines, pixels */
    bool wire;                  /* edges are drawn over it: see lines.h */
    bool uv_lines;              /* lines of equal u and of equal v, too */
    const otx_overlay *overlay; /* for FIELD, SINGULARITIES, CELLS */
} otx_render_options;

/* 1280 x 720, 4 x 4 samples, the texture lit from three quarters. */
otx_render_options otx_render_defaults(void);

/* "texture", "patches", "stretch", "seams", "uv", "normals", "flat", "field",
 * "singularities", "cells", "windows", "clay". */
const char *otx_render_show_name(otx_show show);
bool otx_render_show_find(const char *name, otx_show *out);

/* Renders into `out`, made in run->arena: R, G, B, A, scene-linear, colour
 * associated with (multiplied by) alpha, bottom row first.
 *
 * ARGUMENT for options out of range; what otx_scene_validate refuses; MEMORY;
 * CANCELLED; NUMERIC when Embree fails. */
otx_status otx_render(
    otx_run *run, const otx_scene *scene, const otx_render_options *options,
    otx_image *out);

#endif

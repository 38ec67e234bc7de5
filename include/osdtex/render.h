/* render.h -- pictures of the result.
 *
 *     osdtex_render_options options = osdtex_render_options_default();
 *     osdtex_model *model;
 *     osdtex_image *image;
 *
 *     options.show = "seams";
 *     osdtex_model_create(context, mapping, &model);
 *     osdtex_render(context, model, &options, &image);
 *     use(osdtex_image_describe(image)->pixels);   // RGBA, bottom row first
 *
 * A model is made once, which builds what rays are traced through (0.6 seconds
 * of processor time for a million quads), and rendered as often as wanted. It
 * keeps what it was made of. Models are immutable; the same model, options and
 * build give the same pixels for any number of threads. */
#ifndef OSDTEX_RENDER_H
#define OSDTEX_RENDER_H

#include <osdtex/field.h>
#include <osdtex/image.h>
#include <osdtex/mapping.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_model osdtex_model;

/* Something to look at: a written OBJ with its MTL and textures, and the maps
 * of roughness, metalness, normals and heights that the MTL names. FORMAT,
 * LIMIT, NUMERIC, COLOUR, IO, MEMORY. A texture that is not there is a warning,
 * and so is a map that cannot be read or does not lie on its texture. */
OSDTEX_API osdtex_status osdtex_model_read(
    osdtex_context *context, const char *path, osdtex_model **out);
/* The same from a mapping. */
OSDTEX_API osdtex_status osdtex_model_create(
    osdtex_context *context, const osdtex_mapping *mapping, osdtex_model **out);
/* The surface of a field, to be shown as "field" or "singularities". */
OSDTEX_API osdtex_status osdtex_model_create_field(
    osdtex_context *context, const osdtex_field *field, osdtex_model **out);
/* A model that was read, with a field to be shown on it: that of the same OBJ
 * read as a cage of scheme none, on level 0. ARGUMENT where the field's surface
 * has other faces than the model. */
OSDTEX_API osdtex_status osdtex_model_join_field(
    osdtex_context *context, const osdtex_model *model,
    const osdtex_field *field, osdtex_model **out);
OSDTEX_API void osdtex_model_destroy(osdtex_model *model);

typedef struct osdtex_render_options
{
    size_t size;
    int32_t width;
    int32_t height;
    int32_t samples;  /* to a pixel's side: n * n, 1 .. 16 */
    int32_t unlit;    /* 1: the colours as they are */
    const char *show; /* "texture", "patches", "stretch", "seams", "uv",
                       * "normals", "flat", "field", "singularities",
                       * "cells", "windows" (of a mapping),
                       * "clay": grey with a highlight, "sheet": a contact
                       * sheet of texture, patches, seams, stretch, field and
                       * the three worst seams;
                       * NULL: texture */
    const char *view; /* "three_quarter", "front", "back", "left", "right",
                       * "top"; "seam1" to "seam99": close to the places
                       * where seams show, the worst first; NULL:
                       * three_quarter */
    double turn;      /* of the view, radians about what is up */
    /* Where the eye is instead of `view`; fov 0: not used. */
    double eye[3];
    double target[3];
    double fov;          /* of the picture's height, radians */
    int32_t transparent; /* 1: alpha 0 around the model */
    int32_t plain;       /* 1: of a material the lit colour alone, without its
                          * other maps */
    int32_t displace;    /* 1: vertices are moved by its heights */
    int32_t no_shadows;  /* 1: lit without rays to the model itself */
    int32_t up_axis;     /* 1: Z is up, 0: Y; `view` and `turn` go by it */
    int32_t orbit;       /* 1: `view` is as far away as holds the model at every
                          * `turn`, for frames of a turntable; 0: as near as
                          * fills the picture */
    int32_t wire;        /* 1: edges are drawn over it: of a mapping those of
                          * its cage, else of the model's faces */
    int32_t uv_lines;    /* 1: lines of equal u and v, eight to the texture */
} osdtex_render_options;

static inline osdtex_render_options
osdtex_render_options_default(void)
{
    osdtex_render_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.width = 1280;
    options.height = 720;
    options.samples = 4;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_render_options_init(osdtex_render_options *out, size_t bytes);

/* Renders into an RGBA image, scene-linear, colour multiplied by alpha. On all
 * threads: 1280 x 720 pixels of 16 samples take some 10 seconds of processor
 * time (docs/notes/render.md). ARGUMENT (a name that is none, with near ones; a
 * size beyond 32768), NUMERIC, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_render(
    osdtex_context *context, const osdtex_model *model,
    const osdtex_render_options *options, osdtex_image **out);

OSDTEX_END_DECLS

#endif

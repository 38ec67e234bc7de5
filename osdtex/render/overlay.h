/* overlay.h -- lines and dots drawn on a model: a field, its singularities.
 *
 * An overlay is a view, like the scene: whoever shows something fills it in.
 * Lines lie on faces and are as wide on the surface wherever they run. */
#ifndef OTX_RENDER_OVERLAY_H
#define OTX_RENDER_OVERLAY_H

#include "render/scene.h"

/* A straight piece of a line on one face. Pieces that come close to the edge
 * of their face are given to its neighbour too. */
typedef struct otx_overlay_line
{
    int32_t face;
    otx_vec3 ends[2];
    double along[2]; /* length of the line up to the ends, scene units */
} otx_overlay_line;

typedef struct otx_overlay_dot
{
    otx_vec3 at;
    int32_t sign; /* above 0: red with a plus; below: blue with a minus */
} otx_overlay_dot;

typedef struct otx_overlay
{
    int32_t line_count, dot_count;
    const otx_overlay_line *lines; /* [line_count] */
    const otx_overlay_dot *dots;   /* [dot_count] */
    double line_width;             /* scene units */
    double dot_radius;             /* scene units */
    /* Lines darken over this length and begin anew, so that their sense is
     * seen, scene units; 0: they have none. */
    double period;
} otx_overlay;

/* What is drawn on each face of a scene. */
typedef struct otx_overlay_index
{
    const otx_overlay *overlay;
    const int32_t *face_first_line; /* [face_count + 1] */
    const int32_t *face_lines;
    const int32_t *face_first_dot; /* [face_count + 1] */
    const int32_t *face_dots;
} otx_overlay_index;

/* In run->scratch. ARGUMENT for a line on a face that is not there, MEMORY. */
otx_status otx_overlay_prepare(
    otx_run *run, const otx_scene *scene, const otx_overlay *overlay,
    otx_overlay_index *out);

/* Draws over the colour of a point of `face`, scene units.
 *
 *   right, up  unit, of the picture: which way signs stand */
void otx_overlay_draw(
    const otx_overlay_index *index, int32_t face, otx_vec3 at, otx_vec3 right,
    otx_vec3 up, float rgb[3]);

#endif

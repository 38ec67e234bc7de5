/* lines.h -- lines as wide in the picture wherever they run: edges of faces,
 * and where u and v are equal. */
#ifndef OTX_RENDER_LINES_H
#define OTX_RENDER_LINES_H

#include "render/camera.h"
#include "render/tracer.h"

/* Of a picture; borrowed. */
typedef struct otx_lines
{
    const otx_scene *scene;
    const otx_tracer *tracer;
    const otx_camera_frame *frame;
} otx_lines;

/* Whether a place of the picture, in pixels, is on the line drawn for an edge
 * of its face. Each face draws its own edges, so that a line is never wider
 * than the two faces beside it.
 *
 *   marked  [corner_count] 1 where the edge from the corner to the next is
 *           drawn; NULL: all
 *   width   pixels */
bool otx_lines_on_edge(
    const otx_lines *lines, int32_t face, otx_vec2 at, const uint8_t *marked,
    double width);

/* Which edges are drawn as wire: those between faces of different
 * scene->face_root, and boundaries.
 *
 *   marked  [corner_count] in run->scratch; NULL where there are no roots:
 *           all
 *
 * LIMIT, MEMORY. */
otx_status
otx_lines_wire(otx_run *run, const otx_scene *scene, const uint8_t **marked);

/* Draws lines of equal u in red and of equal v in green, eight to a unit, those
 * of whole numbers wider. Lines closer than four pixels are left out.
 *
 *   du, dv  how u and v change from one pixel to the next along the picture's
 *           two axes */
void
otx_lines_uv(otx_vec2 uv, const double du[2], const double dv[2], float rgb[3]);

#endif

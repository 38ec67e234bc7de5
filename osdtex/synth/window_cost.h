/* window_cost.h -- how far a window is from where a match says it is from. */
#ifndef OTX_SYNTH_WINDOW_COST_H
#define OTX_SYNTH_WINDOW_COST_H

#include "synth/canvas.h"

/* The way from a texel of a canvas to the texels of the pattern's level. */
typedef struct otx_window_frame
{
    float x, y;           /* of the middle */
    float xx, xy, yx, yy; /* (i, j) texels on are (xx i + xy j, yx i + yy j) */
} otx_window_frame;

static inline otx_window_frame
otx_window_frame_of(const otx_canvas *canvas, ptrdiff_t at, otx_synth_match m)
{
    const otx_pattern_level *level = &canvas->pattern->levels[canvas->level];
    const otx_quad a = canvas->metric[at];
    const float px = level->per_x, py = level->per_y;

    return (otx_window_frame){
        px * m.x,
        py * m.y,
        px * (m.c * a[0] - m.s * a[2]),
        px * (m.c * a[1] - m.s * a[3]),
        py * (m.s * a[0] + m.c * a[2]),
        py * (m.s * a[1] + m.c * a[3])};
}

/* Whether all of the window is on the pattern, half a texel over. */
bool otx_window_is_inside(const otx_canvas *canvas, otx_window_frame frame);

/* Squared distance of a window to the pattern, the mean over what is in it. It
 * is not finished where it passes `limit`: what is returned is above that. A
 * window with nothing in it costs 0. */
float otx_window_cost(
    const otx_canvas *canvas, ptrdiff_t at, otx_window_frame frame,
    float limit);

#endif

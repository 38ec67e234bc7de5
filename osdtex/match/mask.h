/* mask.h -- the collar of a patch as pixels of some grid.
 *
 * A mask is drawn wherever it is needed: rotated for the exhaustive search,
 * placed on the texels of the exemplar to score a placement, unrotated to pick
 * samples. All three are spans of a triangle in a frame. */
#ifndef OTX_MATCH_MASK_H
#define OTX_MATCH_MASK_H

#include "match/match.h"

/* Pixel coordinates q = (R(angle) flat + shift) / pixel. */
typedef struct otx_mask_frame
{
    otx_vec2 rotation; /* cos, sin */
    otx_vec2 shift;
    otx_vec2 pixel;
} otx_mask_frame;

/* Pixels [x, x + count) of row y, whose centres lie in one triangle. Source
 * and weight are linear: values at the centre of pixel x, and the step. */
typedef struct otx_mask_span
{
    int32_t triangle;
    int32_t x, y;
    int32_t count;
    otx_vec2 source, source_step;
    double weight, weight_step;
} otx_mask_span;

typedef void (*otx_mask_span_fn)(void *context, const otx_mask_span *span);

typedef struct otx_mask_box
{
    otx_vec2 low, high;
} otx_mask_box;

static inline otx_vec2
otx_mask_place(const otx_mask_frame *frame, otx_vec2 flat)
{
    const otx_vec2 p =
        otx_vec2_add(otx_vec2_mul(frame->rotation, flat), frame->shift);

    return (otx_vec2){p.x / frame->pixel.x, p.y / frame->pixel.y};
}

/* False unless all numbers are finite, of sane size, and weights >= 0. */
bool otx_mask_is_valid(const otx_mask *mask);

/* Bounds of the corners in a frame. The mask has a triangle. */
otx_mask_box otx_mask_bounds(const otx_mask *mask, const otx_mask_frame *frame);

/* Area of the triangles, square texels. */
double otx_mask_area(const otx_mask *mask);

/* Calls `fn` for every span, triangles in order, rows upwards. A pixel belongs
 * to the triangle that holds its centre; centres on an edge belong to the
 * triangle to the right of it, or above it. */
void otx_mask_draw(
    const otx_mask *mask, const otx_mask_frame *frame, otx_mask_span_fn fn,
    void *context);

/* Source and weight as linear functions of a point: value = at + dx x + dy y.
 * False for a triangle without area. */
typedef struct otx_mask_ramp
{
    otx_vec2 at, dx, dy; /* source */
    double weight_at, weight_dx, weight_dy;
} otx_mask_ramp;

bool otx_mask_ramp_make(
    const otx_mask_triangle *triangle, const otx_vec2 corners[3],
    otx_mask_ramp *out);

static inline otx_vec2
otx_mask_ramp_source(const otx_mask_ramp *ramp, otx_vec2 p)
{
    return (otx_vec2){
        ramp->at.x + ramp->dx.x * p.x + ramp->dy.x * p.y,
        ramp->at.y + ramp->dx.y * p.x + ramp->dy.y * p.y};
}

static inline double
otx_mask_ramp_weight(const otx_mask_ramp *ramp, otx_vec2 p)
{
    return ramp->weight_at + ramp->weight_dx * p.x + ramp->weight_dy * p.y;
}

#endif

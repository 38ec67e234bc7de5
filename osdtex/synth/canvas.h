/* canvas.h -- a chart at one level, at work.
 *
 * All arrays are rows of `stride` texels with a rim of OTX_CANVAS_RIM around,
 * VOID or, on a torus, copies of the other side: no window asks where it is.
 * Texel (x, y) is at index otx_canvas_index. */
#ifndef OTX_SYNTH_CANVAS_H
#define OTX_SYNTH_CANVAS_H

#include "synth/synth.h"

enum
{
    OTX_CANVAS_RIM = 4,   /* the largest radius of a window */
    OTX_CANVAS_STRIP = 16 /* rows that are searched one after the other */
};

/* What a texel's window is used for. */
typedef enum otx_canvas_use
{
    OTX_CANVAS_NONE, /* it is not looked at */
    OTX_CANVAS_READ, /* its match is of another chart */
    OTX_CANVAS_SEEK  /* its match is searched */
} otx_canvas_use;

typedef struct otx_canvas
{
    const otx_pattern *pattern;
    int32_t width, height, stride;
    int32_t level, radius;
    bool wrap_x, wrap_y;
    bool sparse;          /* whole windows are compared by every other texel */
    int32_t quads, voted; /* of a texel, and how many of them are voted */
    float step_x, step_y; /* texels of level 0 to one of this */
    uint8_t *kinds;
    uint8_t *uses;
    uint8_t *votes;      /* 1: the colour is voted */
    uint8_t *changed;    /* 1: the colour, by the last vote */
    uint8_t *stirred;    /* 1: a colour in the window has changed since its cost
                          * was found */
    uint8_t *moved;      /* 1: the match, in this pass... */
    uint8_t *was_moved;  /* ... and in the one before */
    float *weights;      /* in windows, 0 to 1 */
    float *masses;       /* sum of the weights of a texel's window */
    otx_quad *colors;    /* [quads] a texel */
    otx_quad *metric;    /* xx, xy, yx, yy: steps of this level to texels of the
                          * exemplar at full resolution, before they turn */
    float *field;        /* [2] a texel; NULL */
    otx_quad *anchor;    /* [quads] a texel; NULL */
    float *anchor_share; /* as its least in a window; NULL */
    otx_synth_match *matches;
    otx_synth_match *before; /* as a pass of the search found them */
    float *costs;            /* of the matches, a texel of full weight */
    float *trust;            /* weight of a window in votes */
    float *row;              /* for sums along rows */
} otx_canvas;

static inline ptrdiff_t
otx_canvas_index(const otx_canvas *canvas, int32_t x, int32_t y)
{
    return (ptrdiff_t)(y + OTX_CANVAS_RIM) * canvas->stride +
           (x + OTX_CANVAS_RIM);
}

static inline int32_t
otx_canvas_strips(const otx_canvas *canvas)
{
    return (canvas->height + OTX_CANVAS_STRIP - 1) / OTX_CANVAS_STRIP;
}

/* All levels of a chart's kinds and colours, the finest first. */
typedef struct otx_canvas_stack
{
    otx_canvas levels[OTX_PATTERN_LEVELS];
} otx_canvas_stack;

/* Makes them in run->scratch: kinds (a texel is FREE if one of the four below
 * it is), colours (means of what is there), metric, field, anchor, guide. Of
 * matches there are those of level 0. MEMORY. */
otx_status otx_canvas_build(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart,
    const otx_synth_options *options, int32_t level_count,
    otx_canvas_stack *out);

/* Matches of a level from those of the one above: children go on where their
 * parent leads; FROZEN ones keep what they are. */
void otx_canvas_descend(const otx_canvas *from, otx_canvas *to);

/* Says how much is in windows; `hole` is what FREE texels weigh, 1 but for a
 * start. All are stirred. */
void otx_canvas_weigh(otx_canvas *canvas, float hole);

/* Says from kinds what windows are for, and weighs them. Of a collar only what
 * windows reach is used. */
void otx_canvas_use_windows(otx_canvas *canvas);

/* Only windows whose middle is the chart's own are for anything. */
void otx_canvas_seek_own(otx_canvas *canvas);

/* Marks all windows that a changed texel is in as stirred, or just all. */
void otx_canvas_stir(otx_canvas *canvas, bool all);

/* Cuts canvases in strips, in run->scratch.
 *
 *   chart_of  [*strips] index of the canvas
 *   first     [*strips] row that a strip begins at
 *
 * MEMORY. */
otx_status otx_canvas_cut(
    otx_run *run, otx_canvas *const *canvases, int32_t count,
    const int32_t **chart_of, const int32_t **first, int64_t *strips);

/* On a torus, copies rows and columns to the rim beyond the other side. */
void otx_canvas_wrap(otx_canvas *canvas);

/* The step of the surface, in texels of the exemplar, that (dx, dy) texels of
 * the canvas are at a texel. */
static inline otx_vec2
otx_canvas_onto(const otx_canvas *canvas, ptrdiff_t at, float dx, float dy)
{
    const otx_quad m = canvas->metric[at];

    return (otx_vec2){m[0] * dx + m[1] * dy, m[2] * dx + m[3] * dy};
}

/* A match moved by a step of the surface. */
static inline otx_synth_match
otx_canvas_step(otx_synth_match m, otx_vec2 by)
{
    m.x += m.c * (float)by.x - m.s * (float)by.y;
    m.y += m.s * (float)by.x + m.c * (float)by.y;
    return m;
}

/* A match brought onto the pattern. */
static inline otx_synth_match
otx_canvas_fold(const otx_canvas *canvas, otx_synth_match m)
{
    const otx_pattern *p = canvas->pattern;

    m.x = otx_pattern_fold(m.x, p->width, p->wrap_x);
    m.y = otx_pattern_fold(m.y, p->height, p->wrap_y);
    return m;
}

/* The match of a texel (dx, dy) away that goes on as this one does. */
static inline otx_synth_match
otx_canvas_go_on(const otx_canvas *canvas, ptrdiff_t at, float dx, float dy)
{
    return otx_canvas_fold(
        canvas, otx_canvas_step(
                    canvas->matches[at], otx_canvas_onto(canvas, at, dx, dy)));
}

#endif

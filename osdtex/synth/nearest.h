/* nearest.h -- for every window of a canvas, a near one of the pattern.
 *
 * PatchMatch [Barnes09, sec. 3] with rotation [Barnes10]: a neighbour's match
 * is shifted and turned on, then places around the best one are tried. Rows go
 * in strips that see the strips beside them as they were before the pass, so
 * that strips may be worked on in any order by any number of threads. */
#ifndef OTX_SYNTH_NEAREST_H
#define OTX_SYNTH_NEAREST_H

#include "synth/occurrence.h"

typedef struct otx_nearest_pass
{
    uint64_t seed;
    uint32_t number;  /* of all passes so far */
    bool refresh;     /* colours have changed: costs are made anew */
    bool stirred;     /* so are the matches that windows were tried with */
    bool hint;        /* try the charts' hints, too */
    double reach;     /* of the first random step, texels of the exemplar;
                       * 0: none are made */
    double turn;      /* random angles, radians */
    double tolerance; /* of a field, radians */
    int32_t symmetry; /* of a field */
    const otx_occurrence *usage; /* NULL: it costs nothing */
    float apart; /* texels along both axes that a match has to be from where the
                  * chart itself has it; 0: it may be anywhere */
    float barred_apart; /* likewise, from the places that a chart bars */
} otx_nearest_pass;

/* One pass over all canvases of a level.
 *
 *   canvases  [count]
 *   charts    [count] of the canvases
 *
 * CANCELLED, MEMORY. */
otx_status otx_nearest_search(
    otx_run *run, otx_canvas *const *canvases, const otx_synth_chart *charts,
    int32_t count, const otx_nearest_pass *pass);

/* Whether a match is less than `apart` texels along both axes from a place. */
static inline bool
otx_nearest_is_beside(
    const otx_pattern *pattern, float x, float y, otx_synth_match m,
    float apart)
{
    const float width = (float)pattern->width;
    const float height = (float)pattern->height;
    float dx = fabsf(m.x - x), dy = fabsf(m.y - y);

    if (pattern->wrap_x && dx > 0.5f * width)
        dx = width - dx;
    if (pattern->wrap_y && dy > 0.5f * height)
        dy = height - dy;
    return dx < apart && dy < apart;
}

/* Whether a match is less than `apart` texels along both axes from where a
 * chart that is the pattern has texel (x, y) of the canvas. */
static inline bool
otx_nearest_is_near(
    const otx_canvas *c, int32_t x, int32_t y, otx_synth_match m, float apart)
{
    return otx_nearest_is_beside(
        c->pattern, ((float)x + 0.5f) * c->step_x,
        ((float)y + 0.5f) * c->step_y, m, apart);
}

/* A place and an angle by chance, within the tolerance of a field.
 *
 *   field  (c, s), or NULL */
otx_synth_match otx_nearest_random(
    const otx_pattern *pattern, const float *field, double tolerance,
    uint64_t bits);

#endif

/* synth.h -- texture made so that every window of it is one of the exemplar's.
 *
 * The one engine behind mended seams, synthesis on whole surfaces and the
 * slices of a stack: texture optimisation [Kwatra05] by nearest-neighbour
 * fields with rotation [Barnes10] and voting [Wexler07], coarse to fine. What
 * is made is not colours but source coordinates: for each texel its place in
 * the exemplar and an angle, so that every map of a material follows and a bake
 * is as sharp as the exemplar.
 *
 *     otx_pattern_build(run, run->scratch, &input, &pattern);
 *     chart = (otx_synth_chart){.width = w, .height = h, .matches = matches};
 *     otx_synth_run(run, &pattern, &chart, 1, &options);
 *
 * The target is one chart or several. A chart is a rectangle of texels, or a
 * torus; what each texel is says its kind. Charts of one surface have collars:
 * texels that another chart owns, whose matches are read from there. A texel's
 * metric says how a step in the chart is on the surface, so that charts may be
 * distorted. See docs/notes/synth.md.
 *
 * Positions in the exemplar are in its full-resolution texels, the middle of
 * the first at 1/2; v up, as in all images. */
#ifndef OTX_SYNTH_SYNTH_H
#define OTX_SYNTH_SYNTH_H

#include "synth/pattern.h"

/* Where a texel's middle is in the exemplar, and how steps turn on the way
 * there: (1, 0) on the surface is (c, s) in the exemplar. */
typedef struct otx_synth_match
{
    float x, y;
    float c, s; /* cosine and sine */
} otx_synth_match;

typedef enum otx_synth_kind
{
    OTX_SYNTH_VOID,   /* nothing is there; windows leave it out */
    OTX_SYNTH_FROZEN, /* shows what its match says, and keeps it */
    OTX_SYNTH_FREE,   /* is made */
    OTX_SYNTH_COLLAR  /* is made by another chart */
} otx_synth_kind;

/* Where a texel's middle lies in the chart that owns it. */
typedef struct otx_synth_place
{
    int32_t chart;
    float x, y; /* texels of that chart, middles at halves */
    float c, s; /* (1, 0) on the surface as this chart sees it is (c, s) as that
                 * one does */
} otx_synth_place;

/* All arrays have a row of `width` after another, the bottom row first. */
typedef struct otx_synth_chart
{
    int32_t width, height; /* 0: nothing */
    bool wrap_x, wrap_y;   /* the last column is beside the first */
    const uint8_t *kinds;  /* [texels] otx_synth_kind; NULL: all FREE */
    /* [texels * 3] the symmetric root (xx, xy, yy) of the first fundamental
     * form: a step of the chart times it is one on the surface, in exemplar
     * texels. NULL: the identity. Stretch outside of [1/2, 2] is cut off. */
    const float *metric;
    /* [texels * 2] (c, s) that matches are held to within options->tolerance;
     * (0, 0): there angles are free, NULL: everywhere. */
    const float *field;
    const otx_synth_place *places; /* [texels] of COLLAR; NULL: there is none */
    /* [texels * 4] what the second four channels have to be, in the units of
     * the pattern's guide; NULL: they are made like the others. */
    const float *guide;
    /* What the made texture is drawn to: [texels * 4 * pattern->quads] features
     * of another one, and [texels] the share it has in each vote, 0 to 1. At
     * every level a texel is drawn by the least share in its window. NULL: to
     * nothing. */
    const float *anchor;
    const float *anchor_share;
    const otx_synth_match *hints; /* [texels] tried once a level; NULL none */
    /* [barred_count][texels] places in the exemplar, as y * its width + x, that
     * a texel's match keeps options->apart texels from, along an axis at least.
     */
    const int32_t *const *barred;
    int32_t barred_count;
    /* [texels] In: of FROZEN, and of FREE where options->given. Out: of FREE.
     */
    otx_synth_match *matches;
    float *costs; /* [texels] out: squared window distance a texel; NULL */
} otx_synth_chart;

typedef struct otx_synth_options
{
    int32_t levels;        /* 1 .. OTX_PATTERN_LEVELS, no more than fit */
    int32_t radius;        /* of windows: 3 is 7 x 7 */
    int32_t coarse_radius; /* at the coarsest level; 3 or 4 */
    bool given;            /* matches are a start; else it is random */
    int32_t starts;        /* at the coarsest level; the best is kept */
    int32_t rounds;        /* there; 0: as many as a start by chance takes */
    double usage;          /* weight of what is overused, annealed to 0 */
    double histogram;      /* share of matching L to the exemplar's; 0 none */
    double turn;           /* search angles within +- of the match, radians */
    double tolerance;      /* of a field, radians */
    int32_t symmetry;      /* of a field: turns by 360 / symmetry degrees are
                            * equal in it; 1, 2 or 4 */
    uint64_t seed;
    double apart;      /* see barred */
    double effort;     /* factor on the rounds of search and vote; 0 is 1 */
    const char *stage; /* of progress */
} otx_synth_options;

/* Mending: patches as the start, angles free. */
static inline otx_synth_options
otx_synth_mending(void)
{
    return (otx_synth_options){
        .levels = 5,
        .radius = 3,
        .coarse_radius = 3,
        .given = true,
        .starts = 1,
        .turn = OTX_PI,
        .tolerance = OTX_PI,
        .symmetry = 1,
        .stage = "synth",
    };
}

/* From nothing: usage annealed, histogram matched, held to a field. */
static inline otx_synth_options
otx_synth_making(void)
{
    return (otx_synth_options){
        .levels = 5,
        .radius = 3,
        .coarse_radius = 3,
        .starts = 1,
        .usage = 1.0,
        .histogram = 0.7,
        .turn = OTX_PI,
        .tolerance = OTX_PI / 18.0,
        .symmetry = 1,
        .stage = "synth",
    };
}

/* Makes the FREE texels of all charts together. The bytes do not depend on the
 * number of threads. CANCELLED, MEMORY. */
otx_status otx_synth_run(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *charts,
    int32_t chart_count, const otx_synth_options *options);

#endif

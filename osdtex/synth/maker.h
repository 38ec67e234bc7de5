/* maker.h -- a run of the engine, and its two halves of a round. */
#ifndef OTX_SYNTH_MAKER_H
#define OTX_SYNTH_MAKER_H

#include "synth/collar.h"
#include "synth/occurrence.h"

/* Everything of a run. */
typedef struct otx_maker
{
    otx_run *run;
    const otx_pattern *pattern;
    const otx_synth_chart *charts;
    int32_t count;
    const otx_synth_options *options;
    int32_t level_count;
    otx_canvas_stack *stacks; /* [count] */
    otx_canvas **finest;      /* [count] */
    otx_canvas **canvases;    /* [count] of the level at hand */
    otx_collar *collars;      /* [count] of that level */
    otx_occurrence *usage;
    uint32_t passes;  /* so far */
    double done, all; /* texels searched, for progress */
} otx_maker;

enum
{
    OTX_MAKER_ROUNDS_COARSEST = 24 /* of the coarsest level, begun by chance */
};

/* Texels of all charts at a level. */
int64_t otx_maker_texels(const otx_maker *maker, int32_t level);

/* Passes of the search at a level, round by round the same.
 *
 *   round  of the level, from 0: usage is annealed by it */
otx_status otx_maker_search(
    otx_maker *maker, int32_t level, int32_t round, int32_t passes);

/* Trust, exchange, colours, histogram.
 *
 *   even  all windows have the same say */
otx_status otx_maker_vote(otx_maker *maker, int32_t level, bool even);

#endif

/* morph.h -- masks between two masks, [Ray09, §1.1] repaired.
 *
 * Signed distances of the first mask are carried along the slope of those of
 * the second, so that features move to where they are wanted; what cannot be
 * reached that way is taken over from the far side inwards. Of the many small
 * steps those are kept between which about equally many texels change. See
 * docs/notes/stack.md for what differs from the paper and why. */
#ifndef OTX_STACK_MORPH_H
#define OTX_STACK_MORPH_H

#include "base/run.h"

typedef enum otx_morph_kind
{
    OTX_MORPH_AUTO,   /* the one with the fewest crumbs */
    OTX_MORPH_ADVECT, /* networks: joints */
    OTX_MORPH_RELAX,  /* advection and a blend of distances */
    OTX_MORPH_LINEAR  /* a blend of distances: separate features */
} otx_morph_kind;

enum
{
    OTX_MORPH_STEPS_MAX = 512
};

typedef struct otx_morph_options
{
    otx_morph_kind kind;
    int32_t slices; /* 2 or more, with both ends */
    int32_t clean;  /* islands and holes below that are dropped, texels */
    /* What the paper prints, each off unless asked for, for comparison. */
    bool sweep_by_first; /* the sweep looks at the first mask's distances */
    bool whole_steps;    /* features grow by whole texels */
} otx_morph_options;

typedef struct otx_morph
{
    int32_t slices;
    uint8_t **masks;     /* [slices][height * width] the ends as they are */
    otx_morph_kind kind; /* that was taken */
    int32_t steps;       /* of which the slices were picked */
    int32_t crumbs;      /* pieces below 16 texels, over the inner slices */
    int64_t flips_most;  /* texels that change from a slice to the next */
    double flips_mean;
} otx_morph;

/* In run->arena.
 *
 *   from, to  [height * width] 0 or 1; both kinds must be in each
 *
 * FORMAT where one is empty or full, ARGUMENT where slices are out of 2 .. 64;
 * CANCELLED, MEMORY. */
otx_status otx_morph_make(
    otx_run *run, const uint8_t *from, const uint8_t *to, int32_t width,
    int32_t height, const otx_morph_options *options, otx_morph *out);

#endif

/* slices.h -- one picture remade under a row of masks, [Ray09, §1.2] replaced.
 *
 * Every slice is made by the engine of synth/ with the mask as a channel, drawn
 * to the slice before where the mask has not changed, and is in the end a copy:
 * for each texel one of the picture's, so that all maps of a material follow.
 * See docs/notes/stack.md. */
#ifndef OTX_STACK_SLICES_H
#define OTX_STACK_SLICES_H

#include "image/image.h"

typedef struct otx_slices_input
{
    const otx_image *lab; /* of the picture; it tiles in both axes */
    /* [count][height * width] the first one is the picture's own. */
    const uint8_t *const *masks;
    int32_t count;
    double mask_weight; /* against the RMS deviation of Lab; 4 */
    double anchor;      /* share of the slice before in each vote; .8 */
    uint64_t seed;
} otx_slices_input;

/* For each slice the texels of the picture that it shows, in run->arena.
 *
 *   out  [count] arrays of [height * width]
 *
 * CANCELLED, MEMORY. */
otx_status
otx_slices_make(otx_run *run, const otx_slices_input *input, int32_t **out);

/* The picture, and count - 1 others under its own mask, each made anew from
 * nothing: where one has a texel of the picture, the next ones have none from
 * nearby. Of the masks only the first is looked at. CANCELLED, MEMORY. */
otx_status
otx_slices_vary(otx_run *run, const otx_slices_input *input, int32_t **out);

#endif

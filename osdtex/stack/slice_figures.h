/* slice_figures.h -- how good the slices of a stack are.
 *
 * Each is the worst of all slices. What lies between two keys is held against
 * what lies between their figures. See docs/notes/stack.md for what they are
 * blind to. */
#ifndef OTX_STACK_SLICE_FIGURES_H
#define OTX_STACK_SLICE_FIGURES_H

#include "stack/stack.h"

typedef struct otx_slice_figures
{
    /* A slice's mask, and what its texels are in the mask of the key that they
     * come from: what both have of what either has, the least. */
    double lookup;
    /* RMS Lab distance of two random texels, of that between the keys. */
    double contrast_least, contrast_most;
    double sharpness; /* likewise of texels side by side, the least */
    /* Texels whose mask changes from a slice to the next, of the mean. */
    double flips_least, flips_most;
    /* Mean Lab distance from a slice to the next: the most of the median. */
    double step;
    double still; /* the same, where no mask changes within 8 texels */
    /* Lab distance between the colours inside the mask of a slice and inside
     * that of the key that they are from, and so outside of it. */
    double colours;
} otx_slice_figures;

/*   labs  [stack->count] Lab of the slices, from exemplars of them: with sigma
 *         and step
 *
 * MEMORY. */
otx_status otx_slice_figures_take(
    otx_run *run, const otx_stack *stack, const otx_stack_key *keys,
    const otx_exemplar *labs, otx_slice_figures *out);

#endif

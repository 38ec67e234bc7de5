/* section.h -- seams in pieces that are mended, or left, each for itself. */
#ifndef OTX_HEAL_SECTION_H
#define OTX_HEAL_SECTION_H

#include "mapping/seam.h"
#include "synth/judge.h"
#include "territory/target.h"

typedef struct otx_section_list
{
    int32_t count;
    int32_t *of_edge; /* [leaf edge_count] -1: not a seam of one exemplar */
    double *lengths;  /* [count] texels */
} otx_section_list;

/* Runs of seam between places where three meet, of at most `longest` texels but
 * for single edges; in run->scratch. MEMORY. */
otx_status otx_section_find(
    otx_run *run, const otx_level *leaf, const otx_seam_list *seams,
    double longest, otx_section_list *out);

/* Distances of windows by the section that they are near. */
typedef struct otx_section_sum
{
    double sum;
    int64_t count;
} otx_section_sum;

/* Adds what is judged of chart k within `reach` texels of each section.
 *
 *   sums  [list->count]; a window may count for several
 *
 * MEMORY. */
otx_status otx_section_measure(
    const otx_target_set *set, int32_t k, const otx_judged *judged,
    const otx_section_list *list, double reach, otx_section_sum *sums);

/* Appends what is judged of chart k farther from all sections than that.
 *
 *   out  as long as the chart has windows
 *
 * The number in *count. MEMORY. */
otx_status otx_section_beyond(
    const otx_target_set *set, int32_t k, const otx_judged *judged,
    const otx_section_list *list, double reach, double *out, int64_t *count);

#endif

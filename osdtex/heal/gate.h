/* gate.h -- which seams are mended: those that show, where mending helps.
 *
 * A section shows if its windows are farther from the exemplar than nine of ten
 * windows away from seams are. Mending has helped if the mean over all windows
 * near it has not risen: what a band gains at the old seam it may lose beside
 * it. */
#ifndef OTX_HEAL_GATE_H
#define OTX_HEAL_GATE_H

#include "heal/section.h"

/* Windows of one exemplar, as they are judged. */
typedef struct otx_gate_view
{
    otx_judged *judged;      /* [territory.count] */
    otx_section_sum *on;     /* [sections] within a window's texel of them */
    otx_section_sum *around; /* [sections] within 48 texels */
    otx_section_sum all;     /* of the surface */
    double interior_p90;     /* of windows that no seam is in; 0: none */
} otx_gate_view;

/* Judges what the targets of the exemplar at hand show, which are filled; in
 * run->scratch. CANCELLED, MEMORY. */
otx_status otx_gate_judge(
    otx_target_set *set, const otx_pattern *pattern,
    const otx_section_list *list, otx_gate_view *out);

/* The windows of all charts of the exemplar at hand alone. */
otx_status
otx_gate_look(otx_target_set *set, const otx_pattern *pattern, otx_judged *out);

/* The mean distance of the exemplar at hand from the rest of itself. */
otx_status otx_gate_judge_exemplar(
    otx_target_set *set, const otx_pattern *pattern, double *out);

#endif

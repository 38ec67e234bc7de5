/* window.h -- whether what is seen around a seam exists in the exemplar.
 *
 * Seam figures can be cheated: slide vertices until both sides show one
 * colour, and the line closes while the structure stays broken. So square
 * windows of the textured surface are cut out around seams, by unfolding the
 * faces there, and looked up in the exemplar over all places and 36 angles;
 * what is left is compared with windows from patch interiors, which ought to
 * be found exactly. See docs/notes/measure.md. */
#ifndef OTX_MAPPING_WINDOW_H
#define OTX_MAPPING_WINDOW_H

#include "mapping/seam.h"

typedef struct otx_window_figures
{
    int32_t seam_count, interior_count;
    /* RMS Lab distance to the best match, in units of lab_sigma. */
    double seam_p50, seam_p90;
    double interior_p50, interior_p90;
} otx_window_figures;

/* Looks up at most `count` windows at seams and `count` away from them, spread
 * evenly over the surface, each in the exemplar that it shows; those that show
 * two are left out. Figures of a kind without windows are 0.
 *
 *   seams   of the same mapping */
otx_status otx_window_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_seam_list *seams, int32_t count, otx_window_figures *out);

#endif

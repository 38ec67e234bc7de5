/* measure.h -- the figures by which a mapping is judged.
 *
 * Seams are measured in CIELAB (Delta E 1976) whatever space the method
 * matched in; lengths and areas are in texels on the surface, i.e. scene units
 * times otx_seam_texels_per_unit. No figure is enough alone: what each is blind
 * to is said in docs/notes/measure.md. */
#ifndef OTX_MAPPING_MEASURE_H
#define OTX_MAPPING_MEASURE_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

typedef struct otx_measure_options
{
    /* Windows around seams and as many in patch interiors that are looked up
     * in the exemplar; 0 leaves out the window figures, which are slow. */
    int32_t window_count;
} otx_measure_options;

static inline otx_measure_options
otx_measure_options_default(void)
{
    return (otx_measure_options){.window_count = 0};
}

/* What a mapping of several exemplars makes of one. */
typedef struct otx_measure_share
{
    int32_t faces;
    double area;     /* square texels */
    double coverage; /* as below */
} otx_measure_share;

typedef struct otx_measure
{
    double texels_per_unit; /* texels per scene unit */
    double area;            /* covered surface, square texels */
    double lab_sigma;       /* of the exemplar: random texels, ... */
    double lab_step;        /* ... adjacent texels */
    int32_t patches;        /* labels in use */
    int32_t uncovered;      /* faces without a patch or with bad UVs */
    int32_t flips;          /* faces with area whose UV area is not positive */
    int32_t folds;          /* others with a reversed corner (quads) */
    int32_t outside;        /* faces that leave a picture that ends */
    double outside_max;     /* texels beyond the border, 0 none */

    double seam_energy; /* S: sum of length * mean Delta E / area */
    double seam_rms;    /* Delta E over all seam samples */
    double seam_p50, seam_p95;
    double seam_rms_sigma;     /* seam_rms / lab_sigma */
    double seam_rms_step;      /* seam_rms / lab_step */
    double seam_p95_sigma;     /* seam_p95 / lab_sigma */
    double seam_visible_share; /* of seam length with mean > lab_step */
    double seam_length;        /* texels */
    double seam_share;         /* of the length of all interior leaf edges */
    double seams_per_100;      /* met on a straight walk of 100 texels */

    double log_area_mean;   /* mean |ln(UV area / surface area)| */
    double stretch_l2_mean; /* L2 stretch, 1 isometric; area weighted */
    double stretch_l2_p95;
    double stretch_ratio_mean; /* sigma1 / sigma2, 1 conformal */
    double stretch_ratio_p95;
    double coverage; /* exp(entropy) of exemplar use / cells; of several their
                      * mean by area */
    otx_measure_share shares[OTX_EXEMPLARS_MAX];

    /* Where exemplars meet, which is in none of the figures for seams. */
    double transition_length; /* texels */
    double transition_rms;    /* Delta E */

    int32_t windows;        /* looked up at seams; 0: figures are 0 */
    double window_seam_p50; /* distance to the exemplar / lab_sigma */
    double window_seam_p90;
    double window_interior_p50;
    double window_interior_p90;
} otx_measure;

/* Measures a finished mapping; the same bits for any number of threads.
 *
 *   exemplars  of several, what is relative to one is relative to the first,
 *              but windows and visible seams to those that they show
 *   options    NULL: defaults
 *
 * ARGUMENT (nothing of the exemplars can be compared), MEMORY, CANCELLED. A
 * mapping without seams has seam figures of 0. */
otx_status otx_measure_run(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_measure_options *options, otx_measure *out);

#endif

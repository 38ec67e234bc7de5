/* heal.h -- seams mended: a band around them is made anew, texel by texel.
 *
 * A cut leaves structure that ends at it: a mortar line that stops, two stones
 * with one waist. What is within a few texels of a seam is made again so that
 * every window of one or two features looks like one of the exemplar, between
 * what stays as it is on both sides. See docs/notes/heal.md. */
#ifndef OTX_HEAL_HEAL_H
#define OTX_HEAL_HEAL_H

#include "mapping/mapping.h"
#include "mapping/source.h"

typedef struct otx_heal_options
{
    double band;    /* width across a seam, texels */
    int32_t levels; /* of the pyramids; the coarsest window is to be one or two
                     * features */
    int32_t coarse_radius;
    int32_t starts; /* tried at the coarsest level */
    bool gate;      /* only what shows is mended */
} otx_heal_options;

static inline otx_heal_options
otx_heal_options_default(void)
{
    return (otx_heal_options){64.0, 5, 3, 4, false};
}

typedef struct otx_heal_figures
{
    int32_t charts;
    int64_t texels;     /* made */
    double area;        /* of the surface, texels */
    double seam_length; /* within one exemplar, texels */
    /* With a gate. */
    int32_t sections, mended;    /* pieces of seam, and of them */
    double mended_length;        /* texels */
    double windows_itself;       /* of the exemplar from the rest of itself */
    double windows_interior_p90; /* distances of windows, in units of sigma */
    double windows_on[2];        /* at mended seams, before and after */
    double windows_around[2];    /* within 48 texels of them */
    double windows_all[2];       /* anywhere */
} otx_heal_figures;

/* Heals the seams of a finished mapping within each of its exemplars; where two
 * of them meet stays as it is. What comes out is for mapping->field, in
 * run->arena; NULL where there is no seam. The same bits for any number of
 * threads. CANCELLED, MEMORY. */
otx_status otx_heal_run(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_heal_options *options, const otx_source_field **out,
    otx_heal_figures *figures);

#endif

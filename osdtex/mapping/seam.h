/* seam.h -- where a mapping is not continuous, and how much that shows.
 *
 * A leaf edge between two faces is continuous when both faces give its ends
 * the same UVs, or UVs that differ by whole pictures along axes in which the
 * exemplar tiles. Everything else is a seam, whatever the patches are called.
 * A seam is judged by the colours that its two sides show along it.
 * See docs/notes/measure.md. */
#ifndef OTX_MAPPING_SEAM_H
#define OTX_MAPPING_SEAM_H

#include "mapping/source.h"
#include "seam/edge.h"

/* The seams of a finished mapping, in ascending order of leaf edges. Where two
 * exemplars meet is a transition, whatever it shows. */
typedef struct otx_seam_list
{
    int32_t edge_count;
    const int32_t *edges;        /* [edge_count], leaf edges */
    const uint8_t *transition;   /* [edge_count], 1 between two exemplars */
    const double *lengths;       /* [edge_count], texels on the surface */
    const int32_t *sample_first; /* [edge_count + 1] */
    const float *samples;        /* Delta E (CIELAB 1976) across the seam */
    double total_length;         /* of the seams, texels on the surface... */
    double transition_length;    /* ... and of the transitions among them */
    double interior_length; /* of all leaf edges between two covered faces */
} otx_seam_list;

/* Texels per scene unit that the mapping asks for. */
double otx_seam_texels_per_unit(
    const otx_mapping *mapping, const otx_exemplar *exemplars);

/* Whether a leaf face has a patch and finite UVs, and is not a hole. */
bool otx_seam_covered(const otx_mapping *mapping, int32_t face);

/* UV of a leaf corner in texels of the exemplar that its face shows. */
otx_vec2 otx_seam_texel(
    const otx_mapping *mapping, const otx_exemplar *exemplar, int32_t corner);

/* Finds and samples the seams between covered faces that are not holes. The
 * list lives in run->arena. MEMORY, LIMIT when the samples pass 2^31. */
otx_status otx_seam_collect(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_seam_list *out);

#endif

/* alignment.h -- how well a mapping lies along the field that it follows. */
#ifndef OTX_MAPPING_ALIGNMENT_H
#define OTX_MAPPING_ALIGNMENT_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

typedef struct otx_alignment
{
    /* Between the exemplar's direction on the surface and the field, radians,
     * by area: 0 .. pi / symmetry. */
    double angle_mean, angle_p50, angle_p95;
    /* Size of the texture over the size that was asked for, by area. */
    double scale_p01, scale_p50, scale_p99;
} otx_alignment;

/* Of a mapping with a guide, on the faces that show the first exemplar.
 * Triangles of the fan of each face are looked at; those without area on either
 * side are left out. MEMORY. */
otx_status otx_alignment_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    otx_alignment *out);

#endif

/* chart_cut.h -- the cage's faces in charts that lie flat.
 *
 * A chart is a set of faces of the cage, connected and a disc, whose leaves are
 * laid out as rigidly as their curvature allows (flatten/chart.h). The places
 * of the cage's vertices are kept; between them texture coordinates go by the
 * rule "linear all", and stretch is measured of those. Charts that stretch too
 * much, fold, lie on themselves or are too large are parted. */
#ifndef OTX_BAKE_CHART_CUT_H
#define OTX_BAKE_CHART_CUT_H

#include "math/vec.h"
#include "surface/surface.h"

typedef struct otx_chart_cut
{
    int32_t chart_count;
    const int32_t *first; /* [chart_count + 1] offsets into faces */
    const int32_t *faces; /* of the cage; holes are in none */
    /* [cage corner_count] scene units, each chart as large as its part of the
     * surface and about an origin of its own; 0 on holes. */
    const otx_vec2 *flat;
    /* Mean over the surface of the larger of stretch and its inverse, RMS. */
    double stretch;
} otx_chart_cut;

/*   most  sides of charts, scene units; INFINITY: any
 *
 * In run->arena. MEMORY, CANCELLED. */
otx_status otx_chart_cut_make(
    otx_run *run, const otx_surface *surface, double most, otx_chart_cut *out);

#endif

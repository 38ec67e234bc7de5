/* territory.h -- who makes which face.
 *
 * The surface is parted into discs of a few hundred texels; each is laid out in
 * the plane together with a collar of its neighbours' faces, which it reads and
 * never writes. */
#ifndef OTX_TERRITORY_TERRITORY_H
#define OTX_TERRITORY_TERRITORY_H

#include "flatten/chart.h"
#include "mapping/source.h"

typedef struct otx_territory
{
    int32_t count;
    otx_chart *charts;       /* [count] */
    const int32_t *exemplar; /* [count] that all of a chart's core shows */
    int32_t *owner;          /* [leaf face_count] whose core a face is in, -1 */
    int32_t *slot;           /* [leaf face_count] and the face's number there */
} otx_territory;

typedef struct otx_territory_options
{
    double texels; /* per scene unit */
    double side;   /* of a core, texels */
    double collar; /* texels */
} otx_territory_options;

/* In run->scratch, for as long as that is not released. A core that folds
 * when it is laid out is parted in two; a face that still does is nobody's.
 * CANCELLED, MEMORY. */
otx_status otx_territory_build(
    otx_run *run, const otx_mapping *mapping,
    const otx_territory_options *options, otx_territory *out);

#endif

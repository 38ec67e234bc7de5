/* coverage.h -- how evenly a surface uses an exemplar. */
#ifndef OTX_MAPPING_COVERAGE_H
#define OTX_MAPPING_COVERAGE_H

#include "exemplar/exemplar.h"

/* Area of the surface by the cells of the exemplar that it shows. */
typedef struct otx_coverage
{
    const otx_exemplar *exemplar;
    double cell; /* texels of its side */
    int32_t cells_x, cells_y;
    double *cells; /* [cells_x * cells_y] */
} otx_coverage;

/* Nothing used; borrows the exemplar. False when memory is out. */
bool otx_coverage_begin(
    otx_arena *arena, const otx_exemplar *exemplar, otx_coverage *out);

/* Spreads the area of a triangle over the cells that it lies in.
 *
 *   q  its corners in texels of the exemplar */
void otx_coverage_add(otx_coverage *coverage, const otx_vec2 q[3], double area);

/* exp of the entropy of the cells' areas, to their number: 1 all alike. */
double otx_coverage_evenness(const otx_coverage *coverage);

#endif

/* lattice.h -- the vectors by which a picture repeats. */
#ifndef OTX_ANALYSIS_LATTICE_H
#define OTX_ANALYSIS_LATTICE_H

#include "analysis/lags.h"

typedef struct otx_lattice
{
    otx_vec2 generators[2]; /* texels of the square; zero: none were found */
    double regularity;      /* mean autocorrelation at lattice points */
    double contrast;        /* least excess over the half-way points */
} otx_lattice;

/* The lattice that fits best. */
void otx_lattice_find(const otx_lags *map, otx_lattice *out);

/* First the more horizontal to the right, then counter-clockwise. */
void otx_lattice_order(otx_vec2 g[2]);

/* Where the picture tiles, whole pictures are whole cells: G = S M^-1 for the
 * picture's sides S and whole numbers M, where that is close. */
void otx_lattice_fit(
    const otx_image *image, bool wrap_x, bool wrap_y, otx_vec2 g[2]);

#endif

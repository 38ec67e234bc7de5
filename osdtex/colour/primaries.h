/* primaries.h -- RGB primaries as matrices to ACES2065-1, and back.
 *
 * Two spaces are the same when their matrices to a common space are, which
 * holds whatever their white points; chromaticities alone do not show that,
 * since OpenColorIO's matrices adapt every white to that of ACES. */
#ifndef OTX_COLOUR_PRIMARIES_H
#define OTX_COLOUR_PRIMARIES_H

#include <stdbool.h>

/* Row-major 3 × 3, applied to a column (R, G, B). */
typedef struct otx_primaries_matrix
{
    double m[3][3];
} otx_primaries_matrix;

otx_primaries_matrix
otx_primaries_multiply(otx_primaries_matrix a, otx_primaries_matrix b);

/* Largest absolute difference of the elements. */
double otx_primaries_difference(otx_primaries_matrix a, otx_primaries_matrix b);

/* The matrix from linear RGB of primaries and white `xy` (pairs R, G, B, W) to
 * ACES2065-1, the white adapted by Bradford. False when the chromaticities do
 * not span a space. */
bool otx_primaries_to_aces(const float xy[8], otx_primaries_matrix *to_aces);

/* The matrix from CIE XYZ under D50, as ICC profiles have it, likewise. */
bool otx_primaries_xyz_to_aces(otx_primaries_matrix *to_aces);

/* False for a matrix that is singular or not finite. */
bool otx_primaries_invert(otx_primaries_matrix a, otx_primaries_matrix *out);

/* Chromaticities of the space with that matrix, as they are after adaptation
 * to the white of ACES. False when a colour has no brightness. */
bool otx_primaries_from_aces(const otx_primaries_matrix *to_aces, float xy[8]);

#endif

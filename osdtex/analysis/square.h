/* square.h -- the middle of a picture, as it is analysed.
 *
 * The luminance of the centre square, at most 512 texels wide, freed of slow
 * shading and of noise. */
#ifndef OTX_ANALYSIS_SQUARE_H
#define OTX_ANALYSIS_SQUARE_H

#include "image/image.h"

typedef struct otx_square
{
    otx_run *run;
    int32_t side;
    int32_t x0, y0; /* in the picture */
    int32_t texel;  /* of the picture, along a side of one of the square */
    float *f;       /* [side * side] mean 0 */
} otx_square;

/* Cuts it out of a Lab picture, in run->scratch. MEMORY. */
otx_status otx_square_cut(otx_run *run, const otx_image *lab, otx_square *out);

/* Gaussian blur of n x n values. `from` and `to` differ. MEMORY. */
otx_status otx_square_blur(
    otx_run *run, const float *from, float *to, int32_t n, double sigma);

#endif

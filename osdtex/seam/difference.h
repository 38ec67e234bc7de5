/* difference.h -- how different two sides of a seam look.
 *
 * A difference is a distance of colours in the space of the pictures that are
 * given: match space where pieces are fitted together, Lab where the result is
 * judged. Along an edge it is integrated over the samples of seam/edge.h, as a
 * mean (what is seen of it) or as an energy (what least squares lower). */
#ifndef OTX_SEAM_DIFFERENCE_H
#define OTX_SEAM_DIFFERENCE_H

#include "image/view.h"

/* Distance of two colours of three channels. */
static inline double
otx_difference(const float *a, const float *b)
{
    const double x = a[0] - b[0];
    const double y = a[1] - b[1];
    const double z = a[2] - b[2];

    return sqrt(x * x + y * y + z * z);
}

/* `sum` and the squared distance of two colours. */
static inline double
otx_difference_add_sq(double sum, const double a[3], const double b[3])
{
    for (int c = 0; c < 3; ++c)
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

/* Mean distance of `count` pairs of colours.
 *
 *   a, b  [count * 3] */
double otx_difference_mean(const float *a, const float *b, int32_t count);

/* What one side of an edge shows. */
typedef struct otx_seam_side
{
    otx_image_view view;
    otx_vec2 pixels;  /* of the view's picture to a texel, along x and y: its
                       * picture may be a coarser level of the exemplar's */
    otx_vec2 ends[2]; /* texel positions of the edge's ends */
} otx_seam_side;

/* The colour at a share of the way along a side, and its derivative by the
 * texel position. */
void otx_difference_look(
    const otx_seam_side *side, double t, double color[3], otx_vec2 slope[3]);

/* Sum of squared distances of two sides at `count` samples: times length over
 * count, the energy of the edge. */
double otx_difference_sum(
    const otx_seam_side *a, const otx_seam_side *b, int32_t count);

#endif

/* edges.h -- how much a picture changes at each texel.
 *
 * Two places may show the same colours and another structure: one inside a
 * stone, the other where two stones meet. Edge strength tells them apart, and
 * does not depend on how the picture is turned. */
#ifndef OTX_ANALYSIS_EDGES_H
#define OTX_ANALYSIS_EDGES_H

#include "image/image.h"

typedef struct otx_edges
{
    otx_image strength; /* 1 channel: length of the gradient of all channels
                         * together, smoothed over 3 x 3 texels (Sobel), in
                         * units of the picture per texel */
    double sigma; /* RMS difference of the strength of two random texels */
} otx_edges;

/* Beyond a rim that does not tile the last texel is repeated.
 * LIMIT, MEMORY. */
otx_status otx_edges_find(
    otx_run *run, otx_arena *arena, const otx_image *image, bool wrap_x,
    bool wrap_y, otx_edges *out);

/* The channels of `image` and, behind them, `factor` times its edges. LIMIT,
 * MEMORY. */
otx_status otx_edges_append(
    otx_run *run, otx_arena *arena, const otx_image *image,
    const otx_edges *edges, double factor, otx_image *out);

#endif

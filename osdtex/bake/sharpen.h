/* sharpen.h -- texels such that what is between them comes out right.
 *
 * Renderers interpolate between texels bilinearly. Texels that hold the
 * surface's colour at their centres give chords of it, which are wrong always
 * to the same side, so that whole pixels are: by h^2 / 12 of the second
 * derivative in the mean, h the texel. Texels that are too far to the other
 * side by as much give the right means [Blu04, quasi-interpolation by linear
 * splines]. No texel leaves the range of those around it: edges get no rims of
 * light. See docs/notes/bake.md. */
#ifndef OTX_BAKE_SHARPEN_H
#define OTX_BAKE_SHARPEN_H

#include "base/status.h"

/* Texels with what surrounds them. */
typedef struct otx_sharpen_grid
{
    int32_t width, height, channels;
    const float *pixels;   /* [width * height * channels] */
    const int32_t *owners; /* [width * height] the chart that a texel is of; -1
                            * where it only continues one */
} otx_sharpen_grid;

/* Sharpens width x height texels, of which the lower left one is texel
 * (left, below) of the grid. At its rims, and where a texel beside one is of
 * another chart, that direction stays as it is. */
void otx_sharpen_texels(
    const otx_sharpen_grid *grid, int32_t left, int32_t below, int32_t width,
    int32_t height, float *out);

#endif

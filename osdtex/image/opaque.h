/* opaque.h -- where a picture can be taken from.
 *
 * A texel that is transparent throughout has no colour: taken as a source it
 * is a black hole in the surface. */
#ifndef OTX_IMAGE_OPAQUE_H
#define OTX_IMAGE_OPAQUE_H

#include "image/image.h"

typedef struct otx_opaque
{
    double transparent;          /* share of texels whose alpha is 0 */
    int32_t x, y, width, height; /* the largest rectangle without any; of
                                  * several the first by rows from the bottom */
} otx_opaque;

/* Looks at the alpha of `image`; without one all of it is opaque. Temporaries
 * lie in `arena`. False when memory is out. */
bool otx_opaque_find(otx_arena *arena, const otx_image *image, otx_opaque *out);

#endif

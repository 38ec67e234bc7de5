/* tileable.h -- does a picture continue across its own border?
 *
 * See docs/notes/colour.md, "Does it tile?". */
#ifndef OTX_EXEMPLAR_TILEABLE_H
#define OTX_EXEMPLAR_TILEABLE_H

#include "image/image.h"

/* What was measured along one axis. Steps are RMS distances between texels
 * that lie side by side, in the units of the image. */
typedef struct otx_tileable
{
    bool tiles;
    double border; /* step across the border */
    double inner;  /* mean step inside */
} otx_tileable;

/* Tests `image` (Lab, 3 channels) left to right (`axis` 0) or bottom to top
 * (1). */
otx_status otx_tileable_test(
    otx_run *run, const otx_image *image, int32_t axis, otx_tileable *out);

#endif

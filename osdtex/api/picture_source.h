/* picture_source.h -- what a picture file says of its colours, as the rules
 * that find its colour space want it. */
#ifndef OTX_API_PICTURE_SOURCE_H
#define OTX_API_PICTURE_SOURCE_H

#include "colour/colour.h"
#include "file/picture.h"

/* Leaves path and from as they are. Borrows the picture's strings and
 * profile. */
void
otx_picture_source_fill(const otx_picture *picture, otx_colour_source *out);

/* How its numbers are stored: "8-bit", "half", ... */
const char *otx_picture_source_type(const otx_picture *picture);

#endif

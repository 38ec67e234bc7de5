/* lettering.h -- words on a picture. */
#ifndef OTX_IMAGE_LETTERING_H
#define OTX_IMAGE_LETTERING_H

#include "image/image.h"

/* Writes letters, digits and blanks in capitals of 3 x 5 squares, white on a
 * dark ground of a square more to each side. What lies outside the picture is
 * cut off; other characters are blanks.
 *
 *   x, y   upper left corner of the first letter, pixels from the lower left
 *   scale  pixels of a square's side */
void otx_lettering_write(
    otx_image *image, int32_t x, int32_t y, int32_t scale, const char *text);

#endif

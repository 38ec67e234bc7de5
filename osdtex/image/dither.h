/* dither.h -- noise that hides the steps of 8 bits. */
#ifndef OTX_IMAGE_DITHER_H
#define OTX_IMAGE_DITHER_H

#include "image/image.h"

/* Adds noise of half a step of 8 bits to either side to the colour of an image
 * with values from 0 to 1, so that what is smooth has no bands once it is
 * rounded. Alpha stays, and so does a value that 8 bits can hold. The same
 * image gives the same noise. */
void otx_dither_8bit(otx_image *image);

#endif

/* tint.h -- numbers as colours that people can tell apart. Scene-linear. */
#ifndef OTX_RENDER_TINT_H
#define OTX_RENDER_TINT_H

#include <stdint.h>

/* The stretch that is plain red, and one over that which is plain blue. */
#define OTX_TINT_STRETCH_FULL 1.5

/* A colour for patch `index`: hues a golden angle apart with two lightnesses,
 * so that neighbours in number differ. Grey for -1. */
void otx_tint_patch(int32_t index, float rgb[3]);

/* Blue below 1, white at 1, red above; full colour at the ratio below.
 * Magenta for what is not finite. */
void otx_tint_stretch(double stretch, float rgb[3]);

#endif

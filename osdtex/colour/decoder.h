/* decoder.h -- from the numbers of a file to a linear space of the
 * configuration, where the file says what its numbers mean in other words than
 * by the name of a space: an ICC profile, a gamma, primaries. */
#ifndef OTX_COLOUR_DECODER_H
#define OTX_COLOUR_DECODER_H

#include "colour/colour.h"

typedef struct otx_decoder otx_decoder;

/* What the file says of its encoding, in `*out`, in run->arena; NULL where it
 * says nothing but sRGB, and where what it says cannot be applied, which is one
 * warning. Linear files' primaries are looked at when `is_linear`. MEMORY. */
otx_status otx_decoder_create(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    bool is_linear, const otx_decoder **out);

/* The linear space that it leads to, and what it is called in the log. */
const char *otx_decoder_space(const otx_decoder *decoder);
const char *otx_decoder_name(const otx_decoder *decoder);

/* Decodes an image of 3 or 4 channels in place, over all threads; colour is not
 * multiplied by A. */
otx_status
otx_decoder_apply(otx_run *run, const otx_decoder *decoder, otx_image *image);

#endif

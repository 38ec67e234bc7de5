/* few_values.h -- conversions of pictures that hold few values.
 *
 * Of integers of 8 bits there are 256, and a curve is the same for each, so it
 * is asked once for all texels of a row that show one. To the bit what the
 * conversion itself gives. */
#ifndef OTX_COLOUR_FEW_VALUES_H
#define OTX_COLOUR_FEW_VALUES_H

#include "bridge/ocio.h"

/* As otx_ocio_conversion_apply, of a conversion whose channels do not look at
 * each other. */
otx_status otx_few_values_apply(
    const otx_ocio_conversion *conversion, float *pixels, int64_t count,
    int32_t channels, char *message);

#endif

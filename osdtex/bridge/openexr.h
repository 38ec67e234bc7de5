/* openexr.h -- what OpenEXR reads in C++ only, for C.
 *
 * The C core of OpenEXR 3.1 does not decompress DWAA and DWAB, and knows
 * nothing of luminance with subsampled chroma. The C++ library does both. The
 * caller has read the header through the core and checked what it claims. */
#ifndef OTX_BRIDGE_OPENEXR_H
#define OTX_BRIDGE_OPENEXR_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

    enum
    {
        OTX_OPENEXR_REASON_BYTES = 200
    };

    typedef struct otx_openexr_picture
    {
        const char *path;
        int32_t part;
        /* Channels of R, G, B, A; several may be one, NULL: none. Not looked at
         * where `is_chroma`. */
        const char *channels[4];
        bool is_chroma;       /* Y, RY and BY (and A), of the only part */
        int32_t y_min, y_max; /* rows to read, of the data window */
    } otx_openexr_picture;

    /* Takes row `y`: R, G, B, A of each pixel of the data window, A 1 where
     * there is none. */
    typedef void (*otx_openexr_sink)(
        void *user, int32_t y, const float *row, int32_t x_min, int32_t width);

    /* Reads the rows in order. FORMAT with what OpenEXR says in `reason` (its
     * control characters replaced), MEMORY. */
    otx_status otx_openexr_read(
        const otx_openexr_picture *picture, otx_openexr_sink sink, void *user,
        char reason[OTX_OPENEXR_REASON_BYTES]);

#ifdef __cplusplus
}
#endif
#endif

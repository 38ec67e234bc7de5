/* exr_layer.h -- which part and which channels of an EXR are the picture.
 *
 * The first flat part with R, G, B, or Y alone, or a layer that has R, G and B;
 * whatever is passed over for it is said. */
#ifndef OTX_FILE_EXR_LAYER_H
#define OTX_FILE_EXR_LAYER_H

#include "base/run.h"

#include <OpenEXR/openexr.h>

enum
{
    OTX_EXR_NO_CHANNEL = -1
};

typedef struct otx_exr_layer
{
    int part;
    int32_t channels[4]; /* sources of R, G, B, A in the part's list; A may be
                          * OTX_EXR_NO_CHANNEL */
    bool is_gray;        /* R, G and B are one channel */
    int32_t bits;        /* of R: 16 or 32 */
    const char *name;    /* of the layer, in run->arena; NULL: plain channels */
} otx_exr_layer;

/* SUPPORT when nothing in the file can be shown, or its colours are
 * subsampled. */
otx_status otx_exr_layer_choose(
    otx_run *run, const char *path, exr_const_context_t file,
    otx_exr_layer *out);

#endif

/* exr_layer.h -- which part and which channels of an EXR are the picture.
 *
 * Renderers put many pictures into one file: the beauty, its components, and
 * numbers that are no colours (normals, depth, cryptomattes). Plain R, G, B of
 * any part come first, then a layer that is called as beauties are, then the
 * only layer that has colours; where there are several, they are listed and the
 * user says which. */
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
    bool is_chroma;      /* Y with subsampled RY and BY: `channels` are these
                          * and A */
    int32_t bits;        /* of R: 16 or 32 */
    const char *name;    /* of the layer, in run->arena; NULL: plain channels of
                          * a part without a name */
} otx_exr_layer;

/*   wanted  a layer or part by name: all of it, or what stands behind its last
 *           dot; else one that holds numbers (exr_data.h); NULL: by the rule
 *           above
 *
 * SUPPORT when nothing in the file can be shown, or it is unclear what, or the
 * colours are subsampled; ARGUMENT when there is no such layer. */
otx_status otx_exr_layer_choose(
    otx_run *run, const char *path, exr_const_context_t file,
    const char *wanted, otx_exr_layer *out);

#endif

/* given.h -- surfaces that are textured in part already. */
#ifndef OTX_PATCH_GIVEN_H
#define OTX_PATCH_GIVEN_H

#include "math/vec.h"

/* What is textured before patches cover the rest. */
typedef struct otx_patch_given
{
    const int32_t *face_patch; /* [leaf face_count], -1 to be covered */
    int32_t patch_count;
    const otx_vec2 *uvs; /* [leaf corner_count] texels; corners that share
                          * vertex and patch are equal */
    double reach;        /* texels from a seam within which they may be moved */
} otx_patch_given;

#endif

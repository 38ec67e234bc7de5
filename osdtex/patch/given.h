/* given.h -- surfaces that are textured in part already. */
#ifndef OTX_PATCH_GIVEN_H
#define OTX_PATCH_GIVEN_H

#include "math/vec.h"

#include <stdbool.h>

/* What an edit may do to a face that is textured. */
enum
{
    OTX_GIVEN_HELD = 0, /* nothing: it shows the same afterwards, to the bit */
    OTX_GIVEN_FREE = 1  /* move it, and give it to a patch that fits better */
};

/* What is textured before patches cover the rest. */
typedef struct otx_patch_given
{
    const int32_t *face_patch; /* [leaf face_count], -1 to be covered */
    int32_t patch_count;
    const otx_vec2 *uvs; /* [leaf corner_count] texels; corners that share
                          * vertex and patch are equal */
    double reach;        /* texels from a seam within which they may be moved */
    /* Of edits, the three NULL otherwise. [leaf face_count] OTX_GIVEN_...; of
     * faces to be covered it says nothing. Shapes are then the surface's, and
     * patches keep their numbers, new ones come after them. */
    const uint8_t *state;
    /* [leaf face_count] the patch that a face to be covered was of, which may
     * still have it at its `uvs`; -1 none. */
    const int32_t *before;
    const uint8_t *patch_exemplar; /* [patch_count] NULL: the first */
    /* Not 0: what faces to be covered showed, at `uvs`, is to be shown by them
     * as little as can be. From 2 on another seed prefers other parts of the
     * exemplar; 1 takes what fits best. */
    int32_t avoid;
} otx_patch_given;

#endif

/* mask_build.h -- what the neighbours of a patch show. */
#ifndef OTX_PATCH_MASK_BUILD_H
#define OTX_PATCH_MASK_BUILD_H

#include "match/mask.h"
#include "patch/mosaic.h"

/* The textured faces of a node's collar as mask triangles, in `scratch`.
 * MEMORY, without a finding. */
otx_status otx_mask_build(
    const otx_mosaic *m, const otx_node *node, otx_arena *scratch,
    otx_mask_triangle **out, int32_t *out_count);

#endif

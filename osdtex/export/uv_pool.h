/* uv_pool.h -- UVs by corner as a pool and indices, the way files store them.
 *
 * Corners of one vertex with the same UV share an entry, so that readers weld
 * what belongs together and seams stay where they are. Corners of different
 * vertices never share: that would tie parts together that only happen to
 * show the same texel. */
#ifndef OTX_EXPORT_UV_POOL_H
#define OTX_EXPORT_UV_POOL_H

#include "base/run.h"

typedef struct otx_uv_pool
{
    int32_t count;
    const float *uvs;       /* [count * 2], in the order of first use */
    const int32_t *indices; /* [corner_count] */
} otx_uv_pool;

/*   verts  [corner_count]
 *   uvs    [corner_count * 2]
 *
 * Made in `arena`. MEMORY. */
otx_status otx_uv_pool_build(
    otx_run *run, otx_arena *arena, int32_t corner_count, const int32_t *verts,
    const float *uvs, otx_uv_pool *out);

#endif

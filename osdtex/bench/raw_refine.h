/* raw_refine.h -- the refinement of a cage by bare OpenSubdiv calls. */
#ifndef OTX_BENCH_RAW_REFINE_H
#define OTX_BENCH_RAW_REFINE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

    /* A Catmull-Clark cage of quads without tags. */
    typedef struct bench_raw_cage
    {
        int32_t vert_count, face_count, uv_count;
        const float *points;       /* [vert_count * 3] */
        const int32_t *face_verts; /* [face_count * 4] */
        const float *uvs;          /* [uv_count * 2] */
        const int32_t *face_uvs;   /* [face_count * 4] where uv_count > 0 */
    } bench_raw_cage;

    /* What a program would write that needs refined positions, limit positions,
     * tangents and UVs and nothing else: no relations, no checks, no frames.
     * Everything is destroyed before the return.
     *
     *   points  [leaf verts * 3] or NULL: gets the limit positions
     *
     * False when something was thrown. */
    bool bench_raw_refine_run(
        const bench_raw_cage *cage, int32_t level, float *points);

#ifdef __cplusplus
}
#endif
#endif

/* draft.c -- a cage refined only as far as costs nothing. */
#include "surface/draft.h"

#include "surface/limit.h"
#include "surface/plain.h"
#include "surface/refine.h"

/* Faces of a draft: its refinement takes some 20 ms. */
static const double FACES_MAX = 20000.0;

/* The deepest level that is a draft; -1: not even the cage is. */
static int32_t
depth_of(const otx_cage *cage, int32_t level)
{
    int32_t depth = -1;

    if (cage->scheme == OTX_SCHEME_NONE)
        return -1;
    while (depth < level &&
           otx_surface_face_count(cage, depth + 1) <= FACES_MAX)
        ++depth;
    return depth;
}

otx_status
otx_surface_draft(
    otx_run *run, const otx_cage *cage, int32_t level, otx_surface *out)
{
    const int32_t depth = depth_of(cage, level);
    float *tangents;

    OTX_TRY(
        depth < 0 ? otx_plain_cage(run, cage, out, &tangents)
                  : otx_refine_cage(run, cage, depth, out, &tangents));
    return otx_limit_measure(
        run, otx_surface_leaf(out), out->points, &out->area,
        &out->mean_edge_length);
}

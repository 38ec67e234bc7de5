/* edge.c -- corners, continuity and samples of an edge.
 *
 * Patch labels play no part: two patches that happen to agree along an edge
 * are continuous there, and a chart that is torn inside one patch is not. */
#include "seam/edge.h"

#include <assert.h>

void
otx_seam_corners(
    const otx_level *level, int32_t edge, int32_t face, int32_t corners[2])
{
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    int32_t k = 0;

    while (k + 1 < size && level->face_edges[first + k] != edge)
        ++k;
    assert(level->face_edges[first + k] == edge);

    const int32_t from = first + k;
    const int32_t to = first + (k + 1 == size ? 0 : k + 1);
    const bool along =
        level->face_verts[from] == level->edge_verts[2 * (size_t)edge];

    corners[0] = along ? from : to;
    corners[1] = along ? to : from;
}

bool
otx_seam_continuous(
    const otx_exemplar *exemplar, const otx_vec2 a[2], const otx_vec2 b[2])
{
    const double width = exemplar->match.width;
    const double height = exemplar->match.height;
    otx_vec2 shift = otx_vec2_sub(b[0], a[0]);

    shift.x = exemplar->wrap_x ? width * round(shift.x / width) : 0.0;
    shift.y = exemplar->wrap_y ? height * round(shift.y / height) : 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const otx_vec2 d = otx_vec2_sub(otx_vec2_sub(b[k], a[k]), shift);

        /* Written so that NaN is a seam. */
        if (!(fabs(d.x) <= OTX_SEAM_TOLERANCE &&
              fabs(d.y) <= OTX_SEAM_TOLERANCE))
            return false;
    }
    return true;
}

int32_t
otx_seam_sample_count(double length)
{
    if (!(length > 2.0))
        return 2;
    return length < OTX_SEAM_SAMPLES_MAX ? (int32_t)ceil(length)
                                         : OTX_SEAM_SAMPLES_MAX;
}

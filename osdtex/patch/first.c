/* first.c -- the patch that the user begins with.
 *
 * What he says of it he says of a face of the cage: where in the picture its
 * middle lies, and which way its first edge runs. A patch may be larger than
 * that face or smaller; it is the face that he sees. */
#include "patch/first.h"

static bool
is_on_face(const otx_mosaic *m, int32_t leaf)
{
    return m->job.leaves.level->face_cage[leaf] == m->job.first.face;
}

int32_t
otx_first_node(const otx_mosaic *m)
{
    const otx_level *leaf = m->job.leaves.level;

    if (m->job.first.face < 0)
        return -1;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (is_on_face(m, f))
            return m->forest.leaf_node[f];
    return -1;
}

bool
otx_first_is(const otx_mosaic *m, const otx_node *node)
{
    if (m->job.first.face < 0 || m->cover.patch_count > 0)
        return false;
    for (int32_t i = 0; i < node->leaf_count; ++i)
        if (is_on_face(m, node->leaves[i]))
            return true;
    return false;
}

bool
otx_first_holds(const otx_mosaic *m, int32_t leaf)
{
    return m->job.first.face >= 0 && is_on_face(m, leaf) &&
           m->cover.face_patch[leaf] == 0;
}

otx_vec2
otx_first_middle(const otx_mosaic *m, const otx_chart *chart)
{
    otx_vec2 sum = {0, 0};
    int32_t corners = 0;

    for (int32_t i = 0; i < chart->core_count; ++i)
    {
        if (!is_on_face(m, chart->faces[i]))
            continue;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            sum = otx_vec2_add(sum, chart->flat[chart->corners[c]]);
        corners += chart->first[i + 1] - chart->first[i];
    }
    return otx_vec2_scale(1.0 / corners, sum);
}

double
otx_first_heading(const otx_mosaic *m, const otx_chart *chart)
{
    const otx_level *cage = &m->job.surface->levels[0];
    const int32_t *ends =
        cage->face_verts + cage->face_first[m->job.first.face];
    int32_t found[2] = {-1, -1};
    otx_vec2 edge;

    for (int32_t v = chart->vert_count - 1; v >= 0; --v)
        for (int k = 0; k < 2; ++k)
            if (chart->verts[v] == ends[k])
                found[k] = v;
    if (found[0] < 0 || found[1] < 0)
        return 0.0;
    edge = otx_vec2_sub(chart->flat[found[1]], chart->flat[found[0]]);
    return atan2(edge.y, edge.x);
}

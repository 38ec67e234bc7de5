/* given.c -- surfaces that are textured in part already.
 *
 * Another method has laid its texture where it can; the rest is covered by
 * patches that continue it. What is given takes part in the cut and in the
 * relaxation like any patch, but offers nothing beyond its own faces. */
#include "method/hierarchical/hierarchical.h"

#include <string.h>

void
otx_given_take(otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;
    const otx_method_given *given = m->given;

    m->patch_count = given->patch_count;
    for (int32_t p = 0; p < given->patch_count; ++p)
        m->patch_node[p] = -1;
    memcpy(m->uvs, given->uvs, (size_t)leaf->corner_count * sizeof *m->uvs);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        m->face_patch[f] = leaf->face_hole[f] ? -1 : given->face_patch[f];
        if (m->face_patch[f] >= 0)
            m->done_area += m->leaves.areas[f];
    }
}

otx_status
otx_given_clusters(otx_mapper *m, otx_cluster_list *out)
{
    const otx_level *leaf = m->leaves.level;
    int32_t *faces = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    otx_cluster open = {m->leaves.level_index, 0, faces, 0.0};

    if (!faces)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (m->face_patch[f] < 0 && !leaf->face_hole[f])
        {
            faces[open.face_count++] = f;
            open.area += m->leaves.areas[f];
        }
    if (open.face_count == 0)
    {
        *out = (otx_cluster_list){0};
        return OSDTEX_OK;
    }
    return otx_nodes_grow(m, &m->supplies[0], &m->leaves, &open, out);
}

/* The faces of one given patch, at their UVs. */
static otx_status
offer_patch(otx_mapper *m, int32_t patch, int32_t count)
{
    const otx_level *leaf = m->leaves.level;
    int32_t *faces = OTX_NEW(m->run->arena, int32_t, count);
    int32_t *first = OTX_NEW(m->run->arena, int32_t, count + 1);
    int32_t corners = 0, n = 0;
    otx_vec2 *uvs;

    if (!faces || !first)
        return otx_fail_memory(m->run, "cut");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (m->given->face_patch[f] == patch && !leaf->face_hole[f])
        {
            faces[n] = f;
            first[n++] = corners;
            corners += otx_level_face_size(leaf, f);
        }
    first[n] = corners;
    uvs = OTX_NEW(m->run->arena, otx_vec2, corners);
    if (!uvs)
        return otx_fail_memory(m->run, "cut");
    for (int32_t i = 0; i < n; ++i)
        memcpy(
            uvs + first[i], m->given->uvs + leaf->face_first[faces[i]],
            (size_t)(first[i + 1] - first[i]) * sizeof *uvs);
    m->offers[patch] = (otx_offer){n, faces, uvs, first, NULL, 0};
    return OSDTEX_OK;
}

otx_status
otx_given_offers(otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;
    int32_t *counts =
        OTX_ZNEW(m->run->scratch, int32_t, m->given->patch_count + 1);

    if (!counts)
        return otx_fail_memory(m->run, "cut");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (m->given->face_patch[f] >= 0 && !leaf->face_hole[f])
            ++counts[m->given->face_patch[f]];
    for (int32_t p = 0; p < m->given->patch_count; ++p)
        OTX_TRY(offer_patch(m, p, counts[p]));
    return OSDTEX_OK;
}

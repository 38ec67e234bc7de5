/* pinch.c -- a cage whose parts touch only at vertices, parted there. */
#include "surface/pinch.h"

#include "surface/sever.h"
#include "surface/topology.h"

#include <string.h>

#define STAGE "refine"

/* The ends of a crease are those of its edge in the faces beside it: both
 * faces of an edge hold together, so either will do. */
static otx_status
split_creases(
    otx_run *run, const otx_cage *cage, const otx_sever *mesh, otx_cage *out)
{
    int32_t *verts =
        OTX_NEW(run->scratch, int32_t, 2 * (size_t)cage->crease_count);
    otx_topology t;

    if (!verts || !otx_topology_build(
                      run->scratch, cage->vert_count, cage->face_count,
                      cage->face_first, cage->face_verts, &t))
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < cage->crease_count; ++i)
    {
        const int32_t *ends = cage->crease_verts + 2 * (size_t)i;
        const int32_t edge = otx_topology_find_edge(&t, ends[0], ends[1]);
        const int32_t corner = t.edge_corners[t.edge_corner_first[edge]];

        verts[2 * (size_t)i] = mesh->face_verts[corner];
        verts[2 * (size_t)i + 1] =
            mesh->face_verts[otx_topology_next(&t, corner)];
    }
    out->crease_verts = verts;
    return OSDTEX_OK;
}

/* Which vertices were parted, and what they were parted into: all are sharp,
 * whatever the cage's corners say of them. The last tag of a vertex holds. */
static otx_status
split_corners(
    otx_run *run, const otx_cage *cage, const otx_sever *mesh, otx_cage *out)
{
    const int32_t added = mesh->vert_count - cage->vert_count;
    const int32_t count = cage->corner_tag_count + 2 * added;
    int32_t *verts = OTX_NEW(run->scratch, int32_t, count);
    float *sharpness = OTX_NEW(run->scratch, float, count);
    int32_t to = cage->corner_tag_count;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < cage->corner_tag_count; ++i)
    {
        verts[i] = cage->corner_tag_verts[i];
        sharpness[i] = cage->corner_tag_sharpness[i];
    }
    for (int32_t v = cage->vert_count; v < mesh->vert_count; ++v)
    {
        verts[to] = mesh->source[v];
        verts[to + 1] = v;
        sharpness[to] = sharpness[to + 1] = OTX_CAGE_SHARPNESS_MAX;
        to += 2;
    }
    out->corner_tag_count = count;
    out->corner_tag_verts = verts;
    out->corner_tag_sharpness = sharpness;
    return OSDTEX_OK;
}

otx_status
otx_pinch_split(otx_run *run, const otx_cage *cage, otx_cage *out)
{
    otx_sever mesh;

    *out = *cage;
    if (cage->split_count == 0)
        return OSDTEX_OK;
    if (!otx_sever_build(
            run->scratch, cage->vert_count, cage->face_count, cage->face_first,
            cage->face_verts, &mesh))
        return otx_fail_memory(run, STAGE);
    if (!mesh.source || mesh.vert_count - cage->vert_count != cage->split_count)
        return otx_fail(
            run, OSDTEX_ERROR_NUMERIC, STAGE, OTX_NOWHERE,
            "the cage's pinch vertices were counted otherwise than parted");
    out->vert_count = mesh.vert_count;
    out->face_verts = mesh.face_verts;
    out->points = otx_sever_points(run->scratch, &mesh, cage->points);
    OTX_TRY(otx_run_ok(run));
    out->split_count = 0;
    OTX_TRY(split_creases(run, cage, &mesh, out));
    return split_corners(run, cage, &mesh, out);
}

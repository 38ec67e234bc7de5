/* plain.c -- a mesh that is not subdivided is a surface of one level. */
#include "surface/plain.h"
#include "surface/topology.h"

#define STAGE "refine"

/* Edges with the faces on both sides; NULL when memory is out. */
static int32_t *
edge_faces(otx_arena *arena, const otx_topology *t)
{
    int32_t *faces = OTX_NEW(arena, int32_t, 2 * (size_t)t->edge_count);

    for (int32_t e = 0; faces && e < t->edge_count; ++e)
    {
        const int32_t *corners = t->edge_corners + t->edge_corner_first[e];

        faces[2 * (size_t)e] = t->corner_face[corners[0]];
        faces[2 * (size_t)e + 1] =
            otx_topology_edge_size(t, e) == 2 ? t->corner_face[corners[1]] : -1;
    }
    return faces;
}

otx_status
otx_plain_cage(
    otx_run *run, const otx_cage *cage, otx_surface *out, float **tangents)
{
    otx_level *level = OTX_ZNEW(run->arena, otx_level, 1);
    int32_t *face_cage = OTX_NEW(run->arena, int32_t, cage->face_count);
    float *none = OTX_ZNEW(run->arena, float, 6 * (size_t)cage->vert_count);
    int32_t *faces;
    otx_topology t;

    if (!level || !face_cage || !none ||
        !otx_topology_build(
            run->arena, cage->vert_count, cage->face_count, cage->face_first,
            cage->face_verts, &t))
        return otx_fail_memory(run, STAGE);
    faces = edge_faces(run->arena, &t);
    if (!faces)
        return otx_fail_memory(run, STAGE);
    for (int32_t f = 0; f < cage->face_count; ++f)
        face_cage[f] = f;
    *level = (otx_level){
        .face_count = cage->face_count,
        .vert_count = cage->vert_count,
        .edge_count = t.edge_count,
        .corner_count = cage->corner_count,
        .face_first = cage->face_first,
        .face_verts = cage->face_verts,
        .face_edges = t.corner_edge,
        .edge_verts = t.edge_verts,
        .edge_faces = faces,
        .face_hole = cage->face_hole,
        .face_cage = face_cage};
    *out = (otx_surface){
        .cage = cage,
        .level_count = 1,
        .levels = level,
        .points = cage->points,
        .tangents = none,
        .uv_count = cage->uv_count,
        .uvs = cage->uvs,
        .face_uvs = cage->face_uvs};
    *tangents = none;
    return OSDTEX_OK;
}

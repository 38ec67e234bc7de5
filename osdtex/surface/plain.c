/* plain.c -- a mesh that is not subdivided is a surface of one level. */
#include "surface/plain.h"
#include "surface/sever.h"
#include "surface/topology.h"

#include <string.h>

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

static otx_status
make_level(
    otx_run *run, const otx_cage *cage, const otx_sever *mesh, otx_level *out)
{
    int32_t *face_cage = OTX_NEW(run->arena, int32_t, cage->face_count);
    int32_t *faces;
    otx_topology t;

    if (!face_cage || !otx_topology_build(
                          run->arena, mesh->vert_count, cage->face_count,
                          cage->face_first, mesh->face_verts, &t))
        return otx_fail_memory(run, STAGE);
    faces = edge_faces(run->arena, &t);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < cage->face_count; ++f)
        face_cage[f] = f;
    *out = (otx_level){
        .face_count = cage->face_count,
        .vert_count = mesh->vert_count,
        .edge_count = t.edge_count,
        .corner_count = cage->corner_count,
        .face_first = cage->face_first,
        .face_verts = mesh->face_verts,
        .face_edges = t.corner_edge,
        .edge_verts = t.edge_verts,
        .edge_faces = faces,
        .face_hole = cage->face_hole,
        .face_cage = face_cage};
    return OSDTEX_OK;
}

otx_status
otx_plain_cage(
    otx_run *run, const otx_cage *cage, otx_surface *out, float **tangents)
{
    otx_level *level = OTX_NEW(run->arena, otx_level, 1);
    otx_sever mesh;
    const float *points;
    float *none;

    if (!level || !otx_sever_build(
                      run->arena, cage->vert_count, cage->face_count,
                      cage->face_first, cage->face_verts, &mesh))
        return otx_fail_memory(run, STAGE);
    points = otx_sever_points(run->arena, &mesh, cage->points);
    none = OTX_ZNEW(run->arena, float, 6 * (size_t)mesh.vert_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(make_level(run, cage, &mesh, level));
    *out = (otx_surface){
        .cage = cage,
        .level_count = 1,
        .levels = level,
        .points = points,
        .tangents = none,
        .uv_count = cage->uv_count,
        .uvs = cage->uvs,
        .face_uvs = cage->face_uvs};
    *tangents = none;
    return OSDTEX_OK;
}

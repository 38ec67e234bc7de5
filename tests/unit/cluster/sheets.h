/* sheets.h -- surfaces for tests of clusters and charts: rectangles of quads,
 * bent without stretch, and refined cages. */
#ifndef OTX_TESTS_SHEETS_H
#define OTX_TESTS_SHEETS_H

#include "unit/surface/meshes.h"

#include "cluster/cluster.h"

enum
{
    SHEET_FLAT,
    SHEET_ROLLED, /* around a cylinder, by two radians */
    SHEET_FOLDED  /* by a right angle, along a line of vertices */
};

static inline otx_vec3
sheet_point(int kind, double x, double y, double width)
{
    const double radius = width / 2.0, half = floor(width / 2.0);

    if (kind == SHEET_ROLLED)
        return (otx_vec3){
            radius * sin(x / radius), y, radius * cos(x / radius)};
    if (kind == SHEET_FOLDED && x > half)
        return (otx_vec3){half, y, half - x};
    return (otx_vec3){x, y, 0.0};
}

static inline otx_surface
sheet_refine(
    otx_run *run, const otx_cage_input *in, otx_scheme scheme, int32_t level)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);

    options.scheme = scheme;
    *cage = mesh_build(run, in, &options);
    return mesh_refine(run, cage, level);
}

/* nx x ny unit quads, as they are. */
static inline otx_surface
sheet_create(otx_run *run, int32_t nx, int32_t ny, int kind)
{
    const int32_t row = nx + 1, verts = row * (ny + 1);
    float *points = OTX_NEW(run->arena, float, 3 * verts);
    int32_t *corners = OTX_NEW(run->arena, int32_t, 4 * nx * ny);
    otx_cage_input in;

    for (int32_t v = 0; v < verts; ++v)
    {
        const otx_vec3 p = sheet_point(kind, v % row, v / row, nx);

        points[3 * v] = (float)p.x;
        points[3 * v + 1] = (float)p.y;
        points[3 * v + 2] = (float)p.z;
    }
    for (int32_t f = 0; f < nx * ny; ++f)
    {
        const int32_t v = f / nx * row + f % nx;
        const int32_t corner[4] = {v, v + 1, v + row + 1, v + row};

        memcpy(corners + 4 * f, corner, sizeof corner);
    }
    in = mesh_input(run, points, verts, corners, nx * ny, 4);
    return sheet_refine(run, &in, OTX_SCHEME_NONE, 0);
}

static inline otx_surface
sheet_from_file(otx_run *run, const char *path, int32_t level)
{
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);

    if (mesh_cage_from_file(run, path, cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return mesh_refine(run, cage, level);
}

static inline otx_dual
sheet_dual(otx_run *run, const otx_surface *surface, int32_t level)
{
    otx_dual dual;

    assert_int_equal(otx_dual_build(run, surface, level, &dual), OSDTEX_OK);
    return dual;
}

/* All faces of a level as one cluster. */
static inline otx_cluster
sheet_all(otx_run *run, const otx_surface *surface, int32_t level)
{
    const int32_t count = surface->levels[level].face_count;
    int32_t *faces = OTX_NEW(run->arena, int32_t, count);

    for (int32_t f = 0; f < count; ++f)
        faces[f] = f;
    return (otx_cluster){level, count, faces, surface->area, -1};
}

/* Clusters grown in `region`, their borders seeking bends. */
static inline otx_status
sheet_grow(
    otx_run *run, const otx_dual *dual, const otx_cluster *region,
    double target, int32_t minimum, otx_cluster_list *out)
{
    otx_cluster_space space;
    const otx_growing how = {dual, 1.0, &space};

    assert_int_equal(
        otx_cluster_space_create(run, dual->level, &space), OSDTEX_OK);
    return otx_cluster_grow(run, &how, region, target, minimum, out);
}

#endif

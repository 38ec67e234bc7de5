/* meshes.h -- cages for the tests of surfaces: small shapes, and OBJ files. */
#ifndef OTX_TESTS_MESHES_H
#define OTX_TESTS_MESHES_H

#include "file/obj.h"
#include "support.h"
#include "surface/surface.h"

#include <math.h>

#define COUNT(array) ((int32_t)(sizeof(array) / sizeof((array)[0])))

/* Input over arrays whose faces all have `size` corners. */
static inline otx_cage_input
mesh_input(
    otx_run *run, const float *points, int32_t vert_count, const int32_t *verts,
    int32_t face_count, int32_t size)
{
    otx_cage_input in = otx_cage_input_none();
    int32_t *first = OTX_NEW(run->arena, int32_t, face_count + 1);

    for (int32_t f = 0; f <= face_count; ++f)
        first[f] = f * size;
    in.path = "test.obj";
    in.points = points;
    in.vert_count = vert_count;
    in.face_verts = verts;
    in.face_count = face_count;
    in.face_first = first;
    return in;
}

static const float cube_points[] = {-1, -1, 1,  1,  -1, 1, -1, 1,
                                    1,  1,  1,  1,  -1, 1, -1, 1,
                                    1,  -1, -1, -1, -1, 1, -1, -1};
static const int32_t cube_verts[] = {
    0, 1, 3, 2, 2, 3, 5, 4, 4, 5, 7, 6, 6, 7, 1, 0, 1, 7, 5, 3, 6, 0, 2, 4};

static inline otx_cage_input
mesh_cube(otx_run *run)
{
    return mesh_input(run, cube_points, 8, cube_verts, 6, 4);
}

/* n x n quads in the plane z = 0, over [0, n]^2, wound towards +z. */
static inline otx_cage_input
mesh_grid(otx_run *run, int32_t n)
{
    const int32_t side = n + 1;
    float *points = OTX_NEW(run->arena, float, 3 * side * side);
    int32_t *verts = OTX_NEW(run->arena, int32_t, 4 * n * n);
    int32_t *to = verts;

    for (int32_t v = 0; v < side * side; ++v)
    {
        points[3 * v] = (float)(v % side);
        points[3 * v + 1] = (float)(v / side);
        points[3 * v + 2] = 0.0f;
    }
    for (int32_t y = 0; y < n; ++y)
    {
        for (int32_t x = 0; x < n; ++x)
        {
            const int32_t v = y * side + x;

            *to++ = v;
            *to++ = v + 1;
            *to++ = v + side + 1;
            *to++ = v + side;
        }
    }
    return mesh_input(run, points, side * side, verts, n * n, 4);
}

static const float octahedron_points[] = {
    1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
static const int32_t octahedron_verts[] = {
    0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

static inline otx_cage_input
mesh_octahedron(otx_run *run)
{
    return mesh_input(run, octahedron_points, 6, octahedron_verts, 8, 3);
}

/* The file's boundary tag counts otherwise than the enum. */
static inline int32_t
mesh_boundary(int32_t tag)
{
    static const int32_t boundaries[] = {
        OTX_BOUNDARY_NONE, OTX_BOUNDARY_EDGE_AND_CORNER,
        OTX_BOUNDARY_EDGE_ONLY};

    return tag < 0 ? OTX_CAGE_UNSET : boundaries[tag];
}

static inline otx_cage_input
mesh_from_obj(const otx_obj *obj)
{
    otx_cage_input in = otx_cage_input_none();

    in.path = obj->path;
    in.vert_count = obj->vert_count;
    in.face_count = obj->face_count;
    in.uv_count = obj->uv_count;
    in.points = obj->points;
    in.colors = obj->colors;
    in.face_first = obj->face_first;
    in.face_verts = obj->face_verts;
    in.uvs = obj->uvs;
    in.face_uvs = obj->face_uvs;
    in.face_line = obj->face_line;
    in.crease_count = obj->creases.count;
    in.crease_verts = obj->creases.verts;
    in.crease_sharpness = obj->creases.sharpness;
    in.crease_line = obj->creases.line;
    in.corner_tag_count = obj->corners.count;
    in.corner_tag_verts = obj->corners.verts;
    in.corner_tag_sharpness = obj->corners.sharpness;
    in.corner_tag_line = obj->corners.line;
    in.hole_count = obj->hole_count;
    in.hole_faces = obj->hole_faces;
    in.hole_line = obj->hole_line;
    in.boundary = mesh_boundary(obj->boundary.value);
    in.fvar = obj->fvar.value;
    in.crease_chaikin = obj->crease_method.value;
    in.triangles_smooth = obj->triangles.value;
    in.group_count = obj->groups.count;
    in.group_names = obj->groups.text;
    in.face_group = obj->face_group;
    in.object_count = obj->objects.count;
    in.object_names = obj->objects.text;
    in.face_object = obj->face_object;
    in.material_count = obj->materials.count;
    in.material_names = obj->materials.text;
    in.face_material = obj->face_material;
    in.smooth_count = obj->smooths.count;
    in.smooth_names = obj->smooths.text;
    in.face_smooth = obj->face_smooth;
    in.library_count = obj->libraries.count;
    in.library_names = obj->libraries.text;
    return in;
}

/* Reads, builds; the scheme is Loop for files named so. */
static inline otx_status
mesh_cage_from_file(otx_run *run, const char *path, otx_cage *out)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage_input in;
    otx_obj obj;

    OTX_TRY(otx_obj_read(run, path, &obj));
    if (strstr(path, "/loop_"))
        options.scheme = OTX_SCHEME_LOOP;
    in = mesh_from_obj(&obj);
    return otx_cage_build(run, &in, &options, out);
}

static inline otx_cage
mesh_build(
    otx_run *run, const otx_cage_input *in, const otx_cage_options *options)
{
    const otx_cage_options defaults = otx_cage_options_default();
    otx_cage cage;

    if (otx_cage_build(run, in, options ? options : &defaults, &cage) !=
        OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return cage;
}

static inline otx_surface
mesh_refine(otx_run *run, const otx_cage *cage, int32_t level)
{
    otx_surface surface;

    if (otx_surface_refine(run, cage, level, 0, &surface) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return surface;
}

/* A grid of 4 x 4 whose UVs are its x and y, cut into two islands at x = 2:
 * the right one is pushed away by 10. */
static inline otx_cage_input
mesh_islands(otx_run *run)
{
    otx_cage_input in = mesh_grid(run, 4);
    float *uvs = OTX_NEW(run->arena, float, 2 * 50);
    int32_t *face_uvs = OTX_NEW(run->arena, int32_t, 64);

    for (int32_t v = 0; v < 50; ++v)
    {
        uvs[2 * v] = in.points[3 * (v % 25)] + (v < 25 ? 0.0f : 10.0f);
        uvs[2 * v + 1] = in.points[3 * (v % 25) + 1];
    }
    for (int32_t i = 0; i < 64; ++i)
        face_uvs[i] = in.face_verts[i] + (i / 4 % 4 < 2 ? 0 : 25);
    in.uvs = uvs;
    in.uv_count = 50;
    in.face_uvs = face_uvs;
    return in;
}

static inline void
assert_near(double a, double b, double allowed)
{
    if (!(fabs(a - b) <= allowed))
        fail_msg("%.9g and %.9g differ by more than %g", a, b, allowed);
}

#endif

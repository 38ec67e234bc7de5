/* grid.h -- a flat rectangle of quads and a made-up picture, for tests of what
 * happens between patches without the subdivision that makes surfaces. */
#ifndef OTX_TESTS_GRID_H
#define OTX_TESTS_GRID_H

#include "support.h"

#include "base/random.h"
#include "exemplar/exemplar.h"
#include "mapping/mapping.h"
#include "surface/surface.h"

/* The corners and sides of face (x, y), counter-clockwise. */
static inline void
test_grid_face(
    int32_t nx, int32_t ny, int32_t f, int32_t corner[4], int32_t edge[4])
{
    const int32_t row = nx + 1, across = nx * (ny + 1);
    const int32_t v = f / nx * row + f % nx;
    const int32_t corners[4] = {v, v + 1, v + row + 1, v + row};
    const int32_t edges[4] = {f, across + v + 1, f + nx, across + v};

    memcpy(corner, corners, sizeof corners);
    memcpy(edge, edges, sizeof edges);
}

/* The ends of all edges: those along x first. */
static inline void
test_grid_edges(int32_t nx, int32_t ny, int32_t *edge_verts)
{
    const int32_t row = nx + 1, across = nx * (ny + 1);

    for (int32_t e = 0; e < across + ny * row; ++e)
    {
        const bool flat = e < across;
        const int32_t x = flat ? e % nx : (e - across) % row;
        const int32_t y = flat ? e / nx : (e - across) / row;

        edge_verts[2 * e] = y * row + x;
        edge_verts[2 * e + 1] = y * row + x + (flat ? 1 : row);
    }
}

/* nx * ny squares of side `step` in the plane z = 0, face (x, y) at
 * y * nx + x, its corner 0 at its lower left, counter-clockwise. */
static inline otx_surface *
test_grid_create(otx_arena *arena, int32_t nx, int32_t ny, double step)
{
    const int32_t faces = nx * ny, row = nx + 1, verts = row * (ny + 1);
    const int32_t across = nx * (ny + 1), edges = across + ny * row;
    float *points = OTX_ZNEW(arena, float, 3 * verts);
    int32_t *face_first = OTX_NEW(arena, int32_t, faces + 1);
    int32_t *face_verts = OTX_NEW(arena, int32_t, 4 * faces);
    int32_t *face_edges = OTX_NEW(arena, int32_t, 4 * faces);
    int32_t *edge_verts = OTX_NEW(arena, int32_t, 2 * edges);
    int32_t *edge_faces = memset(
        OTX_NEW(arena, int32_t, 2 * edges), -1,
        2 * (size_t)edges * sizeof(int32_t));
    otx_level *level = OTX_ZNEW(arena, otx_level, 1);
    otx_surface *surface = OTX_NEW(arena, otx_surface, 1);

    for (int32_t v = 0; v < verts; ++v)
    {
        points[3 * v] = (float)(step * (v % row));
        points[3 * v + 1] = (float)(step * (v / row));
    }
    test_grid_edges(nx, ny, edge_verts);
    for (int32_t f = 0; f < faces; ++f)
    {
        int32_t corner[4], edge[4];

        test_grid_face(nx, ny, f, corner, edge);
        face_first[f] = 4 * f;
        for (int k = 0; k < 4; ++k)
        {
            face_verts[4 * f + k] = corner[k];
            face_edges[4 * f + k] = edge[k];
            edge_faces[2 * edge[k] + (edge_faces[2 * edge[k]] >= 0)] = f;
        }
    }
    face_first[faces] = 4 * faces;
    *level = (otx_level){
        .face_count = faces,
        .vert_count = verts,
        .edge_count = edges,
        .corner_count = 4 * faces,
        .face_first = face_first,
        .face_verts = face_verts,
        .face_edges = face_edges,
        .edge_verts = edge_verts,
        .edge_faces = edge_faces,
        .face_hole = OTX_ZNEW(arena, uint8_t, faces),
        .face_cage = OTX_ZNEW(arena, int32_t, faces),
    };
    *surface = (otx_surface){
        .level_count = 1,
        .levels = level,
        .points = points,
        .area = faces * step * step,
        .mean_edge_length = step};
    return surface;
}

/* A picture of independent colours in [0, 100], the same in every space. */
static inline otx_exemplar *
test_exemplar_create(
    otx_arena *arena, int32_t width, int32_t height, bool wrap, uint64_t seed)
{
    otx_exemplar *exemplar = OTX_ZNEW(arena, otx_exemplar, 1);
    const int32_t count = 3 * width * height;
    otx_image image = {
        .width = width,
        .height = height,
        .channels = 3,
        .pixels = OTX_NEW(arena, float, count)};

    for (int32_t i = 0; i < count; ++i)
        image.pixels[i] =
            (float)(100.0 * otx_random_unit(seed, 0, (uint64_t)i));
    exemplar->linear = exemplar->match = exemplar->lab = image;
    exemplar->wrap_x = exemplar->wrap_y = wrap;
    /* Three channels, uniform: variance 100^2 / 12 each, twice for a pair. */
    exemplar->match_sigma = exemplar->lab_sigma = 100.0 / sqrt(2.0);
    exemplar->match_step = exemplar->lab_step = 100.0 / sqrt(2.0);
    return exemplar;
}

/* One patch that lays the grid flat: UV = points * texels + shift texels. */
static inline otx_mapping *
test_mapping_create(
    otx_arena *arena, const otx_surface *surface, const otx_exemplar *exemplar,
    double texels, double shift)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = OTX_ZNEW(arena, otx_mapping, 1);

    mapping->surface = surface;
    mapping->scale = exemplar->match.width / texels;
    mapping->uvs = OTX_NEW(arena, float, 2 * leaf->corner_count);
    mapping->face_patch = OTX_ZNEW(arena, int32_t, leaf->face_count);
    mapping->patch_count = 1;
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p = otx_vec3_load(surface->points, leaf->face_verts[c]);

        mapping->uvs[2 * c] =
            (float)((texels * p.x + shift) / exemplar->match.width);
        mapping->uvs[2 * c + 1] =
            (float)((texels * p.y + shift) / exemplar->match.height);
    }
    return mapping;
}

#endif

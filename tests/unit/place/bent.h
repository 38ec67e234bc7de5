/* bent.h -- a grid rolled up, or drawn over a ball: surfaces of which it is
 * known how they can be laid flat. */
#ifndef OTX_TESTS_BENT_H
#define OTX_TESTS_BENT_H

#include "grid.h"

#include "place/footprint.h"
#include "surface/cage.h"

enum
{
    BENT_FACES = 24 /* along a side */
};

/* A square of side 1; rolled about an axis along y where `radius` is positive,
 * and where `ball` says so, about both. */
static inline otx_surface *
bent_create(otx_arena *arena, double radius, bool ball)
{
    otx_surface *surface =
        test_grid_create(arena, BENT_FACES, BENT_FACES, 1.0 / BENT_FACES);
    otx_cage *cage = OTX_ZNEW(arena, otx_cage, 1);
    float *points = (float *)(uintptr_t)surface->points;

    cage->face_count = BENT_FACES * BENT_FACES;
    surface->cage = cage;
    for (int32_t v = 0; radius > 0.0 && v < surface->levels->vert_count; ++v)
    {
        const double a = ((double)points[3 * v] - 0.5) / radius;
        const double b = ((double)points[3 * v + 1] - 0.5) / radius;
        const double around = ball ? radius * cos(b) : radius;

        points[3 * v] = (float)(around * sin(a));
        points[3 * v + 1] = (float)(ball ? radius * sin(b) : radius * b);
        points[3 * v + 2] = (float)(around * cos(a) - radius);
    }
    return surface;
}

static inline otx_footprint_space
bent_space(otx_arena *arena, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_footprint_space space = {
        OTX_NEW(arena, int32_t, leaf->face_count),
        OTX_NEW(arena, int32_t, leaf->vert_count)};

    for (int32_t f = 0; f < leaf->face_count; ++f)
        space.face_slot[f] = -1;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        space.vert_slot[v] = -1;
    return space;
}

/* A picture as wide as it is high, its middle at a point. */
static inline otx_footprint_ask
bent_ask(const otx_surface *surface, otx_vec3 point, double width)
{
    return (otx_footprint_ask){
        .surface = surface,
        .spot = otx_spot_nearest(surface, point),
        .up = {0, 1, 0},
        .width = width,
        .box = {{-0.5, -0.5}, {0.5, 0.5}}};
}

#endif

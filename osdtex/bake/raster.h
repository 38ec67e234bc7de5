/* raster.h -- which facet is at which sample of a block of texels. */
#ifndef OTX_BAKE_RASTER_H
#define OTX_BAKE_RASTER_H

#include "base/arena.h"
#include "math/vec.h"

/* A block of width x height texels whose lower left corner is at `origin`, in
 * texels of its level. Samples are the centres of n x n parts of a texel;
 * sample (i, j) is at j * width * n + i. */
typedef struct otx_raster
{
    otx_vec2 origin;
    int32_t width, height;
    int32_t n;
    int64_t *facets; /* [samples], -1 none */
} otx_raster;

/* The edge nearest to each texel of a block, of those within a distance. */
typedef struct otx_raster_near
{
    int32_t *edges;  /* [texels], -1 none */
    float *distance; /* [texels] squared, texels; where there is one */
} otx_raster_near;

/* An empty block. False when memory is out. */
bool otx_raster_begin(otx_arena *arena, otx_raster *raster);

/* Puts `id` at the samples in a triangle that have none yet: of several facets
 * the first drawn holds, so that shared edges belong to one.
 *
 *   p  corners in texels of the level, any winding */
void otx_raster_triangle(otx_raster *raster, const otx_vec2 p[3], int64_t id);

/* No edge near any texel. False when memory is out. */
bool otx_raster_near_begin(
    otx_arena *arena, const otx_raster *raster, otx_raster_near *near);

/* Offers the edge from p[0] to p[1] as the nearest to the texels whose centre
 * is within `radius` texels of it. Of equally near ones the first holds. */
void otx_raster_edge(
    const otx_raster *raster, const otx_vec2 p[2], double radius, int32_t edge,
    otx_raster_near *near);

/* The point of the segment a b nearest to p, as a fraction of the way. */
double otx_raster_nearest(otx_vec2 a, otx_vec2 b, otx_vec2 p);

static inline otx_vec2
otx_raster_texel(const otx_raster *raster, int32_t x, int32_t y)
{
    return (otx_vec2){raster->origin.x + x + 0.5, raster->origin.y + y + 0.5};
}

#endif

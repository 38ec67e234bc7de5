/* tile_maps.h -- the other maps of a material, laid as its colours were.
 *
 * A picture of tiles is a picture of texel numbers, which do not say how a
 * piece was turned. Its neighbours do: beside a texel lies, but for cuts, the
 * one that lies beside it in the exemplar, on the side that the turn puts it.
 * Normals are turned by that, and maps that are larger than the colour have
 * their texels turned within its. */
#ifndef OTX_TILING_TILE_MAPS_H
#define OTX_TILING_TILE_MAPS_H

#include "quilt/texel_pool.h"

/* Where a texel of the tiles takes what it shows. */
typedef struct otx_tile_place
{
    otx_vec2 at;   /* its middle in the exemplar, texels */
    otx_vec2 turn; /* a step to the right is this one there */
} otx_tile_place;

/* False where there is no texel. Where cuts leave no neighbour to ask, the
 * texels around decide, else it is upright. */
bool otx_tile_maps_place(
    const otx_texel_pool *pool, const otx_texel_map *texels, int32_t x,
    int32_t y, otx_tile_place *out);

/* The exemplar's maps laid so, in run->arena; neutral where there is no texel.
 * LIMIT, MEMORY. */
otx_status otx_tile_maps_make(
    otx_run *run, const otx_texel_pool *pool, const otx_texel_map *texels,
    otx_companions *out);

#endif

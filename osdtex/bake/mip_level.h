/* mip_level.h -- one level of one UDIM tile, cut into blocks.
 *
 * Each level of the mip map is baked by itself, from the surface, with the
 * footprint of its own texels: nothing is averaged over the picture, where
 * texels side by side may come from opposite ends of the model. */
#ifndef OTX_BAKE_MIP_LEVEL_H
#define OTX_BAKE_MIP_LEVEL_H

#include "bake/bin.h"
#include "bake/layout.h"
#include "image/udim.h"
#include "math/vec.h"

enum
{
    OTX_MIP_BLOCK = 64, /* texels, that of the files */
    OTX_MIP_APRON = 2   /* texels around a block that are looked at, too */
};

/* An edge that the texture ends at, or where patches meet. */
typedef struct otx_mip_rim
{
    int32_t face;
    int32_t edge; /* of the face */
} otx_mip_rim;

typedef struct otx_mip
{
    const otx_layout *layout;
    int32_t tile; /* index into the layout's tiles */
    int32_t level;
    int32_t side;    /* texels of the level */
    int32_t columns; /* blocks a row, and rows */
    int32_t gutter;  /* texels that are continued beyond rims */
    const otx_mip_rim *rims;
    int32_t rim_count;
    const otx_mip_rim *seams; /* where patches meet; none: not blended */
    int32_t seam_count;
    double blend;           /* texels to either side of a seam */
    otx_bin faces;          /* items: index into the tile's faces */
    otx_bin near_rims;      /* items: index into rims, gutter included */
    otx_bin near_seams;     /* items: index into seams, blend included */
    const int32_t *far_rim; /* [columns * columns] a rim not far from there */
} otx_mip;

/* Lists the rims of a tile: [*count] in `arena`. MEMORY. */
otx_status otx_mip_find_rims(
    otx_run *run, otx_arena *arena, const otx_layout *layout, int32_t tile,
    const otx_mip_rim **rims, int32_t *count);

/* Lists the edges of a tile's faces across which the patch is another. */
otx_status otx_mip_find_seams(
    otx_run *run, otx_arena *arena, const otx_layout *layout,
    const int32_t *face_patch, int32_t tile, const otx_mip_rim **seams,
    int32_t *count);

/* Fills all from `layout`, `tile`, `level`, the rims, the seams and the blend
 * of `mip` on, in `arena`. Rows of blocks count from the TOP, as in files.
 * MEMORY. */
otx_status otx_mip_build(otx_run *run, otx_arena *arena, otx_mip *mip);

/* Whether the patch across an edge is another. */
bool otx_mip_is_seam(
    const otx_layout *layout, const int32_t *face_patch,
    const otx_mip_rim *edge);

/* Size of a block, which is smaller at the right and lower rim. */
static inline int32_t
otx_mip_block_size(const otx_mip *mip, int32_t x)
{
    const int32_t left = mip->side - x * OTX_MIP_BLOCK;

    return left < OTX_MIP_BLOCK ? left : OTX_MIP_BLOCK;
}

/* A corner of a leaf face, in texels of the mip level. */
static inline otx_vec2
otx_mip_texel(const otx_mip *mip, int32_t corner)
{
    const float *uv = mip->layout->leaf_uvs + 2 * (size_t)corner;
    const int32_t number = mip->layout->tiles[mip->tile];

    return (otx_vec2){
        ((double)uv[0] - otx_udim_column(number)) * mip->side,
        ((double)uv[1] - otx_udim_row(number)) * mip->side};
}

/* The ends of an edge, in texels of the mip level. */
static inline void
otx_mip_ends(const otx_mip *mip, const otx_mip_rim *rim, otx_vec2 ends[2])
{
    const otx_level *leaf = otx_surface_leaf(mip->layout->surface);
    const int32_t first = leaf->face_first[rim->face];
    const int32_t size = otx_level_face_size(leaf, rim->face);

    ends[0] = otx_mip_texel(mip, first + rim->edge);
    ends[1] =
        otx_mip_texel(mip, first + (rim->edge + 1 == size ? 0 : rim->edge + 1));
}

#endif

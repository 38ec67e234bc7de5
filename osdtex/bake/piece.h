/* piece.h -- a facet on a page: everything on it is affine. */
#ifndef OTX_BAKE_PIECE_H
#define OTX_BAKE_PIECE_H

#include "bake/page.h"
#include "bake/texel_source.h"
#include "bake/walk.h"

typedef struct otx_piece
{
    int64_t id; /* -1 none */
    int32_t chart;
    const otx_texture *texture;
    otx_facet facet;
    double at[3], dx[3], dy[3]; /* barycentric: at texel (0, 0), and changes */
    otx_vec2 uv, uv_dx, uv_dy;  /* likewise, in the exemplar */
    otx_texture_probes probes;  /* of a sample */
    bool is_plain; /* a whole texel is no larger than one of the exemplar */
} otx_piece;

/* Facet `index` of a leaf face, as one number. */
static inline int64_t
otx_piece_id(int32_t face, int32_t index)
{
    return (int64_t)face << 16 | index;
}

static inline int32_t
otx_piece_face(int64_t id)
{
    return (int32_t)(id >> 16);
}

/* `share`: of a texel's side, that a sample has. */
otx_piece otx_piece_make(
    const otx_texel_source *source, const otx_page *page, double share,
    int64_t id);

/* The exemplar's UV at corners of a facet, weighted by barycentric coordinates
 * or their changes. */
static inline otx_vec2
otx_piece_mix(
    const otx_mapping *mapping, const otx_facet *facet, const double w[3])
{
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = mapping->uvs + 2 * (size_t)facet->corners[k];

        sum = otx_vec2_add(sum, otx_vec2_scale(w[k], (otx_vec2){uv[0], uv[1]}));
    }
    return sum;
}

/* The exemplar's UV at a texel position, by the plane of the piece. */
static inline otx_vec2
otx_piece_uv(const otx_piece *piece, otx_vec2 at)
{
    return (otx_vec2){
        piece->uv.x + at.x * piece->uv_dx.x + at.y * piece->uv_dy.x,
        piece->uv.y + at.x * piece->uv_dx.y + at.y * piece->uv_dy.y};
}

static inline double
otx_piece_weight(const otx_piece *piece, int k, otx_vec2 at)
{
    return piece->at[k] + at.x * piece->dx[k] + at.y * piece->dy[k];
}

static inline bool
otx_piece_contains(const otx_piece *piece, otx_vec2 at)
{
    for (int k = 0; k < 3; ++k)
        if (otx_piece_weight(piece, k, at) < 0.0)
            return false;
    return true;
}

/* The place at a texel position, inside of the piece or beyond. */
static inline otx_walk
otx_piece_place(const otx_piece *piece, otx_vec2 at)
{
    otx_walk walk = {.facet = piece->facet};

    for (int k = 0; k < 3; ++k)
    {
        walk.at[k] = otx_piece_weight(piece, k, at);
        walk.dx[k] = piece->dx[k];
        walk.dy[k] = piece->dy[k];
    }
    return walk;
}

#endif

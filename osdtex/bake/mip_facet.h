/* mip_facet.h -- a facet on a mip level: everything on it is affine. */
#ifndef OTX_BAKE_MIP_FACET_H
#define OTX_BAKE_MIP_FACET_H

#include "bake/mip_level.h"
#include "bake/texel_source.h"
#include "bake/walk.h"

/* How a facet is looked up in a picture. */
typedef struct otx_mip_lookup
{
    const otx_texture *texture; /* NULL: it is not */
    otx_texture_probes whole;   /* of a texel */
    otx_texture_probes probes;  /* of a sample */
    int32_t fineness; /* samples to a texel's side where nothing runs through */
    bool is_plain;    /* a whole texel is no larger than one of the picture */
} otx_mip_lookup;

typedef struct otx_mip_facet
{
    int64_t id; /* -1 none */
    int32_t chart;
    otx_facet facet;
    double at[3], dx[3], dy[3]; /* barycentric: at texel (0, 0), and changes */
    otx_vec2 uv, uv_dx, uv_dy;  /* likewise, in the exemplar */
    otx_mip_lookup own, maps;   /* in what is baked, and in maps besides */
    otx_carry_matrix carry;     /* of maps */
    double scale, scale_dx, scale_dy; /* local, likewise */
} otx_mip_facet;

/* Facet `index` of a leaf face, as one number. */
static inline int64_t
otx_mip_facet_id(int32_t face, int32_t index)
{
    return (int64_t)face << 16 | index;
}

static inline int32_t
otx_mip_facet_face(int64_t id)
{
    return (int32_t)(id >> 16);
}

/*   maps  looked up besides; NULL none
 *   n     samples to a texel's side */
otx_mip_facet otx_mip_facet_make(
    const otx_texel_source *source, const otx_texel_source *maps,
    const otx_mip *mip, int32_t n, int64_t id);

/* That of a place: one that a walk comes to for texel (0, 0). */
otx_mip_facet otx_mip_facet_of_walk(
    const otx_texel_source *source, const otx_texel_source *maps, int32_t n,
    const otx_walk *walk);

/* The exemplar's UV at corners of a facet, weighted by barycentric coordinates
 * or their changes. */
static inline otx_vec2
otx_mip_facet_mix(
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

/* The exemplar's UV at a texel position, by the plane of the facet. */
static inline otx_vec2
otx_mip_facet_uv(const otx_mip_facet *placed, otx_vec2 at)
{
    return (otx_vec2){
        placed->uv.x + at.x * placed->uv_dx.x + at.y * placed->uv_dy.x,
        placed->uv.y + at.x * placed->uv_dx.y + at.y * placed->uv_dy.y};
}

static inline double
otx_mip_facet_weight(const otx_mip_facet *placed, int k, otx_vec2 at)
{
    return placed->at[k] + at.x * placed->dx[k] + at.y * placed->dy[k];
}

static inline bool
otx_mip_facet_contains(const otx_mip_facet *placed, otx_vec2 at)
{
    for (int k = 0; k < 3; ++k)
        if (otx_mip_facet_weight(placed, k, at) < 0.0)
            return false;
    return true;
}

/* The place at a texel position, inside of the facet or beyond. */
static inline otx_walk
otx_mip_facet_place(const otx_mip_facet *placed, otx_vec2 at)
{
    otx_walk walk = {.facet = placed->facet};

    for (int k = 0; k < 3; ++k)
    {
        walk.at[k] = otx_mip_facet_weight(placed, k, at);
        walk.dx[k] = placed->dx[k];
        walk.dy[k] = placed->dy[k];
    }
    return walk;
}

#endif

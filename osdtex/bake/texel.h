/* texel.h -- what a texel of a baked texture shows. */
#ifndef OTX_BAKE_TEXEL_H
#define OTX_BAKE_TEXEL_H

#include "bake/page.h"
#include "bake/raster.h"
#include "bake/walk.h"
#include "image/exemplar.h"
#include "image/texture.h"

/* What is baked. All but the colour are numbers at the texel's centre, which
 * are not averaged, in 32-bit floats. */
typedef enum otx_texel_kind
{
    OTX_TEXEL_COLOR,
    OTX_TEXEL_PATCH,   /* (patch, face of the cage, on the surface) */
    OTX_TEXEL_UV,      /* (u, v, on the surface) in the exemplar */
    OTX_TEXEL_STRETCH, /* (L2 stretch, larger / smaller, on the surface) */
    OTX_TEXEL_SEAM,    /* (patches meet in or beside it, 0, on the surface) */
    OTX_TEXEL_KIND_COUNT
} otx_texel_kind;

/* What all texels share. */
typedef struct otx_texel_source
{
    const otx_mapping *mapping;
    const otx_layout *layout;
    const otx_exemplar *exemplars;
    otx_texture textures[OTX_EXEMPLARS_MAX]; /* their linear pixels */
    otx_texel_kind kind;
    int32_t channels; /* of what is baked */
    /* Of colours: the exemplar's range, which no texel leaves. */
    float low[OTX_IMAGE_MAX_CHANNELS], high[OTX_IMAGE_MAX_CHANNELS];
} otx_texel_source;

/* A facet on a page: everything on it is affine. */
typedef struct otx_texel_piece
{
    int64_t id; /* -1 none */
    int32_t chart;
    const otx_texture *texture;
    otx_facet facet;
    double at[3], dx[3], dy[3]; /* barycentric: at texel (0, 0), and changes */
    otx_vec2 uv, uv_dx, uv_dy;  /* likewise, in the exemplar */
    otx_texture_probes probes;  /* of a sample */
    bool is_plain; /* a whole texel is no larger than one of the exemplar */
} otx_texel_piece;

/* Samples to a texel's side: a coarse texel sees more faces. */
int32_t otx_texel_samples(const otx_texel_source *source, int32_t level);

/* Bakes one block into pixels[height * width * channels], bottom row first.
 *
 *   x, y      of the block; rows count from the top
 *   overlaps  added to: samples that several faces claim
 *
 * False when memory is out. */
bool otx_texel_block(
    const otx_texel_source *source, const otx_page *page, int32_t x, int32_t y,
    otx_arena *scratch, float *pixels, int64_t *overlaps);

/* Size of a block, which is smaller at the right and lower rim. */
static inline int32_t
otx_texel_block_width(const otx_page *page, int32_t x)
{
    const int32_t left = page->side - x * OTX_PAGE_BLOCK;

    return left < OTX_PAGE_BLOCK ? left : OTX_PAGE_BLOCK;
}

#endif

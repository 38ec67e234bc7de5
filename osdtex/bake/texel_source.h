/* texel_source.h -- what is baked, and from what. */
#ifndef OTX_BAKE_TEXEL_SOURCE_H
#define OTX_BAKE_TEXEL_SOURCE_H

#include "bake/layout.h"
#include "exemplar/exemplar.h"
#include "image/texture.h"
#include "mapping/show.h"

/* All but the colour are numbers at the texel's centre, which are not averaged,
 * in 32-bit floats. */
typedef enum otx_texel_kind
{
    OTX_TEXEL_COLOR,
    OTX_TEXEL_PATCH,   /* (patch, face of the cage, on the surface) */
    OTX_TEXEL_UV,      /* (u, v, on the surface) in the exemplar */
    OTX_TEXEL_STRETCH, /* (L2 stretch, larger / smaller, on the surface) */
    OTX_TEXEL_SEAM,    /* (patches meet in or beside it, 0, on the surface) */
    OTX_TEXEL_SOURCE,  /* (exemplar, u, v, footprint): what is looked up */
    OTX_TEXEL_SLICE,   /* (along the axis of a stack, 0, on the surface) */
    OTX_TEXEL_KIND_COUNT,
    /* No file of their own: what else is known of the materials, baked together
     * with the colour and like it. */
    OTX_TEXEL_MAPS = OTX_TEXEL_KIND_COUNT
} otx_texel_kind;

/* Whether a texel is the mean of what its samples show. */
static inline bool
otx_texel_is_filtered(otx_texel_kind kind)
{
    return kind == OTX_TEXEL_COLOR || kind == OTX_TEXEL_MAPS;
}

/* What all texels share. */
typedef struct otx_texel_source
{
    const otx_mapping *mapping;
    otx_show_view show; /* the mapping, as it is asked */
    const otx_layout *layout;
    const otx_exemplar *exemplars;
    otx_texture textures[OTX_EXEMPLARS_MAX]; /* their linear pixels, or maps */
    otx_texel_kind kind;
    int32_t channels; /* of what is baked */
    /* Of colours: the exemplar's range, which no texel leaves. */
    float low[OTX_IMAGE_MAX_CHANNELS], high[OTX_IMAGE_MAX_CHANNELS];
} otx_texel_source;

/* The texture that a leaf face is looked up in. */
static inline const otx_texture *
otx_texel_texture(const otx_texel_source *source, int32_t face)
{
    return &source->textures[otx_source_of(source->mapping, face)];
}

#endif

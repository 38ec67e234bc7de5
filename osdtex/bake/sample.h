/* sample.h -- colours of samples, each filtered over its share of a texel. */
#ifndef OTX_BAKE_SAMPLE_H
#define OTX_BAKE_SAMPLE_H

#include "bake/mixture.h"
#include "bake/piece.h"

/* A lookup with all channels that are baked: a picture without alpha is opaque
 * beside one that has it. */
static inline void
otx_sample_probe(
    const otx_texel_source *source, const otx_texture *texture,
    const otx_texture_probes *probes, otx_vec2 uv, float *color)
{
    otx_texture_probe(texture, probes, uv, color);
    if (texture->pyramid.levels[0].channels < source->channels)
        color[3] = 1.0f;
}

/* At a texel position on a piece that was made with this share. */
static inline void
otx_sample_on_piece(
    const otx_texel_source *source, const otx_piece *piece, double share,
    otx_vec2 at, float *color)
{
    if (otx_mixture_has(source->mapping, piece->facet.face))
    {
        const otx_walk walk = otx_piece_place(piece, at);

        otx_mixture_color(source, piece->texture, &walk, share, color);
        return;
    }
    otx_sample_probe(
        source, piece->texture, &piece->probes, otx_piece_uv(piece, at), color);
}

/* At a place that a walk came to. */
void otx_sample_at(
    const otx_texel_source *source, const otx_walk *walk, double share,
    float *color);

#endif

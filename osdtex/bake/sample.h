/* sample.h -- colours of samples, each filtered over its share of a texel. */
#ifndef OTX_BAKE_SAMPLE_H
#define OTX_BAKE_SAMPLE_H

#include "bake/mip_facet.h"

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

/* At a place that a walk came to. */
void otx_sample_at(
    const otx_texel_source *source, const otx_walk *walk, double share,
    float *color);

/* At a texel position on a facet that was made with this share. Of a face with
 * one lookup the probes are the same all over the facet. */
static inline void
otx_sample_on_piece(
    const otx_texel_source *source, const otx_mip_facet *placed, double share,
    otx_vec2 at, float *color)
{
    if (otx_show_is_layered(&source->show, placed->facet.face))
    {
        const otx_walk walk = otx_mip_facet_place(placed, at);

        otx_sample_at(source, &walk, share, color);
        return;
    }
    otx_sample_probe(
        source, placed->texture, &placed->probes, otx_mip_facet_uv(placed, at),
        color);
    if (source->show.carry)
        otx_carry_values(
            source->show.carry, &placed->carry,
            placed->scale + at.x * placed->scale_dx + at.y * placed->scale_dy,
            otx_source_of(source->mapping, placed->facet.face), color);
}

#endif

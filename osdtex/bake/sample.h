/* sample.h -- what samples show, each filtered over its share of a texel. */
#ifndef OTX_BAKE_SAMPLE_H
#define OTX_BAKE_SAMPLE_H

#include "bake/block.h"

enum
{
    OTX_SAMPLE_CHANNELS = 2 * OTX_IMAGE_MAX_CHANNELS /* of a block, at most */
};

/* What a source shows at a place that a walk came to. */
void otx_sample_at(
    const otx_texel_source *source, const otx_walk *walk, double share,
    float *color);

/* The same of all that a block shows. */
static inline void
otx_sample_walk(
    const otx_block *block, const otx_walk *walk, double share, float *out)
{
    otx_sample_at(block->source, walk, share, out);
    if (block->maps)
        otx_sample_at(block->maps, walk, share, out + block->source->channels);
}

/* What a source shows at a texel position on a facet. Of a face with one lookup
 * the probes are the same all over the facet.
 *
 *   lookup  the facet's, in the source
 *   probes  the lookup's, of a sample or of a texel
 *   share   of a texel's side, that they are about */
static inline void
otx_sample_on_piece(
    const otx_texel_source *source, const otx_mip_facet *placed,
    const otx_mip_lookup *lookup, const otx_texture_probes *probes,
    double share, otx_vec2 at, float *color)
{
    if (otx_show_is_layered(&source->show, placed->facet.face))
    {
        const otx_walk walk = otx_mip_facet_place(placed, at);

        otx_sample_at(source, &walk, share, color);
        return;
    }
    otx_texture_probe(
        lookup->texture, probes, otx_mip_facet_uv(placed, at), color);
    /* All channels that are baked: a picture without alpha is opaque beside one
     * that has it. */
    if (lookup->texture->pyramid.levels[0].channels < source->channels)
        color[3] = 1.0f;
    if (source->show.carry)
        otx_carry_values(
            source->show.carry, &placed->carry,
            placed->scale + at.x * placed->scale_dx + at.y * placed->scale_dy,
            otx_source_of(source->mapping, placed->facet.face), color);
}

/* All that a block shows in a texel at a position on a facet. */
static inline void
otx_sample_texel(
    const otx_block *block, const otx_mip_facet *placed, otx_vec2 at,
    float *out)
{
    otx_sample_on_piece(
        block->source, placed, &placed->own, &placed->own.whole, 1.0, at, out);
    if (block->maps)
        otx_sample_on_piece(
            block->maps, placed, &placed->maps, &placed->maps.whole, 1.0, at,
            out + block->source->channels);
}

#endif

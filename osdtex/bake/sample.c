/* sample.c -- colours of samples, each filtered over its share of a texel. */
#include "bake/sample.h"

void
otx_sample_at(
    const otx_texel_source *source, const otx_walk *walk, double share,
    float *color)
{
    const otx_mapping *mapping = source->mapping;
    const otx_facet *facet = &walk->facet;
    const otx_texture *texture = otx_texel_texture(source, facet->face);

    if (otx_mixture_has(mapping, facet->face))
    {
        otx_mixture_color(source, texture, walk, share, color);
        return;
    }

    const otx_texture_probes probes = otx_texture_measure(
        texture,
        otx_vec2_scale(share, otx_mip_facet_mix(mapping, facet, walk->dx)),
        otx_vec2_scale(share, otx_mip_facet_mix(mapping, facet, walk->dy)));

    otx_sample_probe(
        source, texture, &probes, otx_mip_facet_mix(mapping, facet, walk->at),
        color);
}

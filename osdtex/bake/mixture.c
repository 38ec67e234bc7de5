/* mixture.c -- colours of faces that take the mean of several lookups. */
#include "bake/mixture.h"

#include <string.h>

/* A lookup's corners, weighted by barycentric coordinates or their changes. */
static otx_vec2
mix(const otx_lookup *corner[3], const double w[3])
{
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
        sum = otx_vec2_add(
            sum, otx_vec2_scale(
                     w[k], (otx_vec2){corner[k]->uv[0], corner[k]->uv[1]}));
    return sum;
}

/* Beyond the facet's sides weights do not become negative. */
static double
weight_at(const otx_lookup *corner[3], const double at[3])
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
        sum += at[k] * corner[k]->weight;
    return sum > 0.0 ? sum : 0.0;
}

void
otx_mixture_color(
    const otx_texel_source *source, const otx_texture *texture,
    const otx_walk *walk, double share, float *color)
{
    const otx_lookups *l = source->mapping->lookups;
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    const int32_t face = walk->facet.face;
    const int32_t given = texture->pyramid.levels[0].channels;
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0}, weights = 0.0;

    for (const otx_lookup *lookup = l->items + l->first[face];
         lookup < l->items + l->first[face + 1];
         lookup += otx_level_face_size(leaf, face))
    {
        const otx_lookup *corner[3];
        otx_texture_probes probes;
        double weight;

        for (int k = 0; k < 3; ++k)
            corner[k] =
                lookup + (walk->facet.corners[k] - leaf->face_first[face]);
        weight = weight_at(corner, walk->at);
        if (!(weight > 0.0))
            continue;
        probes = otx_texture_measure(
            texture, otx_vec2_scale(share, mix(corner, walk->dx)),
            otx_vec2_scale(share, mix(corner, walk->dy)));
        otx_texture_probe(texture, &probes, mix(corner, walk->at), color);
        weights += weight;
        for (int32_t c = 0; c < given; ++c)
            sum[c] += weight * color[c];
    }
    /* Opaque, where only another exemplar has alpha. */
    for (int32_t c = 0; c < source->channels; ++c)
        color[c] = c < given ? (float)(sum[c] / weights) : 1.0f;
}

/* mixture.h -- colours of faces that take the mean of several lookups. */
#ifndef OTX_BAKE_MIXTURE_H
#define OTX_BAKE_MIXTURE_H

#include "bake/texel_source.h"
#include "bake/walk.h"

static inline bool
otx_mixture_has(const otx_mapping *mapping, int32_t face)
{
    const otx_lookups *l = mapping->lookups;

    return l && l->first[face + 1] > l->first[face];
}

/* Color around a place of such a face: the mean of its lookups, each filtered
 * over `share` of a texel. */
void otx_mixture_color(
    const otx_texel_source *source, const otx_texture *texture,
    const otx_walk *walk, double share, float *color);

#endif

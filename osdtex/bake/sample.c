/* sample.c -- what samples show, each filtered over its share of a texel. */
#include "bake/sample.h"

void
otx_sample_at(
    const otx_texel_source *source, const otx_walk *walk, double share,
    float *color)
{
    const otx_show_place place = {
        walk->facet.face, walk->facet.corners, walk->at, walk->dx, walk->dy};

    otx_show_color(
        &source->show, source->textures, &place,
        otx_source_of(source->mapping, walk->facet.face), share,
        source->channels, color);
}

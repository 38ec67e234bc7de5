/* map_source.c -- what is looked up of maps, as what a bake evaluates. */
#include "bake/map_source.h"

#include "mapping/map_textures.h"

#include <string.h>

otx_status
otx_map_source_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, bool y_down, otx_map_source *out)
{
    otx_texel_source *texels = &out->texels;
    otx_map_textures maps;

    OTX_TRY(otx_map_textures_create(run, mapping, exemplars, &maps));
    *out = (otx_map_source){.y_down = y_down, .carry = maps.carry};
    memcpy(out->first, maps.first, sizeof out->first);
    *texels = (otx_texel_source){
        .mapping = mapping,
        .show = otx_show_of(mapping),
        .layout = layout,
        .exemplars = exemplars,
        .kind = OTX_TEXEL_MAPS,
        .channels = maps.channels};
    memcpy(texels->textures, maps.textures, sizeof texels->textures);
    if (maps.channels > 0)
        texels->show.carry = &out->carry;
    return OSDTEX_OK;
}

void
otx_map_source_encode(const otx_map_source *source, float *values)
{
    float *n = values + source->first[OTX_COMPANION_NORMAL];

    if (source->first[OTX_COMPANION_NORMAL] < 0)
        return;
    if (source->y_down)
        n[1] = -n[1];
    otx_companion_encode_normal(n);
}

/* map_source.c -- what is looked up of maps, as what a bake evaluates. */
#include "bake/map_source.h"

#include "mapping/source.h"

#include <string.h>

/* One channel of a picture. */
static otx_status
part(otx_run *run, const otx_image *all, int32_t channel, otx_image *out)
{
    const size_t texels = (size_t)all->width * (size_t)all->height;

    OTX_TRY(otx_image_create(run, run->arena, all->width, all->height, 1, out));
    for (size_t i = 0; i < texels; ++i)
        out->pixels[i] =
            all->pixels[i * (size_t)all->channels + (size_t)channel];
    return OSDTEX_OK;
}

static otx_status
part_slices(
    otx_run *run, const otx_texture *from, int32_t channel, otx_texture *out)
{
    otx_image *images = OTX_NEW(run->arena, otx_image, from->slice_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < from->slice_count; ++i)
        OTX_TRY(
            part(run, &from->slices[i].pyramid.levels[0], channel, &images[i]));
    return otx_texture_add_slices(
        run, run->arena, images, from->slice_count, out);
}

/* One channel of the maps of each exemplar. */
static otx_status
part_heights(
    otx_run *run, const otx_map_textures *maps, int32_t count,
    otx_map_source *out)
{
    const int32_t channel = maps->first[OTX_COMPANION_HEIGHT];

    out->height_carry = maps->carry;
    out->height_carry.normal = -1;
    out->height_carry.height = 0;
    for (int32_t k = 0; channel >= 0 && k < count; ++k)
    {
        const otx_texture *from = &maps->textures[k];
        otx_image image;

        OTX_TRY(part(run, &from->pyramid.levels[0], channel, &image));
        OTX_TRY(otx_texture_create(
            run, run->arena, &image, from->wrap_x, from->wrap_y,
            &out->heights[k]));
        if (from->slice_count > 0)
            OTX_TRY(part_slices(run, from, channel, &out->heights[k]));
    }
    return OSDTEX_OK;
}

otx_status
otx_map_source_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, uint32_t kinds, bool y_down, otx_map_source *out)
{
    otx_texel_source *texels = &out->texels;
    otx_map_textures maps;

    OTX_TRY(otx_map_textures_create(run, mapping, exemplars, kinds, &maps));
    *out = (otx_map_source){.y_down = y_down, .carry = maps.carry};
    memcpy(out->first, maps.first, sizeof out->first);
    *texels = (otx_texel_source){
        .mapping = mapping,
        .show = otx_show_of(mapping),
        .layout = layout,
        .exemplars = exemplars,
        .kind = OTX_TEXEL_MAPS,
        .channels = maps.channels};
    for (int32_t k = 0; maps.channels > 0 && k < otx_source_count(mapping); ++k)
        texels->textures[k] = maps.textures[k];
    if (maps.channels > 0)
        texels->show.carry = &out->carry;
    return part_heights(run, &maps, otx_source_count(mapping), out);
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

/* map_textures.c -- one order of channels for the maps of all exemplars. */
#include "mapping/map_textures.h"

#include "mapping/source.h"

#include <string.h>

/* Which kinds there are, and where. Returns the number of channels. */
static int32_t
list_kinds(
    const otx_map_set *sets, int32_t count, uint32_t kinds,
    int32_t first[OTX_COMPANION_COUNT])
{
    int32_t channels = 0;

    for (int32_t kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        first[kind] = -1;
        for (int32_t k = 0;
             (kinds >> kind & 1u) && k < count && first[kind] < 0; ++k)
            if (sets[k].companions->maps[kind].is_there)
                first[kind] = channels;
        if (first[kind] >= 0)
            channels += otx_companion_channels((otx_companion_kind)kind);
    }
    return channels;
}

static bool
is_in_order(
    const otx_companions *companions, const int32_t first[OTX_COMPANION_COUNT])
{
    for (int32_t kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
        if (first[kind] >= 0 && (!companions->maps[kind].is_there ||
                                 companions->maps[kind].first != first[kind]))
            return false;
    return true;
}

/* The values of one texel in that order; `from` is NULL where there are none.
 */
static void
order_texel(
    const otx_companions *companions, const float *from,
    const int32_t first[OTX_COMPANION_COUNT], float *out)
{
    for (int32_t kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        const otx_companion *map = &companions->maps[kind];
        const size_t channels =
            (size_t)otx_companion_channels((otx_companion_kind)kind);

        if (first[kind] < 0)
            continue;
        if (from && map->is_there)
            memcpy(
                out + first[kind], from + map->first, channels * sizeof *out);
        else
            otx_companion_neutral((otx_companion_kind)kind, out + first[kind]);
        /* Flat is what stays where it is. */
        if (kind == OTX_COMPANION_HEIGHT && !(from && map->is_there))
            out[first[kind]] = (float)companions->height_middle;
    }
}

/* The image of an exemplar's maps with all channels that are looked up. */
static otx_status
order(
    otx_run *run, const otx_companions *companions, int32_t channels,
    const int32_t first[OTX_COMPANION_COUNT], otx_image *out)
{
    const otx_image *from = &companions->image;
    const bool is_there = otx_companions_are_there(companions);
    const int32_t width = is_there ? from->width : 1;
    const int32_t height = is_there ? from->height : 1;
    const size_t count = (size_t)width * (size_t)height;

    if (is_there && from->channels == channels &&
        is_in_order(companions, first))
    {
        *out = *from;
        return OSDTEX_OK;
    }
    OTX_TRY(otx_image_create(run, run->arena, width, height, channels, out));
    for (size_t i = 0; i < count; ++i)
        order_texel(
            companions,
            is_there ? from->pixels + i * (size_t)from->channels : NULL, first,
            out->pixels + i * (size_t)channels);
    return OSDTEX_OK;
}

static otx_status
set_carry(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_map_textures *out)
{
    otx_carry *carry = &out->carry;

    carry->surface = mapping->surface;
    carry->normal = out->first[OTX_COMPANION_NORMAL];
    carry->height = out->first[OTX_COMPANION_HEIGHT];
    for (int32_t k = 0; k < otx_source_count(mapping); ++k)
    {
        carry->units[k] = otx_source_unit(mapping, exemplars, k);
        carry->heights[k] =
            otx_companions_scale(&exemplars[k].companions, carry->units[k].x);
    }
    return otx_carry_measure(run, mapping, exemplars, &carry->scale);
}

/* The slices of a stack in the same order. */
static otx_status
add_slices(
    otx_run *run, const otx_map_set *set, int32_t channels,
    const int32_t first[OTX_COMPANION_COUNT], otx_texture *texture)
{
    otx_image *images = OTX_NEW(run->arena, otx_image, set->slice_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < set->slice_count; ++i)
    {
        otx_companions slice = *set->companions;

        slice.image = set->slices[i];
        OTX_TRY(order(run, &slice, channels, first, &images[i]));
    }
    return otx_texture_add_slices(
        run, run->arena, images, set->slice_count, texture);
}

otx_status
otx_map_textures_gather(
    otx_run *run, const otx_map_set *sets, int32_t count, uint32_t kinds,
    otx_map_textures *out)
{
    otx_texture *textures = OTX_ZNEW(run->arena, otx_texture, count);

    *out = (otx_map_textures){.textures = textures};
    OTX_TRY(otx_run_ok(run));
    out->channels = list_kinds(sets, count, kinds, out->first);
    for (int32_t k = 0; out->channels > 0 && k < count; ++k)
    {
        otx_image image;

        OTX_TRY(
            order(run, sets[k].companions, out->channels, out->first, &image));
        OTX_TRY(otx_texture_create(
            run, run->arena, &image, sets[k].wrap_x, sets[k].wrap_y,
            &textures[k]));
        if (sets[k].slices)
            OTX_TRY(add_slices(
                run, &sets[k], out->channels, out->first, &textures[k]));
    }
    return OSDTEX_OK;
}

otx_status
otx_map_textures_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    uint32_t kinds, otx_map_textures *out)
{
    const int32_t count = otx_source_count(mapping);
    otx_map_set sets[OTX_EXEMPLARS_MAX];

    for (int32_t k = 0; k < count; ++k)
    {
        const otx_exemplar_slices *slices = exemplars[k].slices;

        sets[k] = (otx_map_set){
            .companions = &exemplars[k].companions,
            .wrap_x = exemplars[k].wrap_x,
            .wrap_y = exemplars[k].wrap_y,
            .slices = slices ? slices->maps : NULL,
            .slice_count = slices ? slices->count : 0};
    }
    OTX_TRY(otx_map_textures_gather(run, sets, count, kinds, out));
    return out->channels > 0 ? set_carry(run, mapping, exemplars, out)
                             : OSDTEX_OK;
}

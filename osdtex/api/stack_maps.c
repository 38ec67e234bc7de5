/* stack_maps.c -- what one picture has, all have. */
#include "api/stack_maps.h"

#include <string.h>

static const char STAGE[] = "stack";

/* The union of all, without pixels. */
static otx_companions
plan(const otx_stack_maps *sets, int32_t count)
{
    otx_companions all = {.height_middle = 0.5};

    for (int kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        const otx_companion *found = NULL;

        for (int32_t k = 0; k < count && !found; ++k)
            if (sets[k].companions->maps[kind].is_there)
                found = &sets[k].companions->maps[kind];
        if (!found)
            continue;
        all.maps[kind] = *found;
        all.maps[kind].first = all.image.channels;
        all.image.channels += otx_companion_channels((otx_companion_kind)kind);
    }
    return all;
}

/* A kind of map into its channels. */
static void
put(const otx_companions *from, otx_companion_kind kind, otx_companions *out)
{
    const otx_companion *map = &from->maps[kind];
    const size_t channels = (size_t)otx_companion_channels(kind);
    const int64_t texels = (int64_t)out->image.width * out->image.height;
    float neutral[3];

    otx_companion_neutral(kind, neutral);
    for (int64_t i = 0; i < texels; ++i)
        memcpy(
            out->image.pixels + i * out->image.channels + out->maps[kind].first,
            map->is_there
                ? from->image.pixels + i * from->image.channels + map->first
                : neutral,
            channels * sizeof *neutral);
}

static otx_status
align(
    otx_run *run, const otx_companions *all, const otx_stack_maps *set,
    int32_t width, int32_t height)
{
    const otx_companions from = *set->companions;
    otx_companions *out = set->companions;

    memcpy(out->maps, all->maps, sizeof all->maps);
    OTX_TRY(otx_image_create(
        run, run->arena, width, height, all->image.channels, &out->image));
    for (int kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        if (!all->maps[kind].is_there)
            continue;
        put(&from, (otx_companion_kind)kind, out);
        if (!from.maps[kind].is_there)
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, otx_where_file(set->path),
                "another picture of the stack has a %s map and this one has "
                "none; it is taken to be flat",
                otx_companion_name((otx_companion_kind)kind));
    }
    return OSDTEX_OK;
}

otx_status
otx_stack_maps_align(
    otx_run *run, const otx_stack_maps *sets, int32_t count, int32_t width,
    int32_t height)
{
    const otx_companions all = plan(sets, count);

    for (int32_t k = 0; k < count && all.image.channels > 0; ++k)
        OTX_TRY(align(run, &all, &sets[k], width, height));
    return OSDTEX_OK;
}

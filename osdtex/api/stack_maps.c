/* stack_maps.c -- what one picture has, all have. */
#include "api/stack_maps.h"

#include <string.h>

static const char STAGE[] = "stack";

/* The union of all, without pixels. */
static otx_companions
plan(const otx_exemplar *exemplars, int32_t count)
{
    otx_companions all = {.height_middle = 0.5};

    for (int kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        const otx_companion *found = NULL;

        for (int32_t k = 0; k < count && !found; ++k)
            if (exemplars[k].companions.maps[kind].is_there)
                found = &exemplars[k].companions.maps[kind];
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
align(otx_run *run, const otx_companions *all, otx_exemplar *e)
{
    const otx_companions from = e->companions;

    e->companions.image = (otx_image){0};
    memcpy(e->companions.maps, all->maps, sizeof all->maps);
    OTX_TRY(otx_image_create(
        run, run->arena, e->linear.width, e->linear.height, all->image.channels,
        &e->companions.image));
    for (int kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        if (!all->maps[kind].is_there)
            continue;
        put(&from, (otx_companion_kind)kind, &e->companions);
        if (!from.maps[kind].is_there)
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE,
                otx_where_file(e->source_path),
                "another picture of the stack has a %s map and this one has "
                "none; it is taken to be flat",
                otx_companion_name((otx_companion_kind)kind));
    }
    return OSDTEX_OK;
}

otx_status
otx_stack_maps_align(otx_run *run, otx_exemplar *exemplars, int32_t count)
{
    const otx_companions all = plan(exemplars, count);

    for (int32_t k = 0; k < count && all.image.channels > 0; ++k)
        OTX_TRY(align(run, &all, &exemplars[k]));
    return OSDTEX_OK;
}

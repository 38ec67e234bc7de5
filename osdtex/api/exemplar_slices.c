/* exemplar_slices.c -- one slice after the other. */
#include "api/exemplar_slices.h"

#include "api/companion_pictures.h"
#include "file/exr_slices.h"
#include "file/picture_read.h"

#include <string.h>

/* One at a time is in memory as its file has it. */
static otx_status
take_slice(
    otx_call *call, const char *path, int32_t index,
    const otx_exemplar_input *how, const otx_exemplar *like, otx_image *linear,
    otx_image *lab)
{
    char name[OTX_EXR_SLICE_NAME_BYTES];
    otx_exemplar_input input = *how;
    const otx_colour *colour;
    otx_exemplar made;
    otx_picture picture;
    otx_run aside = call->run;
    otx_status status;

    otx_exr_slice_name(index, name);
    OTX_TRY(otx_call_colour(call, &colour));
    aside.arena = otx_arena_create(call->run.allocator);
    if (!aside.arena)
        return otx_fail_memory(&call->run, "exemplar");
    status = otx_picture_read_layer(&aside, path, name, &picture);
    input.pixels = picture.image;
    if (status == OSDTEX_OK)
        status = otx_exemplar_build(&call->run, colour, &input, &made);
    otx_arena_destroy(aside.arena);
    OTX_TRY(status);
    if (made.linear.width != like->linear.width ||
        made.linear.height != like->linear.height ||
        made.linear.channels != like->linear.channels)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "exemplar", otx_where_file(path),
            "slice %s has %d x %d texels and %d channels, others have %d x %d "
            "and %d; write the stack again",
            name, made.linear.width, made.linear.height, made.linear.channels,
            like->linear.width, like->linear.height, like->linear.channels);
    *linear = made.linear;
    *lab = made.lab;
    return OSDTEX_OK;
}

void
otx_exemplar_slices_maps(const char *path, int32_t index, otx_slice_maps *out)
{
    out->count = 0;
    for (int kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        char *name = out->names[out->count];

        otx_exr_slice_map_name(
            otx_companion_name((otx_companion_kind)kind), index, name);
        if (otx_exr_part_is_there(path, name))
            out->list[out->count++] =
                (osdtex_companion){.path = path, .kind = kind, .layer = name};
    }
}

/* The maps of every slice, where those that are asked for are the file's. */
static otx_status
take_maps(
    otx_call *call, const char *path, int32_t count,
    const osdtex_exemplar_options *options, const otx_exemplar *like,
    const otx_image **out)
{
    otx_image *images = OTX_ZNEW(call->run.arena, otx_image, count);

    *out = NULL;
    OTX_TRY(otx_run_ok(&call->run));
    for (int32_t i = 0; i < options->map_count; ++i)
        if (!options->maps[i].path || strcmp(options->maps[i].path, path) != 0)
            return OSDTEX_OK;
    for (int32_t k = 0; k < count; ++k)
    {
        osdtex_exemplar_options own = *options;
        otx_companions companions = {0};
        otx_slice_maps maps;

        otx_exemplar_slices_maps(path, k, &maps);
        own.maps = maps.list;
        own.map_count = maps.count;
        OTX_TRY(otx_companion_pictures_take(call, &own, like, &companions));
        if (companions.image.width != like->companions.image.width ||
            companions.image.channels != like->companions.image.channels)
            return otx_fail(
                &call->run, OSDTEX_ERROR_FORMAT, "exemplar",
                otx_where_file(path),
                "slice %d has other maps than the one in the middle; write the "
                "stack again",
                k);
        images[k] = companions.image;
    }
    *out = images;
    return OSDTEX_OK;
}

otx_status
otx_exemplar_slices_read(
    otx_call *call, const char *path, int32_t count,
    const otx_exemplar_input *how, const osdtex_exemplar_options *options,
    const otx_exemplar *like, const otx_exemplar_slices **out)
{
    otx_run *run = &call->run;
    otx_exemplar_slices *slices = OTX_ZNEW(run->arena, otx_exemplar_slices, 1);
    otx_image *linear = OTX_ZNEW(run->arena, otx_image, count);
    otx_image *lab = OTX_ZNEW(run->arena, otx_image, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
        OTX_TRY(take_slice(call, path, k, how, like, &linear[k], &lab[k]));
    *slices =
        (otx_exemplar_slices){.count = count, .linear = linear, .lab = lab};
    if (options->map_count > 0)
        OTX_TRY(take_maps(call, path, count, options, like, &slices->maps));
    *out = slices;
    return OSDTEX_OK;
}

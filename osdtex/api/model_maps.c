/* model_maps.c -- maps beside the textures of a model that was read. */
#include "api/model_maps.h"

#include "api/companion_pictures.h"

#include <unistd.h>

static const char STAGE[] = "model";

static const char *
path_of(const otx_data_maps *paths, otx_companion_kind kind)
{
    switch (kind)
    {
    case OTX_COMPANION_NORMAL:
        return paths->normal;
    case OTX_COMPANION_ROUGHNESS:
        return paths->roughness;
    case OTX_COMPANION_HEIGHT:
        return paths->height;
    case OTX_COMPANION_METALNESS:
        return paths->metalness;
    default:
        return paths->occlusion;
    }
}

/* Reads maps without an error of the call where they do not do: the model can
 * be looked at without them. */
static otx_status
try_maps(
    otx_call *call, const osdtex_exemplar_options *options,
    const otx_exemplar *texture, otx_companions *out)
{
    otx_diagnostics *quiet = otx_diagnostics_create(call->run.allocator);
    otx_call aside = *call;
    otx_status status;

    if (!quiet)
        return otx_fail_memory(&call->run, STAGE);
    aside.run.diagnostics = quiet;
    status = otx_companion_pictures_take(&aside, options, texture, out);
    if (status == OSDTEX_ERROR_MEMORY)
        status = otx_fail_memory(&call->run, STAGE);
    else if (status != OSDTEX_OK && status != OSDTEX_ERROR_CANCELLED)
    {
        const osdtex_diagnostic *error = otx_diagnostics_error(quiet);

        otx_note(
            &call->run, OSDTEX_SEVERITY_WARNING, STAGE,
            otx_where_file(error->file),
            "the maps of its texture are left out: %s", error->message);
        *out = (otx_companions){0};
        status = OSDTEX_OK;
    }
    otx_diagnostics_destroy(quiet);
    return status;
}

/* Those of the maps of a texture that are there. */
static otx_status
read_set(
    otx_call *call, const otx_data_maps *paths,
    const otx_scene_texture *texture, otx_companions *out)
{
    const otx_exemplar on = {
        .linear = texture->image,
        .wrap_x = texture->wrap_x,
        .wrap_y = texture->wrap_y};
    osdtex_companion maps[OTX_COMPANION_COUNT];
    osdtex_exemplar_options options = osdtex_exemplar_options_default();

    options.maps = maps;
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const char *path = path_of(paths, (otx_companion_kind)k);

        if (!path)
            continue;
        if (access(path, F_OK) == 0)
            maps[options.map_count++] =
                (osdtex_companion){.path = path, .kind = k};
        else
            otx_note(
                &call->run, OSDTEX_SEVERITY_WARNING, STAGE,
                otx_where_file(path),
                "the map is not there; what it says is not shown");
    }
    *out = (otx_companions){0};
    return options.map_count > 0 ? try_maps(call, &options, &on, out)
                                 : OSDTEX_OK;
}

otx_status
otx_model_maps_read(
    otx_call *call, const otx_data_maps *paths, const otx_scene *scene,
    const otx_map_textures **out)
{
    otx_run *run = &call->run;
    const int32_t count = scene->texture_count;
    otx_map_textures *maps = OTX_ZNEW(run->arena, otx_map_textures, 1);
    otx_companions *read = OTX_NEW(run->arena, otx_companions, count);
    otx_map_set *sets = OTX_NEW(run->arena, otx_map_set, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t t = 0; t < count; ++t)
    {
        const otx_scene_texture *texture = &scene->textures[t];

        OTX_TRY(read_set(call, &paths[t], texture, &read[t]));
        sets[t] = (otx_map_set){
            .companions = &read[t],
            .wrap_x = texture->wrap_x,
            .wrap_y = texture->wrap_y};
    }
    OTX_TRY(
        otx_map_textures_gather(run, sets, count, OTX_MAP_TEXTURES_ALL, maps));
    *out = maps->channels > 0 ? maps : NULL;
    return OSDTEX_OK;
}

/* companion_names.c -- what the files of maps are called. */
#include "export/companion_files.h"

#include <string.h>

const char *
otx_companion_files_path(
    otx_run *run, const char *color, otx_texture_type type,
    otx_companion_kind kind)
{
    const char *name = otx_companion_name(kind);
    const size_t base = (size_t)(strrchr(color, '.') - color);
    const size_t bytes = base + strlen(name) + sizeof "_.exr";
    char *path = OTX_NEW(run->arena, char, bytes);

    if (!path)
        return NULL;
    memcpy(path, color, base);
    path[base] = '_';
    strcpy(path + base + 1, name);
    strcat(path + base, otx_companion_files_extension(type, kind));
    return path;
}

otx_data_maps
otx_companion_files_names(
    otx_run *run, const char *name, otx_texture_type type,
    const otx_companions *companions)
{
    const char *names[OTX_COMPANION_COUNT];

    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        names[k] = companions->maps[k].is_there
                       ? otx_companion_files_path(
                             run, name, type, (otx_companion_kind)k)
                       : NULL;
    return (otx_data_maps){
        .normal = names[OTX_COMPANION_NORMAL],
        .normal_y_down = companions->written_y_down,
        .roughness = names[OTX_COMPANION_ROUGHNESS],
        .metalness = names[OTX_COMPANION_METALNESS],
        .height = names[OTX_COMPANION_HEIGHT],
        .occlusion = names[OTX_COMPANION_OCCLUSION],
    };
}

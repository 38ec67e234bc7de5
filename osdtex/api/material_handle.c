/* material_handle.c -- the files of a material as maps of an exemplar. */
#include "api/call.h"
#include "exemplar/companions.h"
#include "file/material_layers.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

struct osdtex_material
{
    otx_arena *arena;
    osdtex_companion maps[OSDTEX_MAP_KINDS];
    osdtex_material_info info;
    otx_material_files layers; /* by role, of an EXR that has them */
};

const char *
osdtex_map_kind_name(osdtex_map_kind kind)
{
    return kind >= 0 && kind < OTX_COMPANION_COUNT
               ? otx_companion_name((otx_companion_kind)kind)
               : NULL;
}

static osdtex_companion *
add(osdtex_material *m, const otx_material_files *files, otx_material_role role,
    osdtex_map_kind kind)
{
    osdtex_companion *map = &m->maps[m->info.map_count++];

    *map = (osdtex_companion){
        .path = files->paths[role],
        .layer = m->layers.paths[role],
        .kind = kind};
    return map;
}

/* A file of its own wins over a packed one. */
static void
add_or_unpack(
    osdtex_material *m, const otx_material_files *files, otx_material_role role,
    osdtex_map_kind kind, int32_t channel)
{
    if (files->paths[role])
        add(m, files, role, kind);
    else if (files->paths[OTX_MATERIAL_PACKED])
        add(m, files, OTX_MATERIAL_PACKED, kind)->channel = channel;
}

static void
list_maps(osdtex_material *m, const otx_material_files *files)
{
    const char *const *paths = files->paths;
    const bool gloss =
        paths[OTX_MATERIAL_GLOSS] && !paths[OTX_MATERIAL_ROUGHNESS];

    if (paths[OTX_MATERIAL_NORMAL])
        add(m, files, OTX_MATERIAL_NORMAL, OSDTEX_MAP_NORMAL);
    else if (paths[OTX_MATERIAL_NORMAL_DX])
        add(m, files, OTX_MATERIAL_NORMAL_DX, OSDTEX_MAP_NORMAL)->y_down = 1;
    if (gloss)
        add(m, files, OTX_MATERIAL_GLOSS, OSDTEX_MAP_ROUGHNESS)->inverted = 1;
    else
        add_or_unpack(
            m, files, OTX_MATERIAL_ROUGHNESS, OSDTEX_MAP_ROUGHNESS, 1);
    if (paths[OTX_MATERIAL_HEIGHT])
        add(m, files, OTX_MATERIAL_HEIGHT, OSDTEX_MAP_HEIGHT);
    add_or_unpack(m, files, OTX_MATERIAL_METALNESS, OSDTEX_MAP_METALNESS, 2);
    add_or_unpack(m, files, OTX_MATERIAL_OCCLUSION, OSDTEX_MAP_OCCLUSION, 0);
}

/* A file that is there and called .exr. */
static bool
is_exr(const char *text)
{
    const char *dot = strrchr(text, '.');
    struct stat info;

    return dot && strcasecmp(dot, ".exr") == 0 && stat(text, &info) == 0 &&
           S_ISREG(info.st_mode);
}

static otx_status
find(otx_run *run, const char *text, osdtex_material **out)
{
    osdtex_material *m = OTX_ZNEW(run->arena, osdtex_material, 1);
    otx_material_files files;

    if (!text || !*text)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "material", OTX_NOWHERE,
            "no folder or name of a material is given");
    if (!m)
        return otx_fail_memory(run, "material");
    if (is_exr(text))
        OTX_TRY(otx_material_layers_find(run, text, &files, &m->layers));
    else
        OTX_TRY(otx_material_files_find(run, text, &files));
    m->arena = run->arena;
    m->info.color = files.paths[OTX_MATERIAL_COLOR];
    m->info.color_layer = m->layers.paths[OTX_MATERIAL_COLOR];
    list_maps(m, &files);
    m->info.maps = m->maps;
    *out = m;
    return OSDTEX_OK;
}

osdtex_status
osdtex_material_find(
    osdtex_context *context, const char *text, osdtex_material **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "material", &call));
    return otx_call_end(&call, find(&call.run, text, out), out);
}

const osdtex_material_info *
osdtex_material_describe(const osdtex_material *material)
{
    return material ? &material->info : NULL;
}

void
osdtex_material_destroy(osdtex_material *material)
{
    if (material)
        otx_arena_destroy(material->arena);
}

/* material_layers.c -- roles of layers by their names. */
#include "file/material_layers.h"

#include "file/exr_data.h"

static const char STAGE[] = "material";

static otx_status
take(
    otx_run *run, const char *path, const char *layer, int32_t *ranks,
    otx_material_files *out, otx_material_files *layers)
{
    int32_t rank;
    const otx_material_role role = otx_material_files_role(layer, &rank);

    if (role == OTX_MATERIAL_ROLE_COUNT || rank < ranks[role])
        return OSDTEX_OK;
    if (out->paths[role] && rank == ranks[role])
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(path),
            "the layers '%.60s' and '%.60s' could both be the same map of the "
            "material; write the EXR with one of them",
            layers->paths[role], layer);
    out->paths[role] = path;
    layers->paths[role] = layer;
    ranks[role] = rank;
    return OSDTEX_OK;
}

otx_status
otx_material_layers_find(
    otx_run *run, const char *path, otx_material_files *out,
    otx_material_files *layers)
{
    int32_t ranks[OTX_MATERIAL_ROLE_COUNT] = {0}, maps = 0;
    const char *copy = otx_arena_strdup(run->arena, path);
    otx_exr_data_list list;

    *out = *layers = (otx_material_files){{NULL}};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_exr_data_list_read(run, path, &list));
    for (int32_t i = 0; i < list.count; ++i)
        OTX_TRY(take(run, copy, list.names[i], ranks, out, layers));
    for (int k = 0; k < OTX_MATERIAL_ROLE_COUNT; ++k)
        maps += k != OTX_MATERIAL_COLOR && out->paths[k] != NULL;
    if (maps == 0)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(path),
            "no layer of the EXR is called as the map of a material is "
            "(normal, roughness, height, ...); give a folder of maps, or name "
            "them one by one");
    out->paths[OTX_MATERIAL_COLOR] = copy;
    return OSDTEX_OK;
}

/* mapping_info.c -- what a mapping tells of itself. */
#include "api/mapping_info.h"

osdtex_mapping_info
otx_mapping_info_of(const osdtex_mapping *handle)
{
    return (osdtex_mapping_info){
        .method = handle->method->name,
        .scale = handle->mapping.scale,
        .face_count = handle->surface->info.face_count,
        .corner_count = handle->surface->info.corner_count,
        .uvs = handle->mapping.uvs,
        .face_patch = handle->mapping.face_patch,
        .patch_count = handle->mapping.patch_count,
        .exemplar_count = handle->source_count,
        .patch_exemplar = handle->mapping.patch_exemplar,
    };
}

/* model_maps.h -- the data maps that a written model names beside its colours.
 */
#ifndef OTX_API_MODEL_MAPS_H
#define OTX_API_MODEL_MAPS_H

#include "api/call.h"
#include "file/data_maps.h"
#include "render/scene.h"

/* Reads the maps of the textures of a scene, told in the frame of the UVs: NULL
 * in *out where there is none. A map that is not there, or does not lie on its
 * texture, is a warning and left out.
 *
 *   paths  [scene->texture_count] of files; their <UDIM> is resolved
 *
 * MEMORY, CANCELLED, LIMIT. */
otx_status otx_model_maps_read(
    otx_call *call, const otx_data_maps *paths, const otx_scene *scene,
    const otx_map_textures **out);

#endif

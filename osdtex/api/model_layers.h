/* model_layers.h -- faces of a model that lie over others.
 *
 * Faces of the same corners, one after the other, are layers: what a later one
 * shows lies over the earlier ones, as far as its alpha says. Rays would hit
 * any of them. */
#ifndef OTX_API_MODEL_LAYERS_H
#define OTX_API_MODEL_LAYERS_H

#include "render/scene.h"

/* Makes lookups of the first face of all faces that lie over it; these go. The
 * textures then have four channels, alpha 1 where they had none. In run->arena.
 *
 *   over   [scene->face_count] 1: cut out, and may lie over another
 *   scene  with UVs and a texture for each face
 *
 * MEMORY. */
otx_status otx_model_layers_fold(
    otx_run *run, const uint8_t *over, otx_scene_texture *textures,
    otx_scene *scene);

#endif

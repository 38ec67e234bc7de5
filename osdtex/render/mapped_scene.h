/* mapped_scene.h -- the scene that shows a mapping. */
#ifndef OTX_RENDER_MAPPED_SCENE_H
#define OTX_RENDER_MAPPED_SCENE_H

#include "render/scene.h"

/* The leaf level of a mapping on the limit surface, textured with its
 * exemplars. The stretch is taken in the mapping's own scale. Borrows both;
 * what must be made is made in run->arena. MEMORY. */
otx_status otx_scene_from_mapping(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_scene *out);

#endif

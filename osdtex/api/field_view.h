/* field_view.h -- a field as lines and dots to be drawn. */
#ifndef OTX_API_FIELD_VIEW_H
#define OTX_API_FIELD_VIEW_H

#include "mapping/mapping.h"
#include "render/overlay.h"

/* Lines along the directions of a guide, and its singularities, on the leaf
 * level. In run->arena. */
otx_status otx_field_view(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    otx_overlay *out);

#endif

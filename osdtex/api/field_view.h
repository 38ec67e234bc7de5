/* field_view.h -- a field as lines and dots to be drawn. */
#ifndef OTX_API_FIELD_VIEW_H
#define OTX_API_FIELD_VIEW_H

#include "mapping/mapping.h"
#include "render/overlay.h"

/* The singularities of a guide on the leaf level, and with `has_lines` lines
 * along its directions. In run->arena. */
otx_status otx_field_view(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    bool has_lines, otx_overlay *out);

#endif

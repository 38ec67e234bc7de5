/* cell_view.h -- the lattice on a surface as lines and dots to be drawn. */
#ifndef OTX_API_CELL_VIEW_H
#define OTX_API_CELL_VIEW_H

#include "mapping/mapping.h"
#include "render/overlay.h"

/* The lines between cells, where the lattice runs through, and its
 * dislocations. In run->arena. */
otx_status otx_cell_view(
    otx_run *run, const otx_surface *surface, const otx_cell_map *lattice,
    otx_overlay *out);

#endif

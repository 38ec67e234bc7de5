/* draft.h -- a cage refined only as far as costs nothing.
 *
 * What has to be known before work begins (areas, edges, where the UVs lie) is
 * read off a draft: a few tens of thousands of faces, whatever the cage and the
 * level that is asked for. */
#ifndef OTX_SURFACE_DRAFT_H
#define OTX_SURFACE_DRAFT_H

#include "surface/surface.h"

/* The deepest surface, up to `level`, of at most some 20 000 faces. Its
 * vertices are among those of any deeper level, so what lies beyond a border
 * in a draft does so in the surface.
 *
 * A cage that has more faces than that is taken as it is, without the limit,
 * from which so fine a mesh hardly differs. A draft has no normals and no
 * tangents. It lives in run->arena and borrows the cage. TOPOLOGY, MEMORY,
 * CANCELLED. */
otx_status otx_surface_draft(
    otx_run *run, const otx_cage *cage, int32_t level, otx_surface *out);

#endif

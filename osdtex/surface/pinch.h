/* pinch.h -- a cage whose parts touch only at vertices, parted there.
 *
 * Game models and the Utah teapot have pinch vertices: vertices with more than
 * one fan of faces. Each fan gets a vertex of its own here, so that everything
 * above sees a manifold, and all of them are infinitely sharp corners. That is
 * what OpenSubdiv makes of such a vertex by itself (and with it every program
 * that shows the cage): the parts go on touching where the artist put them. */
#ifndef OTX_SURFACE_PINCH_H
#define OTX_SURFACE_PINCH_H

#include "surface/cage.h"

/* `cage` with every fan on a vertex of its own, and creases and corners moved
 * along. Vertices keep their numbers; those that are new lie behind them,
 * cage->split_count of them. Arrays that differ live in run->scratch, all
 * others are borrowed. A cage without pinches comes out as it is.
 *
 * MEMORY; NUMERIC when the mesh is no manifold apart from its pinches. */
otx_status otx_pinch_split(otx_run *run, const otx_cage *cage, otx_cage *out);

#endif

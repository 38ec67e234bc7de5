/* vertex_check.h -- can a vertex be told from the inside of a tile?
 *
 * Tiles that meet exactly may still meet in something that the exemplar never
 * shows, and the eye finds it since it comes again at every vertex. Windows
 * around vertices, where four tiles of the set meet, are looked up in the
 * exemplar, and so are windows inside tiles, which measure what cuts do. */
#ifndef OTX_TILING_VERTEX_CHECK_H
#define OTX_TILING_VERTEX_CHECK_H

#include "image/tile_layout.h"
#include "quilt/patch_search.h"

typedef struct otx_vertex_figures
{
    double vertex, inside; /* median distances; negative: not known */
} otx_vertex_figures;

/* Looks up windows of search->size texels. The set has all its tiles.
 *
 *   picture  of the whole set */
otx_status otx_vertex_check(
    otx_run *run, const otx_patch_search *search, const otx_tile_layout *layout,
    const otx_texel_map *picture, otx_vertex_figures *out);

#endif

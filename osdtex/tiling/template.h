/* template.h -- the pieces of the exemplar that corners and edges show.
 *
 * Candidates are drawn at random, built, and compared by what their cuts cost
 * and by how typical of the exemplar they are: the cheapest corner alone is a
 * flat spot inside one stone, and a plain diamond at every vertex. */
#ifndef OTX_TILING_TEMPLATE_H
#define OTX_TILING_TEMPLATE_H

#include "quilt/patch_search.h"
#include "tiling/tileset.h"

/* Texels that otx_template_kit adds to the pool. */
int32_t otx_template_extra(
    const otx_strip_sizes *sizes, const otx_tileset_options *options);

/* Builds corners and strips of a set in run->arena. kit->sizes and the counts
 * are given.
 *
 *   looks  where corners are looked up; NULL: their cuts decide alone */
otx_status otx_template_kit(
    otx_run *run, otx_texel_pool *pool, const otx_patch_search *looks,
    const otx_tileset_options *options, const otx_tile_layout *layout,
    otx_frame_kit *kit);

#endif

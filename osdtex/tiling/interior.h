/* interior.h -- the inside of one tile.
 *
 * Under the four strips lie windows of the exemplar. The strips keep what is
 * within a gutter's width of the rim; from there on, who shows what is decided
 * by expansion moves: the strips grow inwards until the seam is cheapest, and
 * further windows take over where they continue what is there better. Then the
 * worst of the seams is mended by small patches. */
#ifndef OTX_TILING_INTERIOR_H
#define OTX_TILING_INTERIOR_H

#include "quilt/patchwork.h"
#include "tiling/ring_search.h"

typedef struct otx_interior_options
{
    int32_t windows;      /* that fit all four sides, tried in turn */
    int32_t side_windows; /* that fit one side, for each side */
    int32_t rounds;       /* of expansions over all sheets, at most */
    otx_patchwork_options patchwork;
} otx_interior_options;

/* Fills `map` [cell * cell] with tile `name`, gutter included. Works in the
 * arena run->scratch only.
 *
 *   patches   where patches are looked for; NULL: none are laid
 *   windows   [window_count] to use, the first as the ground
 *   seams     of the inside; NULL not wanted */
otx_status otx_interior_fill(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    const otx_patch_search *patches, const otx_interior_options *options,
    const otx_texel_window *windows, int32_t window_count, otx_texel_map *map,
    otx_quilt_seams *seams);

/* Chooses windows by `search` and fills the tile with them. */
otx_status otx_interior_build(
    otx_run *run, const otx_ring_search *search, const otx_tile_name *name,
    const otx_patch_search *patches, const otx_interior_options *options,
    otx_texel_map *map, otx_quilt_seams *seams);

#endif

/* assign.h -- which tile goes on which quad.
 *
 * One pass over the faces in their order: a face takes over the sides that
 * earlier faces have decided and chooses the others, so that its tile is not
 * one that is already around its vertices, and is one that is little used.
 * What is around a vertex is kept as 64 bits, so the pass reads and writes
 * each array once. A second pass changes an edge where two neighbours still
 * show the same tile. */
#ifndef OTX_METHOD_TILE_ASSIGN_H
#define OTX_METHOD_TILE_ASSIGN_H

#include "image/tile_layout.h"
#include "surface/level.h"

typedef struct otx_assign_input
{
    const otx_level *level; /* quads only */
    const otx_tile_layout *layout;
    const uint8_t *turns; /* [face_count], see tile.h; NULL: none is turned */
    const uint8_t *whole; /* [vert_count] whether all tiles around a vertex lie
                           * the same way up; NULL: around none */
    bool plain;           /* the paper's rule: every edge at random */
    bool upright;         /* oriented layouts: no tile upside down where the
                           * turns do not ask for it */
} otx_assign_input;

/* Tile numbers, -1 on holes. The seed is run->seed.
 *
 *   names  [face_count] */
otx_status
otx_assign_names(otx_run *run, const otx_assign_input *input, int32_t *names);

#endif

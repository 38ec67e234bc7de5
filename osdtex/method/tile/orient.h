/* orient.h -- which way up tiles lie, for pictures that have a direction.
 *
 * Two neighbours agree when the bottom of one lies on the top of the other, or
 * right on left. Around a vertex of odd valence they cannot all agree: there,
 * or on the way to the next such vertex, rows meet columns. */
#ifndef OTX_METHOD_TILE_ORIENT_H
#define OTX_METHOD_TILE_ORIENT_H

#include "surface/surface.h"

/* Turns that agree from face to face, breadth first from the first face of
 * every component.
 *
 *   turns  [face_count], see tile.h */
otx_status
otx_orient_walk(otx_run *run, const otx_level *level, uint8_t *turns);

/* The vertices around which all tiles agree. Most do: the others are on lines
 * between vertices at which not four faces meet.
 *
 *   whole  [vert_count] */
void otx_orient_find_whole(
    const otx_level *level, const uint8_t *turns, uint8_t *whole);

/* Turns that follow the edge loops from face to face, breadth first from the
 * first face of every component. Notes the vertices around which no
 * orientation is consistent.
 *
 *   turns  [face_count of the level], see tile.h */
otx_status otx_orient_loops(
    otx_run *run, const otx_surface *surface, int32_t level, uint8_t *turns);

/* Turns by which a tile's columns rise along axis 0, 1 or 2 as far as its quad
 * can; notes the edges at which rows meet columns. */
otx_status otx_orient_axis(
    otx_run *run, const otx_surface *surface, int32_t level, int32_t axis,
    uint8_t *turns);

#endif

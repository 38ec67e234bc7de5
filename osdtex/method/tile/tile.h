/* tile.h -- seamless tiles on quads: one tile of a tiled texture to a face.
 *
 * [Akleman] Akleman et al.: a simple and practical technique for seamlessly
 * texturing quadrilateral meshes. Every edge gets a boundary and says which of
 * its faces sees which side; the four types a face sees are the name of its
 * tile. See docs/notes/tile.md. */
#ifndef OTX_METHOD_TILE_TILE_H
#define OTX_METHOD_TILE_TILE_H

#include "method/method.h"

enum
{
    OTX_TILE_SPREAD, /* choices of `rule` */
    OTX_TILE_PLAIN
};

enum
{
    OTX_TILE_LOOPS, /* choices of `direction` */
    OTX_TILE_ALONG_X,
    OTX_TILE_ALONG_Y,
    OTX_TILE_ALONG_Z
};

typedef struct otx_tile_settings
{
    int32_t level; /* -1 auto */
    int32_t rule;
    int32_t direction;
    int32_t half_turns; /* 0 or 1 */
} otx_tile_settings;

/* The level whose quads get the tiles, as settings and scale ask.
 *
 * TOPOLOGY or ARGUMENT, with a sentence, when it has faces that are no
 * quads. */
otx_status otx_tile_level(
    otx_run *run, const otx_surface *surface, const otx_tile_layout *layout,
    const otx_tile_settings *settings, double scale, int32_t *out);

/* Numbers of the tiles that the faces of `level` get, -1 on holes, and how far
 * each tile is turned: corner (i + turns) & 3 of the face is corner i of the
 * tile. Both in run->arena. They depend on the mesh, the layout's boundaries
 * and corners, the settings and run->seed, never on a picture. */
otx_status otx_tile_assign(
    otx_run *run, const otx_surface *surface, int32_t level,
    const otx_tile_layout *layout, const otx_tile_settings *settings,
    int32_t **names, uint8_t **turns);

#endif

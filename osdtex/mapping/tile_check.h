/* tile_check.h -- do tiles meet, and how are they used?
 *
 * Measured as a renderer sees them: bilinear samples of a mip level on both
 * sides of every edge between two tiles, and of all tiles at every vertex. */
#ifndef OTX_MAPPING_TILE_CHECK_H
#define OTX_MAPPING_TILE_CHECK_H

#include "image/tile_layout.h"
#include "mapping/mapping.h"

/* Largest difference of a channel, in units of the picture. */
typedef struct otx_tile_match
{
    double edge;   /* between the two sides of an edge */
    double corner; /* between two tiles at a vertex */
} otx_tile_match;

/* Compares samples of `level`, which is the picture of the tiles or one of its
 * mip levels: `samples` (2 or more) along every leaf edge between two tiles,
 * both ends included. */
otx_status otx_tile_check_match(
    otx_run *run, const otx_mapping *mapping, const otx_image *level,
    int32_t samples, otx_tile_match *out);

typedef struct otx_tile_use
{
    int32_t tiles;    /* of the set */
    int32_t used;     /* of those, by at least one face */
    int32_t least;    /* faces that show the tile least used, 0 too */
    int32_t most;     /* faces that show the tile most used */
    double mean;      /* faces to a tile */
    int64_t edges;    /* between two tiles */
    int64_t equal;    /* of those, between two of the same cell */
    int64_t vertices; /* at which tiles meet */
    int64_t equal_at; /* of those, where two show the same cell */
} otx_tile_use;

/* Counts which cells of the layout the faces of the tiles' level show. */
otx_status otx_tile_check_use(
    otx_run *run, const otx_mapping *mapping, const otx_tile_layout *layout,
    otx_tile_use *out);

#endif

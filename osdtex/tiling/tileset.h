/* tileset.h -- a tiled texture from a picture.
 *
 * Corners first, strips between them, then the insides; every choice that the
 * user leaves open is made by the cost of what comes out of it. See
 * docs/notes/tile.md. */
#ifndef OTX_TILING_TILESET_H
#define OTX_TILING_TILESET_H

#include "tiling/interior.h"

/* An edge as the user lays it: texels, from the lower left of the picture. */
typedef struct otx_tileset_edge
{
    otx_vec2 middle;
    double angle;  /* radians */
    double length; /* texels of the exemplar; 0: as long as a tile's side */
} otx_tileset_edge;

/* Zero is a fine default for all but `boundaries`, `corners` and `gutter`. */
typedef struct otx_tileset_options
{
    int32_t boundaries; /* 1 .. 3; of each direction when oriented */
    int32_t corners;    /* 1 .. OTX_TILE_LAYOUT_MAX_CORNERS */
    int32_t cell;       /* a power of two, 0: by the size of the picture */
    int32_t gutter;     /* a power of two */
    bool oriented;
    bool ramp; /* cross-fades as the paper prints them, see ramp.h */
    bool has_corner;
    otx_vec2 corner; /* texels; middle of the first corner */
    int32_t edge_count;
    const otx_tileset_edge *edges; /* [edge_count] of the first boundaries */
    otx_ring_region background;
    int32_t name_count;
    const int32_t *names; /* [name_count] ascending: make only these; borrowed
                           * by the layout */
} otx_tileset_options;

typedef struct otx_tileset
{
    otx_tile_layout layout;
    otx_image linear;          /* the picture, level 0 */
    otx_companions companions; /* the other maps, laid alike */
    int32_t tile_count;
    /* Mean distance along the cuts of corners, strips and insides. */
    double corner_seam, strip_seam, inner_seam;
    double random_pair; /* of two random texels */
} otx_tileset;

/* How insides are made. */
extern const otx_interior_options otx_tileset_interior;

/* The layout that otx_tileset_make will use, for whoever must know the names
 * before the tiles are made. ARGUMENT (options, a picture that is too small),
 * LIMIT. */
otx_status otx_tileset_plan(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options, otx_tile_layout *out);

/* The sizes that go with a layout. */
otx_strip_sizes otx_tileset_sizes(const otx_tile_layout *layout);

/* Makes the set in run->arena; the seed is run->seed. ARGUMENT, LIMIT,
 * CANCELLED, MEMORY. */
otx_status otx_tileset_make(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options, otx_tileset *out);

#endif

/* tile_layout.h -- how a tiled texture is divided into tiles.
 *
 * A tiled texture [Akleman] is a picture of square cells. Every side of a tile
 * has a type: boundary k has the two sides 2k and 2k + 1, and what a side of
 * type 2k shows inside is what one of type 2k + 1 shows in its gutter. The
 * name of a tile is the types of its sides and corners, and the name is the
 * place: UVs follow from it and not from what is painted there.
 *
 * Sides go counter-clockwise from the bottom one; corner i is where side i
 * begins. See docs/notes/tile.md. */
#ifndef OTX_IMAGE_TILE_LAYOUT_H
#define OTX_IMAGE_TILE_LAYOUT_H

#include "image/image.h"

enum
{
    OTX_TILE_LAYOUT_MAX_BOUNDARIES = 6,
    OTX_TILE_LAYOUT_MAX_CORNERS = 4,
    OTX_TILE_LAYOUT_MIN_CELL = 16,
    OTX_TILE_LAYOUT_MAX_CELL = 2048,
    /* Side of a picture that the reader takes back. */
    OTX_TILE_LAYOUT_MAX_SIDE = 8192
};

/* What the maker of the tiles measured, as shares of the distance of a random
 * pair of texels; negative: not known. */
typedef struct otx_tile_figures
{
    double inner_cut;     /* along the cuts inside tiles */
    double vertex_window; /* of what is seen around vertices from the nearest
                           * piece of the exemplar, median */
    double inner_window;  /* the same inside tiles */
} otx_tile_figures;

typedef struct otx_tile_layout
{
    int32_t boundaries; /* kinds of edges, two sides each */
    int32_t corners;    /* kinds of vertices */
    int32_t cell;       /* texels of a cell's side, a power of two */
    int32_t gutter;     /* of those, on each side; a power of two */
    int32_t columns, rows;
    /* Boundaries of the first half lie along the picture's rows, those of the
     * second half along its columns, and nothing is turned by 90 degrees. */
    bool oriented;
    int32_t source_width; /* texels of the picture the tiles are made of */
    uint64_t seed;
    int32_t name_count;
    const int32_t *names; /* [name_count] ascending: cell i shows the tile
                           * names[i]; NULL: it shows tile i */
    otx_tile_figures figures;
} otx_tile_layout;

/* Types of the sides and corners of a tile. */
typedef struct otx_tile_name
{
    int32_t sides[4];   /* 0 .. 2 boundaries - 1 */
    int32_t corners[4]; /* 0 .. corners - 1 */
} otx_tile_name;

/* Texels between the gutters. */
static inline int32_t
otx_tile_layout_side(const otx_tile_layout *layout)
{
    return layout->cell - 2 * layout->gutter;
}

static inline int32_t
otx_tile_layout_types(const otx_tile_layout *layout)
{
    return 2 * layout->boundaries;
}

/* Names of the first two digits, which is also that of the last two. */
static inline int32_t
otx_tile_layout_half(const otx_tile_layout *layout)
{
    const int32_t digit = otx_tile_layout_types(layout) * layout->corners;

    return digit * digit;
}

/* The name as a number: column + row * otx_tile_layout_half. */
static inline int32_t
otx_tile_layout_number(const otx_tile_layout *l, const otx_tile_name *name)
{
    const int32_t types = 2 * l->boundaries;
    const int32_t *s = name->sides, *c = name->corners;
    const int32_t column =
        ((s[0] * types + s[1]) * l->corners + c[0]) * l->corners + c[1];
    const int32_t row =
        ((s[2] * types + s[3]) * l->corners + c[2]) * l->corners + c[3];

    return column + row * otx_tile_layout_half(l);
}

otx_tile_name
otx_tile_layout_name(const otx_tile_layout *layout, int32_t number);

/* Cell that shows tile `number`, -1 when the picture does not have it. */
int32_t otx_tile_layout_cell(const otx_tile_layout *layout, int32_t number);

/* Lower left texel of a cell, gutter included. */
static inline void
otx_tile_layout_origin(
    const otx_tile_layout *layout, int32_t cell, int32_t *x, int32_t *y)
{
    *x = cell % layout->columns * layout->cell;
    *y = cell / layout->columns * layout->cell;
}

/* Mip levels in which whole texels fit the gutter, level 0 included: up to
 * 2^l = 2 gutter a texel lies on one side of an edge, or in its middle. */
int32_t otx_tile_layout_exact_levels(const otx_tile_layout *layout);

/* Levels 1, 2, ... of `image`, so that both sides of an edge show the same at
 * every level. Exact levels are means over the texels of level 0, summed in
 * double, so that turned tiles come to the same values. In coarser ones a
 * texel at a tile's rim would cover both sides and more: there the rims show
 * the mean of the picture, and where a cell is two texels or less, all does.
 *
 *   levels  [otx_pyramid_count - 1], pixels in `arena` */
otx_status otx_tile_layout_levels(
    otx_run *run, otx_arena *arena, const otx_tile_layout *layout,
    const otx_image *image, otx_image *levels);

/* Sets `columns` and `rows`: name is place where all tiles are there, else
 * nearly square. LIMIT past OTX_TILE_LAYOUT_MAX_SIDE. */
otx_status otx_tile_layout_arrange(otx_run *run, otx_tile_layout *layout);

/* The layout as one line of text, for the header of a file, in `arena`; NULL
 * when memory is out. */
const char *
otx_tile_layout_print(otx_arena *arena, const otx_tile_layout *layout);

/* Reads that line. FORMAT when it is damaged or does not fit a picture of
 * width x height. `path` is for the message. */
otx_status otx_tile_layout_parse(
    otx_run *run, const char *path, const char *text, int32_t width,
    int32_t height, otx_tile_layout *out);

#endif

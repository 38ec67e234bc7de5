/* tiles.h -- tiled textures: what the method "tile" maps.
 *
 *     osdtex_tiles_options options = osdtex_tiles_options_default();
 *
 *     options.boundaries = 2;      // 256 tiles
 *     osdtex_tiles_write(context, exemplar, NULL, &options, "tiles.exr", NULL);
 *     osdtex_exemplar_read(context, "tiles.exr", NULL, &tiles);
 *     map_options.method = "tile";
 *     osdtex_map(context, cage, tiles, &map_options, &mapping);
 *
 * Cuts and searches compare the picture in the coordinates that its exemplar
 * was read with, osdtex_exemplar_options.embedding. What they weigh was
 * measured in OSDTEX_EMBEDDING_LAB, which `osdtex tiles` asks for unless told
 * otherwise. */
#ifndef OSDTEX_TILES_H
#define OSDTEX_TILES_H

#include <osdtex/exemplar.h>
#include <osdtex/method.h>
#include <osdtex/surface.h>

OSDTEX_BEGIN_DECLS

/* A segment of the picture that a boundary of the tiles shows. Texels from the
 * lower left corner, radians. */
typedef struct osdtex_tiles_edge
{
    double x, y; /* its middle */
    double angle;
    double length; /* 0: as long as a tile's side */
} osdtex_tiles_edge;

typedef struct osdtex_tiles_options
{
    size_t size;
    int32_t boundaries; /* 1 .. 3, (2n)^4 tiles; oriented: of rows and of
                         * columns each, (4n)^4 tiles */
    int32_t corners;    /* kinds of vertices, 1 .. 4; n^4 times the tiles */
    int32_t tile_size;  /* texels, a power of two; 0: by the picture */
    int32_t gutter;     /* texels of that on each side, a power of two */
    int32_t oriented;   /* 1: nothing is turned by 90 degrees */
    int32_t edge_count;
    const osdtex_tiles_edge *edges; /* [edge_count], of the first
                                     * boundaries; the others are chosen */
    int32_t has_corner;
    int32_t background[4]; /* x0, y0, x1, y1: insides of tiles come from
                            * these texels; all 0: from anywhere */
    int32_t ramp;          /* 1: cross-fades as published instead of cuts, for
                            * comparison; such tiles jump at vertices */
    double corner_x;       /* texels; middle of the first kind of vertex */
    double corner_y;
    uint64_t seed;
    /* The settings with which `surface` will be mapped. */
    const osdtex_setting *settings;
    int32_t setting_count;
    int32_t reserved2;
    double scale; /* as for osdtex_map */
} osdtex_tiles_options;

static inline osdtex_tiles_options
osdtex_tiles_options_default(void)
{
    osdtex_tiles_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.boundaries = 1;
    options.corners = 1;
    options.gutter = 4;
    options.seed = 1;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_tiles_options_init(osdtex_tiles_options *out, size_t bytes);

typedef struct osdtex_tiles_info
{
    int32_t tile_count;
    int32_t tile_size;
    int32_t width; /* of the picture */
    int32_t height;
    /* Mean CIELAB distance along the cuts of vertices, edges and insides, and
     * of two random texels. */
    double corner_cut;
    double edge_cut;
    double inner_cut;
    double random_pair;
    /* How far windows of 16 texels around vertices, and inside tiles, are from
     * the nearest piece of the exemplar: median, relative to a random pair.
     * Negative where they were not looked up: a set for one mesh has not the
     * tiles for it, and pictures or tiles may be too small. */
    double vertex_window;
    double inner_window;
} osdtex_tiles_info;

/* Makes a tiled texture from `exemplar` and writes it as an EXR that
 * osdtex_exemplar_read takes back. On all threads, and the same for any number
 * of them.
 *
 *   surface  only the tiles that mapping it with this seed, scale and
 *            settings needs; NULL: all
 *   out      what was made; NULL not wanted
 *
 * ARGUMENT (options, a picture that is too small), LIMIT, IO, MEMORY,
 * CANCELLED. */
OSDTEX_API osdtex_status osdtex_tiles_write(
    osdtex_context *context, const osdtex_exemplar *exemplar,
    const osdtex_surface *surface, const osdtex_tiles_options *options,
    const char *path, osdtex_tiles_info *out);

OSDTEX_END_DECLS

#endif

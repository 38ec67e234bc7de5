/* textures.h -- a bake in memory: the texels that osdtex_bake() writes, as
 * arrays.
 *
 * A handle is made from a mapping and bake options: it settles onto which
 * coordinates and tiles the textures go, and bakes nothing yet. Its texels are
 * then had in one of three ways, as often as wanted:
 *
 *     osdtex_bake_options options = osdtex_bake_options_default();
 *     const osdtex_texture_part color = {0, 0, 0}; // texture, tile, level
 *     osdtex_textures *textures;
 *     osdtex_image *image;
 *
 *     options.resolution = 1024;
 *     osdtex_textures_create(context, mapping, &options, &textures);
 *     osdtex_textures_image(context, textures, &color, &image);
 *     use(osdtex_image_describe(image)->pixels);
 *
 * osdtex_textures_image() makes an image of the library's,
 * osdtex_textures_read() fills an array of the caller's, and
 * osdtex_textures_bake() hands blocks to a function of the caller's, so that no
 * texture is ever in memory as a whole. All three give the same values, which
 * are those of the files before these round them: osdtex_bake() writes the
 * colour as half floats, or as 8-bit sRGB for the web.
 *
 * A handle keeps its mapping. It is immutable; contexts may share it, and the
 * values are the same for any number of threads.
 *
 * Rows begin at the bottom: texel (x, y) of a level of `side` texels has its
 * middle at UV ((x + 1/2) / side, (y + 1/2) / side) of its tile. */
#ifndef OSDTEX_TEXTURES_H
#define OSDTEX_TEXTURES_H

#include <osdtex/bake.h>
#include <osdtex/image.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_textures osdtex_textures;

/* What is baked, and where it goes. */
typedef struct osdtex_textures_info
{
    int32_t texture_count; /* the colour, the maps that its exemplar was read
                            * with, and the extras asked for */
    int32_t tile_count;
    const int32_t *tiles; /* [tile_count] UDIM numbers, ascending: 1001 is the
                           * unit square */
    int32_t side;         /* texels of a tile at level 0 */
    int32_t level_count;  /* level l has max(1, side >> l) texels a side */
    osdtex_bake_uvs uvs;  /* OWN, ATLAS or CHARTS */
    osdtex_fvar fvar;     /* by which the coordinates below are subdivided */
    /* The cage's coordinates under which the textures lie. They are of the
     * faces of the cage in their order. */
    osdtex_index uv_count;
    osdtex_index corner_count;    /* of the cage */
    const float *cage_uvs;        /* [uv_count * 2] */
    const osdtex_index *face_uvs; /* [corner_count] */
} osdtex_textures_info;

/* One of the textures. */
typedef struct osdtex_texture_info
{
    const char *name;        /* "color"; "normal", "roughness", "height",
                              * "metalness", "occlusion"; "patch", "uv",
                              * "stretch", "seam", "source", "slice" */
    const char *color_space; /* of its linear values; NULL: no colours */
    const char *summary;     /* one sentence: what its channels hold */
    int32_t channels;        /* 1; 3; or 4: the source, and colour with alpha,
                              * by which it is multiplied */
    int32_t reserved;
} osdtex_texture_info;

/* Settles what is baked where; the mapping is kept. Of the options those that
 * are about files (comments, mesh, previews, normals, units) say nothing here;
 * with `udim` the handle has that tile only. No texel is evaluated yet.
 *
 * ARGUMENT (no such tile), TOPOLOGY (own UVs are asked for that cannot be baked
 * onto), LIMIT, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_textures_create(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_bake_options *options, osdtex_textures **out);
OSDTEX_API const osdtex_textures_info *
osdtex_textures_describe(const osdtex_textures *textures);
/* Texture `index`, below texture_count, lent like the above; NULL for others.
 * The colour is the first. */
OSDTEX_API const osdtex_texture_info *
osdtex_texture_describe(const osdtex_textures *textures, int32_t index);
OSDTEX_API void osdtex_textures_destroy(osdtex_textures *textures);

/* Which texels: a level of a tile of a texture, each counted from 0. */
typedef struct osdtex_texture_part
{
    int32_t texture;
    int32_t tile; /* index into osdtex_textures_info.tiles */
    int32_t level;
} osdtex_texture_part;

/* Bakes one part into a new image. Runs on all threads of the context; for its
 * cost see bake.h. ARGUMENT (no such part), MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_textures_image(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_texture_part *part, osdtex_image **out);

/* The same into the caller's array, which holds what was there, or some of the
 * texels, when the call fails.
 *
 *   pixels  [side * side * channels] of the level, bottom row first
 *   count   floats that the array has room for
 *
 * ARGUMENT (no such part, an array that is too small), MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_textures_read(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_texture_part *part, float *pixels, size_t count);

/* A rectangle of texels, as a sink gets it. */
typedef struct osdtex_bake_block
{
    const float *pixels; /* [height * width * channels], bottom row first, lent
                          * until the sink returns */
    const char *name;    /* of the texture */
    int32_t texture;
    int32_t tile; /* index, and ... */
    int32_t udim; /* ... number */
    int32_t level;
    int32_t side; /* texels of the level */
    int32_t x, y; /* the lower left texel */
    int32_t width, height;
    int32_t channels;
} osdtex_bake_block;

/* Where blocks go, and which. */
typedef struct osdtex_bake_sink
{
    size_t size;
    /* Called by the thread that bakes, for one block after the other: texture
     * by texture, tile by tile, levels from the first up, the blocks of a level
     * from the top row down and from left to right. False stops the bake. It
     * may not use the context. */
    bool (*put)(void *user, const osdtex_bake_block *block);
    void *user;
    int32_t texture;     /* -1: all */
    int32_t tile;        /* -1: all */
    int32_t first_level; /* 0: the whole size */
    int32_t level_count; /* from there on; 0: all that there are */
} osdtex_bake_sink;

/* All textures, all tiles, each in its whole size alone. */
static inline osdtex_bake_sink
osdtex_bake_sink_none(void)
{
    osdtex_bake_sink sink = OSDTEX_ZERO;

    sink.size = sizeof sink;
    sink.texture = -1;
    sink.tile = -1;
    sink.level_count = 1;
    return sink;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_bake_sink_init(osdtex_bake_sink *out, size_t bytes);

/* Bakes into a sink. Besides the mapping, 8 MB of blocks and the lists of what
 * is in them are needed, whatever the size of the textures. ARGUMENT (no `put`,
 * no such texture, tile or level), MEMORY, CANCELLED (by progress or the sink).
 */
OSDTEX_API osdtex_status osdtex_textures_bake(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_bake_sink *sink);

OSDTEX_END_DECLS

#endif

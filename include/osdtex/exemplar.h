/* exemplar.h -- the picture of a material, its colours resolved.
 *
 *     osdtex_exemplar_options options = osdtex_exemplar_options_default();
 *     osdtex_exemplar *exemplar;
 *
 *     options.from = "sRGB - Texture";        // NULL: by the stated rules
 *     osdtex_exemplar_read(context, "bricks.png", &options, &exemplar);
 *
 * or from pixels in memory, which are copied:
 *
 *     osdtex_image_create(context, 512, 512, 3, pixels, &image);
 *     osdtex_exemplar_create(context, image, NULL, &exemplar);
 *     osdtex_image_destroy(image);
 *
 * Reading converts the picture to what is written and to what is compared, and
 * looks whether it tiles; each of these pictures is kept, as floats. Every
 * decision about colour is a finding of stage "colour". A handle is immutable;
 * contexts may share it. */
#ifndef OSDTEX_EXEMPLAR_H
#define OSDTEX_EXEMPLAR_H

#include <osdtex/image.h>
#include <osdtex/material.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_exemplar osdtex_exemplar;

/* In what colours are compared. */
typedef int32_t osdtex_embedding;
enum
{
    OSDTEX_EMBEDDING_HSV_CONE = 0,
    OSDTEX_EMBEDDING_HSV_CYLINDER = 1,
    OSDTEX_EMBEDDING_LAB = 2,
    OSDTEX_EMBEDDING_RGB = 3
};

/* Whether the picture continues across its own border. */
typedef int32_t osdtex_wrap;
enum
{
    OSDTEX_WRAP_AUTO = 0, /* tested, for each axis */
    OSDTEX_WRAP_NO = 1,
    OSDTEX_WRAP_YES = 2
};

/* What becomes of a picture that does not tile. UVs refer to the picture that
 * is made, so maps that lie on the file's pixels no longer fit: by default it
 * is kept. */
typedef int32_t osdtex_tileable;
enum
{
    OSDTEX_TILEABLE_AUTO = 0, /* made to, where that is judged good */
    OSDTEX_TILEABLE_KEEP = 1, /* stays; patches keep inside it */
    OSDTEX_TILEABLE_MAKE = 2  /* made to: windows of the picture are sewn
                               * over the line where its borders meet */
};

/* For which program textures are written. It settles their colour space, where
 * `to` does not, and their file type: 8-bit sRGB PNG for the web, EXR for all
 * others. */
typedef int32_t osdtex_receiver;
enum
{
    OSDTEX_RECEIVER_ANY = 0,
    OSDTEX_RECEIVER_BLENDER = 1,
    OSDTEX_RECEIVER_MAYA = 2,
    OSDTEX_RECEIVER_HOUDINI = 3,
    OSDTEX_RECEIVER_USD = 4,
    OSDTEX_RECEIVER_WEB = 5
};

/* Which files textures are. Those of integers are sRGB, whatever the receiver
 * is: `to` has no say. */
typedef int32_t osdtex_texture_type;
enum
{
    OSDTEX_TEXTURE_ANY = 0,  /* what the receiver takes */
    OSDTEX_TEXTURE_EXR = 1,  /* half floats, with mip levels */
    OSDTEX_TEXTURE_PNG = 2,  /* 8 bits, dithered */
    OSDTEX_TEXTURE_TIFF = 3, /* 16 bits */
    OSDTEX_TEXTURE_JPEG = 4  /* 8 bits, no alpha */
};

/* What names of such files end in: ".exr", ".png", ".tif", ".jpg"; those of the
 * colour with `map` -1, else those of a map of that kind, an osdtex_map_kind:
 * heights stay floats (TIFF or EXR), other maps have 16 bits (TIFF or PNG).
 * NULL for other values. */
OSDTEX_API const char *
osdtex_texture_extension(osdtex_texture_type type, int32_t map);

typedef struct osdtex_exemplar_options
{
    size_t size;
    /* Colour spaces by name, alias or role; NULL: by the stated rules. */
    const char *from;        /* of the file */
    const char *to;          /* of what is written; role scene_linear,
                              * linear Rec.709 without a configuration */
    const char *match_space; /* in which colours are compared */
    osdtex_embedding embedding;
    osdtex_wrap wrap;
    osdtex_tileable tileable;
    osdtex_receiver receiver; /* of the textures; `to` wins over it */
    const char *layer; /* of an EXR, by name; NULL: plain R, G, B of any part,
                        * else what is called as beauties are */
    /* The other maps of the material: what is done to the picture's texels is
     * done to theirs. */
    const osdtex_companion *maps; /* [map_count] */
    int32_t map_count;
    int32_t normals_y_down; /* 1: normal maps are written as DirectX has them;
                             * NAME.usda and NAME.mtlx turn them up again */
    double height_range;  /* scene units from the lowest to the highest value of
                           * a height map, 0 and 1; 0: a twentieth of the
                           * exemplar's width */
    double height_middle; /* the value that stays on the surface; .5 */
    /* What matches look at, and how much it counts: the colour, and each map
     * by its kind. All 0: the colour alone. */
    double match_color;
    double match_maps[OSDTEX_MAP_KINDS];
    osdtex_texture_type texture_type; /* of what is written */
    int32_t reserved;
} osdtex_exemplar_options;

static inline osdtex_exemplar_options
osdtex_exemplar_options_default(void)
{
    osdtex_exemplar_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.embedding = OSDTEX_EMBEDDING_HSV_CONE;
    options.wrap = OSDTEX_WRAP_AUTO;
    options.tileable = OSDTEX_TILEABLE_KEEP;
    options.height_middle = 0.5;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_exemplar_options_init(osdtex_exemplar_options *out, size_t bytes);

typedef struct osdtex_exemplar_info
{
    const char *path;         /* as given, NULL when made from an image */
    const char *hash;         /* of the file's bytes, NULL likewise */
    const char *type;         /* "8-bit", "half", …; NULL likewise */
    const char *source_space; /* as resolved */
    const char *linear_space;
    const char *match_space;
    const char *embedding;
    int32_t width;
    int32_t height;
    int32_t channels; /* of `pixels`: 3 or 4 */
    int32_t wrap_x;   /* 1: tiles left to right */
    int32_t wrap_y;
    int32_t made_tileable; /* 1: the pixels are not those of the file */
    const float *pixels;   /* in linear_space, bottom row first */
    int32_t source_width;  /* of the picture whose width a scale means:
                            * as read, before it was cropped to be made to
                            * tile, or the one tiles were made of */
    int32_t tile_size;     /* texels; 0: this is no tiled texture */
    uint32_t maps;         /* bit k: there is a map of kind k */
    int32_t slices;        /* of a stack; 0: this is none */
} osdtex_exemplar_info;

/* Reads EXR, PNG, TIFF or JPEG, told by content. FORMAT, SUPPORT, LIMIT,
 * NUMERIC (a pixel that is not finite), COLOUR, IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_exemplar_read(
    osdtex_context *context, const char *path,
    const osdtex_exemplar_options *options, osdtex_exemplar **out);
/* The same from pixels, which are scene-linear unless `from` says else. */
OSDTEX_API osdtex_status osdtex_exemplar_create(
    osdtex_context *context, const osdtex_image *image,
    const osdtex_exemplar_options *options, osdtex_exemplar **out);
OSDTEX_API const osdtex_exemplar_info *
osdtex_exemplar_describe(const osdtex_exemplar *exemplar);

/* Length of leaf edges, in scene units, that suits the exemplar when its width
 * covers `scale` scene units: 14 texels, but a 48th of the shorter side at most
 * and a 128th at least. Seams run along leaf edges. */
OSDTEX_API double
osdtex_exemplar_leaf_edge(const osdtex_exemplar *exemplar, double scale);

/* Whether an exemplar has a direction, or a lattice. */
typedef struct osdtex_exemplar_structure
{
    const char *name; /* "isotropic", "directional", "weak-lattice",
                       * "lattice" */
    int32_t symmetry; /* turns by 360 / symmetry degrees look the same: 1,
                       * 2, 4; 0: all turns do */
    int32_t reserved;
    double angle;         /* of its direction, radians */
    double generators[4]; /* of a lattice, texels; else 0 */
    double coherence;     /* of direction, 0 .. 1 */
    double regularity;    /* of the lattice that fits best, 0 .. 1 */
} osdtex_exemplar_structure;

/* ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_exemplar_analyse(
    osdtex_context *context, const osdtex_exemplar *exemplar,
    osdtex_exemplar_structure *out);
OSDTEX_API void osdtex_exemplar_destroy(osdtex_exemplar *exemplar);

OSDTEX_END_DECLS

#endif

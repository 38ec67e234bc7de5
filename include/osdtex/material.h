/* material.h -- the files of a material: its colour and what else is known of
 * it, texel by texel.
 *
 *     osdtex_exemplar_options options = osdtex_exemplar_options_default();
 *     const osdtex_material_info *info;
 *     osdtex_material *material;
 *
 *     osdtex_material_find(context, "textures/bricks", &material);
 *     info = osdtex_material_describe(material);
 *     options.maps = info->maps;
 *     options.map_count = info->map_count;
 *     osdtex_exemplar_read(context, info->color, &options, &exemplar);
 *     osdtex_material_destroy(material);
 *
 * Names are looked at; only of an EXR with layers the header is read. A handle
 * is immutable. A host that has the pixels gives them itself:
 *
 *     const osdtex_companion height = {
 *         .kind = OSDTEX_MAP_HEIGHT, .image = heights};
 *
 *     options.maps = &height;
 *     options.map_count = 1;
 *     osdtex_exemplar_create(context, image, &options, &exemplar); */
#ifndef OSDTEX_MATERIAL_H
#define OSDTEX_MATERIAL_H

#include <osdtex/image.h>

OSDTEX_BEGIN_DECLS

/* What a map says. All are data, which no colour is made of. */
typedef int32_t osdtex_map_kind;
enum
{
    OSDTEX_MAP_NORMAL = 0,
    OSDTEX_MAP_ROUGHNESS = 1,
    OSDTEX_MAP_HEIGHT = 2,
    OSDTEX_MAP_METALNESS = 3,
    OSDTEX_MAP_OCCLUSION = 4,
    OSDTEX_MAP_KINDS = 5
};

/* A map that lies on an exemplar's picture: of its size, or a whole number of
 * times as large or as small. */
typedef struct osdtex_companion
{
    const char *path; /* NULL with an image */
    osdtex_map_kind kind;
    int32_t channel;   /* of the file, from 0: red; of normals the first of
                        * three */
    int32_t y_down;    /* of normals: 1 where green points down, as DirectX has
                        * it */
    int32_t inverted;  /* 1: it is 1 less what the file says, as gloss is to
                        * roughness */
    const char *layer; /* of an EXR, by name; NULL: as a picture is read */
    /* Pixels instead of a file, which are copied: numbers as a file of floats
     * has them. Of normals (n + 1) / 2, or where any is negative n itself; one
     * or two channels are grey. A mapping of them cannot be saved, which names
     * files. */
    const osdtex_image *image;
} osdtex_companion;

/* "normal", "roughness", "height", "metalness", "occlusion", as files are
 * called; NULL for no kind. */
OSDTEX_API const char *osdtex_map_kind_name(osdtex_map_kind kind);

typedef struct osdtex_material osdtex_material;

/* What is read as an exemplar: the colour, and beside it the maps. */
typedef struct osdtex_material_info
{
    const char *color;
    const osdtex_companion *maps; /* [map_count] */
    int32_t map_count;
    int32_t reserved;
    const char *color_layer; /* of an EXR: what `layer` of the exemplar is to
                              * be; NULL: as pictures are read */
} osdtex_material_info;

/* Finds the files of a material by their names (docs/materials.md).
 *
 *   text  a folder, or FOLDER/PREFIX with what their names begin with, or an
 *         EXR of which the layers are called so
 *
 * IO (no such folder), FORMAT (no colour, or two files that could be one map),
 * ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_material_find(
    osdtex_context *context, const char *text, osdtex_material **out);
OSDTEX_API const osdtex_material_info *
osdtex_material_describe(const osdtex_material *material);
OSDTEX_API void osdtex_material_destroy(osdtex_material *material);

OSDTEX_END_DECLS

#endif

/* bake.h -- the cage with textures on its UVs, as files.
 *
 *     osdtex_bake_options options = osdtex_bake_options_default();
 *
 *     options.resolution = 2048;
 *     options.extras = OSDTEX_BAKE_UV;
 *     osdtex_bake(context, mapping, "out/shirt.obj", &options);
 *
 * The same into memory is textures.h.
 *
 * Textures are made in blocks as they are written, on all threads, so that none
 * is in memory as a whole: 4096 x 4096 texels with all mip levels take some 6
 * seconds of processor time (docs/notes/bake.md). Files are the same bytes for
 * any number of threads. */
#ifndef OSDTEX_BAKE_H
#define OSDTEX_BAKE_H

#include <osdtex/mapping.h>

OSDTEX_BEGIN_DECLS

/* Onto which texture coordinates a mapping is baked. */
typedef int32_t osdtex_bake_uvs;
enum
{
    OSDTEX_BAKE_UVS_AUTO = 0,  /* the cage's where they can be baked onto: on
                                * UDIM tiles, with area, not on top of each
                                * other; else an atlas, and a finding */
    OSDTEX_BAKE_UVS_OWN = 1,   /* the cage's, on UDIM tiles */
    OSDTEX_BAKE_UVS_ATLAS = 2, /* a block for every face of the cage */
    OSDTEX_BAKE_UVS_CHARTS = 3 /* faces of the cage in few islands that lie
                                * flat, for painters */
};

/* What is baked besides the colour, as 32-bit NAME_patch.<UDIM>.exr and so on:
 * values at the texel's centre, never averaged; but for the source, blue is 1
 * on the surface and 0 beyond. */
enum
{
    OSDTEX_BAKE_PATCH = 1,   /* number of the patch, face of the cage */
    OSDTEX_BAKE_UV = 2,      /* UV in the exemplar */
    OSDTEX_BAKE_STRETCH = 4, /* L2 stretch, ratio of the axes; 1 is none */
    OSDTEX_BAKE_SEAM = 8,    /* 1 where patches meet */
    OSDTEX_BAKE_SOURCE = 16, /* all that another picture of the exemplar's size
                              * is baked by: R the exemplar, G and B its UV, A
                              * the footprint, the side of a square as large
                              * as the texel there, in widths of the exemplar;
                              * beyond the surface, too */
    OSDTEX_BAKE_SLICE = 32   /* place along the axis of a stack, 0 to 1 */
};

/* Which axis points up in the scene. Nothing is turned. */
typedef int32_t osdtex_up_axis;
enum
{
    OSDTEX_UP_Y = 0,
    OSDTEX_UP_Z = 1
};

typedef struct osdtex_bake_options
{
    size_t size;
    const char *const *comments; /* [comment_count] lines for the texts */
    int32_t comment_count;
    osdtex_bake_uvs uvs;
    int32_t resolution;          /* texels of a tile's side, up to 32768 */
    int32_t margin;              /* texels continued beyond the rims of charts;
                                  * of an atlas 4, 8, 16, 32 or 64; 0 chooses */
    double texels_per_unit;      /* of an atlas; 0: what fills one tile */
    double seam_blend;           /* texels over which patches are blended */
    uint32_t extras;             /* OSDTEX_BAKE_PATCH | … */
    int32_t preview_png;         /* 1: also NAME.<UDIM>.png, at most 1024 texels
                                  * a side, and NAME_preview.mtl */
    const char *texture_comment; /* for the headers of textures; NULL */
    /* Not NULL: with the bake, what osdtex_mapping_write() writes. */
    const osdtex_write_options *mesh;
    int32_t udim;           /* bake this tile only; 0 all */
    osdtex_up_axis up_axis; /* of the scene, for NAME.usda */
    double meters_per_unit; /* of a scene unit, for NAME.usda; 0: 1 where the
                             * textures are for Blender or Houdini, else 0.01,
                             * as USD takes what says nothing */
    int32_t normals;        /* 1: those of the limit in NAME_cage.obj; of a
                             * plain mesh in NAME.usda, too */
    int32_t reserved;
} osdtex_bake_options;

static inline osdtex_bake_options
osdtex_bake_options_default(void)
{
    osdtex_bake_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.uvs = OSDTEX_BAKE_UVS_AUTO;
    options.resolution = 4096;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_bake_options_init(osdtex_bake_options *out, size_t bytes);

/* Bakes a mapping into textures of the cage: NAME_cage.obj and NAME_cage.mtl,
 * NAME.<UDIM>.exr (1001 for the unit square), NAME.usda and NAME.mtlx, all or
 * none of them. `path` is FOLDER/NAME.obj; that file itself is written only
 * where options->mesh asks for it. ARGUMENT (no such tile), IO, TOPOLOGY (own
 * UVs are asked for that cannot be baked onto), LIMIT, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_bake(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path,
    const osdtex_bake_options *options);

OSDTEX_END_DECLS

#endif

/* look.h -- a baked cage as files that load in the DCC.
 *
 *     NAME_cage.obj, NAME_cage.mtl   the artist's cage with the coordinates of
 *                                    the bake
 *     NAME.1001.exr, …               its textures, one a UDIM tile
 *     NAME.usda, NAME.mtlx           the same cage and look with what OBJ and
 *                                    MTL cannot say
 *
 *     NAME_normal.1001.exr, …       the other maps of the exemplars' materials
 *
 * and on request NAME.1001.png with NAME_preview.mtl for what reads no EXR, and
 * NAME_patch.1001.exr and the like. All of them appear together or not at all.
 * See docs/notes/bake.md and docs/pipeline.md. */
#ifndef OTX_EXPORT_LOOK_H
#define OTX_EXPORT_LOOK_H

#include "bake/bake.h"
#include "export/model.h"

typedef struct otx_look_options
{
    const char *path;                  /* FOLDER/NAME.obj */
    double seam_blend;                 /* see bake.h */
    bool extras[OTX_TEXEL_KIND_COUNT]; /* what is baked besides the colour */
    const otx_colour *colour;          /* for the preview; NULL: no preview */
    int32_t udim;                      /* bake this tile only; 0 all */
    const char *texture_comment;       /* for the textures; NULL none */
    double meters_per_unit;            /* of NAME.usda; 0: by the receiver */
    bool z_up;                         /* of NAME.usda */
    bool normals; /* of the limit surface in NAME_cage.obj, and of a plain mesh
                   * in NAME.usda; those of the mesh are mesh->normals */
    /* What is written of the refined mesh, together with the rest; its path and
     * set are given here. NULL: nothing. */
    const otx_model_options *mesh;
    /* [cage vert_count * 3] points that the mapping was made for, for
     * NAME.usda; NULL: those of its cage. */
    const float *rest;
    int32_t comment_count; /* of the texts, without "# " */
    const char *const *comments;
} otx_look_options;

/* Bakes `mapping` onto `layout` and writes all files. ARGUMENT, IO, NUMERIC,
 * MEMORY, CANCELLED. */
otx_status otx_look_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, const otx_look_options *options);

#endif

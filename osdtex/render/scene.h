/* scene.h -- what a picture is made of, as plain arrays.
 *
 * A scene is a view: it borrows every array, so that a mapping and a model
 * read back from a file are shown by the same code. Zero-initialise it, set
 * what is there, leave the rest NULL. */
#ifndef OTX_RENDER_SCENE_H
#define OTX_RENDER_SCENE_H

#include "exemplar/exemplar.h"
#include "mapping/map_textures.h"
#include "mapping/show.h"

/* Scene-linear pixels; 1 and 2 channels are grey, alpha is not looked at. */
typedef struct otx_scene_texture
{
    otx_image image;
    bool wrap_x, wrap_y;               /* tiles, else the border is held */
    const otx_exemplar_slices *slices; /* of a stack; NULL */
} otx_scene_texture;

typedef struct otx_scene
{
    int32_t vert_count, face_count, corner_count;
    const float *points;       /* [vert_count * 3], scene units */
    const int32_t *face_first; /* [face_count + 1], offsets into corners */
    const int32_t *face_verts; /* [corner_count], counter-clockwise outside */
    const uint8_t *face_hole;  /* [face_count], 1 is not drawn; NULL none */

    const float *uvs; /* [corner_count * 2], NULL: no texture is shown */
    const otx_lookups *lookups; /* of faces that show several; NULL nowhere */
    const otx_source_field *field; /* of faces made by texels; NULL nowhere */
    const float *along;       /* [vert_count] in stacks; NULL: there is none */
    const otx_decals *decals; /* over all of it; NULL none */
    /* Smooth normals, any length: per corner before per vertex; with neither,
     * faces are flat. */
    const float *corner_normals; /* [corner_count * 3] or NULL */
    const float *vert_normals;   /* [vert_count * 3] or NULL */

    int32_t texture_count;
    const otx_scene_texture *textures; /* [texture_count] */
    /* Of the same pictures as the textures, carried over where the scene is of
     * a mapping; NULL: matte colours. */
    const otx_map_textures *maps;
    const int32_t
        *face_texture; /* [face_count], -1 none; NULL: all the first */

    const int32_t *face_root; /* [face_count] which face of the cage each is a
                               * part of; NULL: each one is its own */
    /* Shown as colours. NULL: patches are the islands of the UVs. */
    const int32_t *face_patch; /* [face_count] */
    /* Distortion, 1 is none. NULL: see render/distortion.h. */
    const float *face_stretch; /* [face_count] */
    /* How far what a face shows is from the exemplar, 1 is usual; below 0: not
     * known. NULL: of none. */
    const float *face_windows; /* [face_count] */
} otx_scene;

/* Sets vert_normals to the mean of the faces around each vertex, weighted by
 * area, in run->arena. Where a face departs from them it is shown flat, so
 * sharp edges stay sharp. MEMORY. */
otx_status otx_scene_smooth(otx_run *run, otx_scene *scene);

/* Refuses what would be read out of bounds or cannot be traced: no face to
 * draw, a face of fewer than three corners, an index out of range, a position
 * or UV that is not finite. ARGUMENT or NUMERIC, with the face. */
otx_status otx_scene_validate(otx_run *run, const otx_scene *scene);

/* Centre of the bounding box of what is drawn, and the radius around it that
 * holds everything. */
void otx_scene_bounds(const otx_scene *scene, otx_vec3 *centre, double *radius);

static inline bool
otx_scene_is_hole(const otx_scene *scene, int32_t face)
{
    return scene->face_hole && scene->face_hole[face];
}

#endif

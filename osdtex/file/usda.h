/* usda.h -- a subdivision cage and its look as a USD text file.
 *
 * One Mesh with everything that OBJ cannot say (scheme, creases, corners,
 * holes, how UVs are smoothed), one UsdPreviewSurface with its textures. USD's
 * library is not needed: the text format is plain. */
#ifndef OTX_FILE_USDA_H
#define OTX_FILE_USDA_H

#include "file/data_maps.h"

#include "base/run.h"

/* Faces that belong together under a name. */
typedef struct otx_usda_subsets
{
    int32_t count;
    const char *const *names;  /* [count], verbatim */
    const int32_t *face_names; /* [face_count], -1 none; NULL: no subsets */
} otx_usda_subsets;

typedef struct otx_usda
{
    const char *name; /* of the model; made an identifier */
    /* Tokens of UsdGeomMesh. */
    const char *scheme;    /* "catmullClark", "loop", "bilinear", "none" */
    const char *boundary;  /* "none", "edgeOnly", "edgeAndCorner" */
    const char *fvar;      /* "none", "cornersOnly", … "all" */
    const char *triangles; /* "catmullClark", "smooth" */

    int32_t vert_count, face_count, corner_count, uv_count;
    const float *points;       /* [vert_count * 3], relative to `origin` */
    const float *rest;         /* likewise, as it was mapped; NULL: as it is */
    double origin[3];          /* the mesh is moved there; as a rule zero */
    const int32_t *face_first; /* [face_count + 1] */
    const int32_t *face_verts; /* [corner_count] */
    const float *normals;      /* by face_normals; NULL none */
    const int32_t *face_normals; /* [corner_count] */
    const float *uvs;            /* [uv_count * 2] */
    const int32_t *face_uvs;     /* [corner_count] */
    const float *slices; /* [corner_count] of a stack, where along its axis;
                          * NULL none */

    int32_t crease_count, corner_tag_count;
    const int32_t *crease_verts;   /* [crease_count * 2] */
    const float *crease_sharpness; /* [crease_count], 10 is infinite */
    const int32_t *corner_tag_verts;
    const float *corner_tag_sharpness;
    const uint8_t *face_hole; /* [face_count] or NULL */
    otx_usda_subsets groups;
    otx_usda_subsets materials; /* of which each face has one; all have the
                                 * look, so that they may be told apart */

    double meters_per_unit; /* positive */
    bool z_up;              /* else y is up */
    const char *texture; /* file name relative to this one; may hold <UDIM> */
    const char *interop_id; /* colorInteropID of its pixels; NULL unknown */
    const char *materialx;  /* file name of the same look; NULL none */
    otx_data_maps maps;     /* what else is known of the material */
    /* What all materials but the first show, cut out by its alpha: they lie
     * over one another in their order. NULL: all have the one look. */
    const char *overlay;
    otx_data_maps overlay_maps;
    const char *const *comments; /* [comment_count], without `#` */
    int32_t comment_count;
} otx_usda;

/* Writes `usda` to `path`; `title` is for messages (NULL: the path). ARGUMENT
 * when a number is not finite, IO, MEMORY. */
otx_status otx_usda_write(
    otx_run *run, const otx_usda *usda, const char *path, const char *title);

#endif

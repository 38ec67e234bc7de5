/* cage.h -- the artist's control mesh, validated.
 *
 * Everything that OpenSubdiv would crash on or silently swallow is refused
 * here, with file, line and face. Order of vertices and faces is the file's.
 * Edges are manifold (one or two faces, consistent winding) and so are
 * vertices; see the list of checks in docs/notes/cage.md. */
#ifndef OTX_SURFACE_CAGE_H
#define OTX_SURFACE_CAGE_H

#include "base/run.h"

typedef enum otx_scheme
{
    OTX_SCHEME_CATMARK,
    OTX_SCHEME_LOOP,
    OTX_SCHEME_BILINEAR,
    OTX_SCHEME_NONE /* a plain mesh: one level, positions as they are */
} otx_scheme;

/* USD's interpolateBoundary; the default is EDGE_AND_CORNER. */
typedef enum otx_boundary
{
    OTX_BOUNDARY_NONE,
    OTX_BOUNDARY_EDGE_ONLY,
    OTX_BOUNDARY_EDGE_AND_CORNER
} otx_boundary;

/* USD's faceVaryingLinearInterpolation; the default is CORNERS_PLUS1. */
typedef enum otx_fvar
{
    OTX_FVAR_NONE,
    OTX_FVAR_CORNERS_ONLY,
    OTX_FVAR_CORNERS_PLUS1,
    OTX_FVAR_CORNERS_PLUS2,
    OTX_FVAR_BOUNDARIES,
    OTX_FVAR_ALL
} otx_fvar;

typedef struct otx_cage
{
    const char *path; /* for messages; NULL when made from arrays */
    otx_scheme scheme;
    otx_boundary boundary;
    otx_fvar fvar;
    bool crease_chaikin;   /* crease method: uniform (false) or Chaikin */
    bool triangles_smooth; /* Catmull-Clark triangle rule */

    int32_t vert_count, face_count, corner_count;
    const float *points;       /* [vert_count * 3], scene units */
    const float *colors;       /* [vert_count * 3] or NULL */
    const int32_t *face_first; /* [face_count + 1], offsets into corners */
    const int32_t *face_verts; /* [corner_count] */

    int32_t uv_count;        /* 0: the cage has no UVs */
    const float *uvs;        /* [uv_count * 2] */
    const int32_t *face_uvs; /* [corner_count] or NULL; every corner has one */

    int32_t crease_count;
    const int32_t *crease_verts;   /* [crease_count * 2], existing edges */
    const float *crease_sharpness; /* [crease_count], (0, 10] */
    int32_t corner_tag_count;
    const int32_t *corner_tag_verts; /* [corner_tag_count] */
    const float *corner_tag_sharpness;
    const uint8_t *face_hole; /* [face_count], 1 hole */

    /* Carried through to the output, per face: index into the name tables,
     * -1 none. Names are verbatim. */
    int32_t group_count, object_count, material_count, smooth_count;
    const char *const *group_names;
    const char *const *object_names;
    const char *const *material_names;
    const char *const *smooth_names;
    const int32_t *face_group;
    const int32_t *face_object;
    const int32_t *face_material;
    const int32_t *face_smooth;
    int32_t library_count;
    const char *const *library_names; /* mtllib, verbatim */

    const int64_t *face_line; /* [face_count] or NULL */
    double diagonal;          /* of the bounding box of used vertices */
} otx_cage;

#endif

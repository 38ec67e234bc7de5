/* cage.h -- the artist's control mesh, validated.
 *
 * Everything that OpenSubdiv would crash on or silently swallow is refused
 * here, with file, line and face. Order of vertices and faces is the file's.
 * Edges are manifold (one or two faces, consistent winding); vertices may have
 * several fans of faces, which refinement parts (surface/pinch.h). See the list
 * of checks in docs/notes/cage.md. */
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
    const float *points;     /* [vert_count * 3], scene units */
    double origin[3];        /* what points are relative to; as a rule zero */
    const float *colors;     /* [vert_count * 3] or NULL */
    const char *point_lines; /* the file's text of them: see otx_obj; NULL
                              * none */
    size_t point_line_bytes;
    const int32_t *face_first; /* [face_count + 1], offsets into corners */
    const int32_t *face_verts; /* [corner_count] */
    int32_t split_count; /* fans of faces beyond the first of a vertex: how
                          * many vertices refinement adds; 0 of a plain
                          * mesh */

    int32_t uv_count;        /* 0: the cage has no UVs */
    const float *uvs;        /* [uv_count * 2] */
    const int32_t *face_uvs; /* [corner_count] or NULL; every corner has one */

    int32_t crease_count;
    const int32_t *crease_verts;   /* [crease_count * 2], existing edges */
    const float *crease_sharpness; /* [0, 10]; of an edge the last holds */
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
    int32_t edge_count;
    double mean_edge_length; /* scene units */
} otx_cage;

enum
{
    OTX_CAGE_UNSET = -1,          /* the user or the file does not say */
    OTX_CAGE_VALENCE_MAX = 46340, /* edges of a vertex, corners of a face */
    OTX_CAGE_SHARPNESS_MAX = 10   /* infinitely sharp */
};

/* A mesh as a file reader delivers it: nothing in it has been checked except
 * that the arrays are as long as said here. Indices are 0-based. Where a
 * line array is NULL, findings name no line. */
typedef struct otx_cage_input
{
    const char *path; /* NULL none */

    int32_t vert_count, face_count, uv_count;
    const float *points;     /* [vert_count * 3] */
    double origin[3];        /* scene units; added to the points */
    const float *colors;     /* [vert_count * 3] or NULL */
    const char *point_lines; /* the file's text of the points; NULL none */
    size_t point_line_bytes;
    const int32_t *face_first; /* [face_count + 1], from 0 */
    const int32_t *face_verts; /* [corner_count = face_first[face_count]] */
    const float *uvs;          /* [uv_count * 2] */
    const int32_t *face_uvs;   /* [corner_count], -1 none; NULL: no UVs */
    const int64_t *vert_line;  /* [vert_count] or NULL, 1-based */
    const int64_t *face_line;  /* [face_count] or NULL, 1-based */

    int32_t crease_count, corner_tag_count, hole_count;
    const int32_t *crease_verts;       /* [crease_count * 2] */
    const float *crease_sharpness;     /* [crease_count] */
    const int64_t *crease_line;        /* [crease_count] or NULL */
    const int32_t *corner_tag_verts;   /* [corner_tag_count] */
    const float *corner_tag_sharpness; /* [corner_tag_count] */
    const int64_t *corner_tag_line;    /* [corner_tag_count] or NULL */
    const int32_t *hole_faces;         /* [hole_count] */
    const int64_t *hole_line;          /* [hole_count] or NULL */

    /* [vert_count] what vertices were welded to, as otx_weld_find makes it;
     * NULL before welding. */
    const int32_t *welded;

    /* What the file's tags say, OTX_CAGE_UNSET where they say nothing. */
    int32_t boundary;         /* otx_boundary */
    int32_t fvar;             /* otx_fvar */
    int32_t crease_chaikin;   /* 0 uniform, 1 Chaikin */
    int32_t triangles_smooth; /* 0 Catmull-Clark's rule, 1 smooth */

    /* As in otx_cage; a count of 0 goes with NULL, and so may -1 on all
     * faces. */
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
    const char *const *library_names;
} otx_cage_input;

/* An input that says nothing: fill in what there is. */
static inline otx_cage_input
otx_cage_input_none(void)
{
    otx_cage_input input = {0};

    input.boundary = OTX_CAGE_UNSET;
    input.fvar = OTX_CAGE_UNSET;
    input.crease_chaikin = OTX_CAGE_UNSET;
    input.triangles_smooth = OTX_CAGE_UNSET;
    return input;
}

/* What the user says. Where it is OTX_CAGE_UNSET the file's tag holds, and
 * without one USD's default: edge and corner, corners plus one, uniform
 * creases, Catmull-Clark's triangle rule. */
typedef struct otx_cage_options
{
    otx_scheme scheme;
    int32_t boundary;         /* otx_boundary */
    int32_t fvar;             /* otx_fvar */
    int32_t crease_chaikin;   /* 0 or 1 */
    int32_t triangles_smooth; /* 0 or 1 */
    double weld; /* vertices within this distance become one; 0: within
                  * OTX_WELD_SHARE of the box; negative: none */
} otx_cage_options;

static inline otx_cage_options
otx_cage_options_default(void)
{
    return (otx_cage_options){OTX_SCHEME_CATMARK, OTX_CAGE_UNSET,
                              OTX_CAGE_UNSET,     OTX_CAGE_UNSET,
                              OTX_CAGE_UNSET,     -1.0};
}

/* Checks `input` and copies it into a cage that lives in run->arena and
 * borrows nothing. Every finding is noted with file, line and face (0-based,
 * as all indices in sentences); a check looks at the whole mesh before the
 * next one starts, so like errors come with their count.
 *
 * FORMAT when an index or a number cannot be used, TOPOLOGY when the mesh is
 * not a manifold with faces, LIMIT on valence, MEMORY. */
otx_status otx_cage_build(
    otx_run *run, const otx_cage_input *input, const otx_cage_options *options,
    otx_cage *out);

#endif

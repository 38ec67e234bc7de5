/* obj.h -- what an OBJ file says, as flat arrays.
 *
 * The reader knows the format and nothing of surfaces: it resolves indices,
 * checks that they exist, and says where everything came from. Whether the
 * polygons make a surface is for surface/cage to judge. The writer takes the
 * same struct, so that writing and reading back is the identity.
 *
 * The dialect is described in docs/formats.md. */
#ifndef OTX_FILE_OBJ_H
#define OTX_FILE_OBJ_H

#include "base/run.h"

/* Names in the order of their first use, each once. They are verbatim: the
 * rest of the line without the blanks around it. */
typedef struct otx_obj_names
{
    int32_t count;
    const char *const *text; /* [count] */
} otx_obj_names;

/* Sharpness on edges or vertices. */
typedef struct otx_obj_creases
{
    int32_t count;
    const int32_t *verts;   /* edges: [count * 2]; vertices: [count] */
    const float *sharpness; /* [count], finite, as written */
    const int64_t *line;    /* [count], may be NULL for the writer */
} otx_obj_creases;

typedef enum otx_obj_crease_method
{
    OTX_OBJ_CREASE_NORMAL,
    OTX_OBJ_CREASE_CHAIKIN
} otx_obj_crease_method;

typedef enum otx_obj_triangles
{
    OTX_OBJ_TRIANGLES_CATMARK,
    OTX_OBJ_TRIANGLES_SMOOTH
} otx_obj_triangles;

/* A tag that the file gives once; of several, the last one counts. */
typedef struct otx_obj_rule
{
    int32_t value; /* -1: the file has no such tag */
    int64_t line;
} otx_obj_rule;

#define OTX_OBJ_NO_RULE ((otx_obj_rule){-1, 0})

typedef struct otx_obj
{
    const char *path; /* as given; for messages */

    int32_t vert_count, uv_count, face_count, corner_count;
    const float *points; /* [vert_count * 3], finite, relative to `origin` */
    double origin[3]; /* see file/obj_origin.h; zero unless all is far away */
    const float *colors; /* [vert_count * 3] as written, white where a vertex
                          * has none; NULL when none has */
    /* The `v` lines as the file has them, in order, each with an LF: what the
     * writer writes instead of the points, so that they stay the same bytes. A
     * line that was continued is one line. NULL: the writer prints points. */
    const char *point_lines;
    size_t point_line_bytes;
    const float *uvs;       /* [uv_count * 2], finite */
    const float *uv_depths; /* [uv_count] third coordinates that are written;
                             * NULL none */
    /* Normals are written, and passed over in reading. */
    int32_t normal_count;
    const float *normals;        /* [normal_count * 3] */
    const int32_t *face_normals; /* [corner_count], NULL none */

    const int32_t *face_first; /* [face_count + 1] */
    const int32_t *face_verts; /* [corner_count], in [0, vert_count) */
    const int32_t *face_uvs;   /* [corner_count], in [0, uv_count), or -1 at
                                * all corners of a face; the writer takes NULL
                                * for no UVs at all */
    const int64_t *face_line;  /* [face_count]; the writer does not look */

    /* Per face the index of a name, -1 before the first. The writer takes NULL
     * for an attribute that the mesh does not have. */
    const int32_t *face_group;    /* `g`; several names are one name */
    const int32_t *face_object;   /* `o` */
    const int32_t *face_material; /* `usemtl` */
    const int32_t *face_smooth;   /* `s`: "off", "1", … */
    otx_obj_names groups, objects, materials, smooths;
    otx_obj_names libraries; /* `mtllib`, one name a line */

    /* `t` lines in OpenSubdiv's grammar, and Embree's `ec`. Indices are
     * 0-based and exist; edges may not. */
    otx_obj_creases creases;
    otx_obj_creases corners;
    int32_t hole_count;
    const int32_t *hole_faces; /* [hole_count] */
    const int64_t *hole_line;  /* [hole_count] */

    otx_obj_rule boundary;      /* 0 none, 1 edge and corner, 2 edge only */
    otx_obj_rule fvar;          /* 0 none, 1 corners only, 2 corners plus 1,
                                 * 3 corners plus 2, 4 boundaries, 5 all */
    otx_obj_rule crease_method; /* otx_obj_crease_method */
    otx_obj_rule triangles;     /* otx_obj_triangles */
} otx_obj;

/* Reads `path` into run->arena. The result is valid when OSDTEX_OK comes back,
 * and untouched otherwise.
 *
 * FORMAT with file and line for what is not OBJ, IO, LIMIT, MEMORY. Elements
 * that are no polygons are ignored, one counted warning for each kind. */
otx_status otx_obj_read(otx_run *run, const char *path, otx_obj *out);

/* The same from memory; `name` stands for the path. */
otx_status otx_obj_parse(
    otx_run *run, const char *name, const char *bytes, size_t size,
    otx_obj *out);

#endif

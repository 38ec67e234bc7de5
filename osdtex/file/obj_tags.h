/* obj_tags.h -- subdivision tags in an OBJ file.
 *
 * Two dialects: OpenSubdiv's
 *
 *     t NAME INTS/FLOATS/STRINGS int… float… string…    (counted from 0)
 *
 * and Embree's `ec SHARPNESS VERTEX VERTEX` (counted from 1). The grammar is
 * in docs/formats.md. */
#ifndef OTX_FILE_OBJ_TAGS_H
#define OTX_FILE_OBJ_TAGS_H

#include "file/obj.h"
#include "file/text.h"

typedef struct otx_obj_tags_list
{
    int32_t count;
    int32_t *indices;
    float *sharpness; /* NULL for holes */
    int64_t *line;
} otx_obj_tags_list;

typedef struct otx_obj_tags
{
    otx_obj_tags_list creases, corners, holes;
    otx_obj_rule boundary, fvar, crease_method, triangles;
} otx_obj_tags;

/* Room for `values` values on all tag lines together, in run->arena. MEMORY. */
otx_status otx_obj_tags_create(otx_run *run, int64_t values, otx_obj_tags *out);

/* Reads what follows `t` in the current line. */
otx_status otx_obj_tags_read(otx_obj_tags *tags, otx_text *text);

/* Reads what follows `ec`; `verts_so_far` for relative numbers. */
otx_status otx_obj_tags_read_edge(
    otx_obj_tags *tags, otx_text *text, int32_t verts_so_far);

/* Checks that vertices and faces exist, of which `out` already has the
 * counts, and hands everything to it. */
otx_status otx_obj_tags_finish(
    const otx_obj_tags *tags, const otx_text *text, otx_obj *out);

#endif

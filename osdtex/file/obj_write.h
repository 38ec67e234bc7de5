/* obj_write.h -- a mesh to an OBJ file.
 *
 * Numbers are the shortest that read back as the same float. Group, object,
 * material and smoothing lines stand where they change. */
#ifndef OTX_FILE_OBJ_WRITE_H
#define OTX_FILE_OBJ_WRITE_H

#include "file/obj.h"

typedef struct otx_obj_write_options
{
    const char *name;            /* for messages, NULL: the path */
    const char *const *comments; /* [comment_count], without `#` */
    int32_t comment_count;
    bool tags; /* write the `t` lines, one for each crease edge */
} otx_obj_write_options;

/* Writes `obj` to `path` (as a rule the temporary of an atomic file). Names of
 * materials get `_` for blanks, as in otx_mtl_write.
 *
 * ARGUMENT when a point or UV is not finite, IO. `options` may be NULL. */
otx_status otx_obj_write(
    otx_run *run, const otx_obj *obj, const char *path,
    const otx_obj_write_options *options);

#endif

/* model.h -- a mapping as files that load in the DCC: OBJ, MTL, EXR.
 *
 * The three belong together, so they are renamed into place together: a job
 * that fails or is killed before that leaves nothing. See
 * docs/notes/render.md for how to look at them and docs/formats.md for what is
 * in them. */
#ifndef OTX_EXPORT_MODEL_H
#define OTX_EXPORT_MODEL_H

#include "image/exemplar.h"
#include "mapping/mapping.h"

typedef struct otx_model_options
{
    const char *path;   /* of the OBJ; ".obj" is required */
    bool without_image; /* neither write the EXR nor replace one */
    /* Comment lines of OBJ and MTL, without "# ". */
    int32_t comment_count;
    const char *const *comments;
} otx_model_options;

/* What was written; strings in run->arena. */
typedef struct otx_model_files
{
    const char *obj, *mtl, *exr; /* paths; exr NULL when not written */
    int64_t uv_count;            /* of the OBJ's vt lines */
} otx_model_files;

/* Writes the leaf level of `mapping` on the limit surface as NAME.obj, its
 * materials as NAME.mtl, the exemplar as NAME.exr.
 *
 * Vertices and faces keep their order: faces are the children of cage face 0,
 * of cage face 1, …; holes are left out, vertices that no face uses stay.
 * Equal UVs of a vertex share one `vt`. Groups, objects, smoothing and
 * materials of the cage are carried; where the cage names no material the name
 * is NAME. Spaces in NAME become `_` in the MTL's and EXR's names, with a
 * warning, because readers split there.
 *
 * ARGUMENT for a path that is not an OBJ's, IO, LIMIT, MEMORY. */
otx_status otx_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_model_options *options, otx_model_files *out);

#endif

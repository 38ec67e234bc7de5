/* model.h -- a mapping as files that load in the DCC: OBJ, MTL, EXR.
 *
 * The three belong together, so they are renamed into place together: a job
 * that fails or is killed before that leaves nothing. See
 * docs/notes/render.md for how to look at them and docs/formats.md for what is
 * in them. */
#ifndef OTX_EXPORT_MODEL_H
#define OTX_EXPORT_MODEL_H

#include "exemplar/exemplar.h"
#include "file/atomic_file.h"
#include "mapping/mapping.h"

typedef struct otx_model_options
{
    const char *path;   /* of the OBJ; ".obj" is required */
    bool normals;       /* `vn` too: see export/corner_normals.h */
    bool without_image; /* leave NAME.exr as it is; the MTL names it still */
    bool pastes;        /* as a run-time list: see export/paste_model.h */
    int32_t resolution; /* of the texture of pastes, 0: of their density */
    /* NULL: the files are put into place at once. Else they join this set,
     * which the caller commits with whatever else belongs to the job. */
    otx_atomic_file_set *set;
    /* Comment lines of the OBJ, without "# ". */
    int32_t comment_count;
    const char *const *comments;
} otx_model_options;

/* What was written; strings in run->arena. */
typedef struct otx_model_files
{
    const char *obj, *mtl, *exr; /* paths; exr, of the first exemplar, NULL when
                                  * not written */
    int64_t uv_count;            /* of the OBJ's vt lines */
} otx_model_files;

/* Writes the leaf level of `mapping` on the limit surface as NAME.obj, its
 * materials as NAME.mtl, the exemplar as NAME.exr; several exemplars as
 * NAME_1.exr and so on. A mapping of pastes over one another is baked instead:
 * its UVs are those of an atlas, whose texture NAME.exr is.
 *
 * Vertices and faces keep their order: faces are the children of cage face 0,
 * of cage face 1, …; holes are left out, vertices that no face uses stay.
 * Equal UVs of a vertex share one `vt`. Groups, objects, smoothing and
 * materials of the cage are carried; where the cage names no material the name
 * is NAME; all of them show the same texture. A material has one texture: where
 * its faces show several, those of the most common one keep its name, others
 * get a number behind it; NAME always does. See export/names.h for NAMEs that
 * readers would split.
 *
 * ARGUMENT for a path that is not an OBJ's or UVs that are not finite, SUPPORT
 * for a list of pastes of a mapping that has none, IO, MEMORY. */
otx_status otx_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_model_options *options, otx_model_files *out);

#endif

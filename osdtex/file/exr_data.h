/* exr_data.h -- the layers of an EXR that hold numbers.
 *
 * A layer is what the names of its channels begin with, "normal" of normal.X,
 * normal.Y, normal.Z; a part's name stands before it. A channel that is none of
 * R, G, B, A, X, Y, Z and V by its last word is a layer by itself. */
#ifndef OTX_FILE_EXR_DATA_H
#define OTX_FILE_EXR_DATA_H

#include "file/exr_layer.h"

typedef struct otx_exr_data_list
{
    int32_t count;
    const char **names; /* [count], each once, in the order of the file */
} otx_exr_data_list;

/* Whether the file begins as EXRs do, whatever it is called. */
bool otx_exr_data_is_there(const char *path);

/* All layers of the file at `path`, in run->arena; "" are plain channels of a
 * part without a name. IO, FORMAT, MEMORY. */
otx_status
otx_exr_data_list_read(otx_run *run, const char *path, otx_exr_data_list *out);

/* The layer `wanted`, by its whole name: three channels R, G, B or X, Y, Z, or
 * one. False when there is none, or memory is out (run->arena tells). */
bool otx_exr_data_find(
    otx_run *run, exr_const_context_t file, const char *wanted,
    otx_exr_layer *out);

#endif

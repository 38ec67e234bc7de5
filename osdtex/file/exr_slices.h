/* exr_slices.h -- whether an EXR is a stack. */
#ifndef OTX_FILE_EXR_SLICES_H
#define OTX_FILE_EXR_SLICES_H

#include "base/run.h"

enum
{
    OTX_EXR_SLICES_MAX = 512,
    OTX_EXR_SLICE_NAME_BYTES = 16
};

/* How many parts m000, m001, ... the file at `path` has; 0 where it has fewer
 * than two of them, or is no EXR that can be read: who reads it then says why.
 */
int32_t otx_exr_slice_count(const char *path);

/* Whether the file has a part of that name; false where it cannot be read. */
bool otx_exr_part_is_there(const char *path, const char *name);

/* The name of the part with slice `index`. */
void
otx_exr_slice_name(int32_t index, char name[static OTX_EXR_SLICE_NAME_BYTES]);

/* The name of the part with its map of the kind that is called `map`. */
void otx_exr_slice_map_name(
    const char *map, int32_t index, char name[static OTX_EXR_SLICE_NAME_BYTES]);

#endif

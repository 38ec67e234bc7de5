/* exemplar_slices.h -- the pictures of a stack, for its exemplar. */
#ifndef OTX_API_EXEMPLAR_SLICES_H
#define OTX_API_EXEMPLAR_SLICES_H

#include "api/call.h"
#include "exemplar/exemplar.h"
#include "file/exr_slices.h"

enum
{
    OTX_SLICE_MAP_BYTES = OTX_EXR_SLICE_NAME_BYTES
};

/* The maps of one slice, as an exemplar's. */
typedef struct otx_slice_maps
{
    osdtex_companion list[OTX_COMPANION_COUNT];
    char names[OTX_COMPANION_COUNT][OTX_SLICE_MAP_BYTES];
    int32_t count;
} otx_slice_maps;

/* Those of slice `index` that the stack at `path`, which is borrowed, has. */
void
otx_exemplar_slices_maps(const char *path, int32_t index, otx_slice_maps *out);

/* Reads slices 0 .. count - 1 of the stack at `path` in the way that `how`
 * built `like`, the exemplar of one of them, and their maps where `options`
 * names those of this file. ARGUMENT where a slice has another
 * size, IO, FORMAT, MEMORY. */
otx_status otx_exemplar_slices_read(
    otx_call *call, const char *path, int32_t count,
    const otx_exemplar_input *how, const osdtex_exemplar_options *options,
    const otx_exemplar *like, const otx_exemplar_slices **out);

#endif

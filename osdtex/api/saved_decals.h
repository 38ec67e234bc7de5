/* saved_decals.h -- what is placed over a mapping, as arrays of a saved one. */
#ifndef OTX_API_SAVED_DECALS_H
#define OTX_API_SAVED_DECALS_H

#include "api/saved_about.h"
#include "file/tensors.h"
#include "mapping/mapping.h"

/* Arrays of eight bytes an element, of floats, and of whole numbers; nothing
 * where nothing is placed. MEMORY. */
void otx_saved_decals_add_offsets(const otx_mapping *m, otx_tensors *out);
otx_status otx_saved_decals_add_reals(
    otx_run *run, const otx_mapping *m, otx_tensors *out);
otx_status otx_saved_decals_add_numbers(
    otx_run *run, const otx_mapping *m, otx_tensors *out);

/* The decals of a file, in run->arena, but for their pictures; NULL in `*out`
 * where there are none. `*damaged` says what does not hold, NULL
 * where all does. MEMORY. */
otx_status otx_saved_decals_join(
    otx_run *run, const otx_tensors *from, const otx_level *leaf,
    int32_t picture_count, otx_decals **out, const char **damaged);

#endif

/* saved_lookups.h -- faces that show several places at once, as arrays of a
 * saved mapping. */
#ifndef OTX_API_SAVED_LOOKUPS_H
#define OTX_API_SAVED_LOOKUPS_H

#include "file/tensors.h"
#include "mapping/mapping.h"

/* Adds the arrays of type I64, F32 and I32, which have to stand among others of
 * their size; none where there are no lookups. SUPPORT where a fragment has a
 * mask, MEMORY. */
void
otx_saved_lookups_add_offsets(const otx_mapping *mapping, otx_tensors *out);
otx_status otx_saved_lookups_add_reals(
    otx_run *run, const otx_mapping *mapping, otx_tensors *out);
otx_status otx_saved_lookups_add_numbers(
    otx_run *run, const otx_mapping *mapping, otx_tensors *out);

/* Puts the lookups of a file into mapping->lookups, which borrows some of the
 * arrays; NULL where there are none.
 *
 *   damaged  out: what does not hold of them, NULL
 *
 * MEMORY. */
otx_status otx_saved_lookups_join(
    otx_run *run, const otx_tensors *from, otx_layering layering,
    int32_t exemplar_count, otx_mapping *mapping, const char **damaged);

#endif

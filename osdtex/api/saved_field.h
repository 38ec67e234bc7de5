/* saved_field.h -- what was made texel by texel, as arrays of a saved mapping.
 */
#ifndef OTX_API_SAVED_FIELD_H
#define OTX_API_SAVED_FIELD_H

#include "file/tensors.h"
#include "mapping/mapping.h"

/* Adds the arrays of type F32 and those of type I32, which have to stand among
 * others of their type; none where there is no field. MEMORY. */
void otx_saved_field_add_reals(const otx_mapping *mapping, otx_tensors *out);
otx_status otx_saved_field_add_numbers(
    otx_run *run, const otx_mapping *mapping, otx_tensors *out);

/* Puts the field of a file into mapping->field, which borrows the arrays; NULL
 * where there is none.
 *
 *   unit     [exemplar_count] UV of a texel of each
 *   damaged  out: what does not hold of it, NULL
 *
 * MEMORY. */
otx_status otx_saved_field_join(
    otx_run *run, const otx_tensors *from, const otx_vec2 *unit,
    int32_t exemplar_count, otx_mapping *mapping, const char **damaged);

#endif

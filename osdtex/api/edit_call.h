/* edit_call.h -- edits of mappings: constraints that act on an area alone. */
#ifndef OTX_API_EDIT_CALL_H
#define OTX_API_EDIT_CALL_H

#include "api/handle.h"

/* The constraints of a set that are asked for when a mapping is made, without
 * those of edits. `*out` is `set` itself where it has none. ARGUMENT where an
 * edit has so large a number that none could follow; MEMORY. */
otx_status otx_edit_call_base(
    otx_run *run, const otx_constraint_set *set,
    const otx_constraint_set **out);

/* A set that shares nothing with the one that it is made from, in run->arena.
 *
 *   from   NULL: an empty one
 *   room   for so many constraints more
 *   items  out: its constraints
 *
 * MEMORY. */
otx_status otx_edit_call_copy(
    otx_run *run, const otx_constraint_set *from, int32_t room,
    otx_constraint_set **out, otx_constraint **items);

/* Applies the edits of `set` from number `first` on to handle->mapping, one
 * after the other, and keeps the set as what was asked for. */
otx_status otx_edit_call_apply(
    otx_run *run, const otx_constraint_set *set, int32_t first,
    osdtex_mapping *handle);

#endif

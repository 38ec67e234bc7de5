/* saved_items.h -- what several places of a picture show on a face, as arrays
 * of a saved mapping: lookups of the mapping itself, and decals over it. */
#ifndef OTX_API_SAVED_ITEMS_H
#define OTX_API_SAVED_ITEMS_H

#include "file/tensors.h"
#include "mapping/mapping.h"

/* Under which names. */
typedef struct otx_saved_names
{
    const char *first;    /* I64 [face_count + 1] */
    const char *values;   /* F32 [count, 3] uv and weight */
    const char *fragment; /* I32 [count] */
} otx_saved_names;

/* ---- saving ---- */

/* Adds one of the arrays, in the order of types in which a file has them. NULL
 * for `lookups`: none is added. MEMORY. */
void otx_saved_items_add_first(
    const otx_lookups *lookups, const otx_level *leaf,
    const otx_saved_names *names, otx_tensors *out);
otx_status otx_saved_items_add_values(
    otx_run *run, const otx_lookups *lookups, const otx_level *leaf,
    const otx_saved_names *names, otx_tensors *out);
otx_status otx_saved_items_add_fragments(
    otx_run *run, const otx_lookups *lookups, const otx_level *leaf,
    const otx_saved_names *names, otx_tensors *out);

/* ---- reading ---- */

/* The arrays of a file; NULL where they are not there, or of another shape. */
typedef struct otx_saved_items
{
    const int64_t *first;
    const float *values;
    const int32_t *fragment;
    int64_t count;
} otx_saved_items;

otx_saved_items otx_saved_items_find(
    const otx_tensors *from, const otx_level *leaf,
    const otx_saved_names *names);

/* What does not hold of them; NULL.
 *
 *   least  number that a fragment may have: 0, or -1 where there may be none
 *   fragments  how many there are */
const char *otx_saved_items_wrong(
    const otx_saved_items *items, const otx_level *leaf, int32_t least,
    int64_t fragments);

/* Of what holds. In run->arena. MEMORY. */
otx_status otx_saved_items_join(
    otx_run *run, const otx_saved_items *items, const otx_lookup **out);

#endif

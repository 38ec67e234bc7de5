/* obj_names.h -- a table of names, each once, in the order of first use. */
#ifndef OTX_FILE_OBJ_NAMES_H
#define OTX_FILE_OBJ_NAMES_H

#include "file/obj.h"
#include "file/text.h"

typedef struct otx_obj_names_table
{
    int32_t count;
    const char **text;  /* [capacity], in run->arena */
    int32_t *slots;     /* [slot_mask + 1], -1 free; in run->scratch */
    uint32_t slot_mask; /* a power of two, less one */
} otx_obj_names_table;

/* A table that `capacity` different names fit into. MEMORY. */
otx_status
otx_obj_names_create(otx_run *run, int32_t capacity, otx_obj_names_table *out);

/* *index of `name`, which is added if it is new; -1 for an empty name. */
otx_status otx_obj_names_add(
    otx_run *run, otx_obj_names_table *table, otx_token name, int32_t *index);

otx_obj_names otx_obj_names_view(const otx_obj_names_table *table);

#endif

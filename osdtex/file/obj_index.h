/* obj_index.h -- OBJ's way to number elements.
 *
 * Counted from 1; negative numbers count back from the last element so far. */
#ifndef OTX_FILE_OBJ_INDEX_H
#define OTX_FILE_OBJ_INDEX_H

#include "file/text.h"

/* A place in the file and what stands there, for messages. */
typedef struct otx_obj_index_context
{
    const otx_text *text;
    const char *what; /* "vertex", "UV" */
    int32_t face;     /* -1 none */
} otx_obj_index_context;

/* Turns `number` into a 0-based index. `so_far` elements precede the line; a
 * positive number may be larger than that (it refers forward), which
 * otx_obj_index_check judges when the file is over. FORMAT for 0, for numbers
 * that no index can hold, and before the first element. */
otx_status otx_obj_index_resolve(
    const otx_obj_index_context *context, int64_t number, int32_t so_far,
    int32_t *index);

/* FORMAT when `index` (0-based) is not below `count`, the file's total. */
otx_status otx_obj_index_check(
    const otx_obj_index_context *context, int64_t line, int32_t index,
    int32_t count);

#endif

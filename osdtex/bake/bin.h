/* bin.h -- things by the blocks of a picture that they reach into. */
#ifndef OTX_BAKE_BIN_H
#define OTX_BAKE_BIN_H

#include "base/run.h"

/* Half-open ranges of blocks. */
typedef struct otx_bin_box
{
    int32_t x, x_end, y, y_end;
} otx_bin_box;

/* The blocks that item `index` reaches into; empty for none. Asked twice. */
typedef otx_bin_box (*otx_bin_box_fn)(const void *context, int32_t index);

/* Items of block (x, y) are items[first[y * columns + x]] on, ascending. */
typedef struct otx_bin
{
    int32_t columns, rows;
    const int64_t *first; /* [columns * rows + 1] */
    const int32_t *items;
} otx_bin;

/* Sorts the items 0 .. count - 1 into blocks, in `arena`. MEMORY. */
otx_status otx_bin_build(
    otx_run *run, otx_arena *arena, int32_t columns, int32_t rows,
    int32_t count, otx_bin_box_fn box, const void *context, otx_bin *out);

#endif

/* bin.c -- a counting sort. */
#include "bake/bin.h"

#include "base/csr.h"

otx_status
otx_bin_build(
    otx_run *run, otx_arena *arena, int32_t columns, int32_t rows,
    int32_t count, otx_bin_box_fn box, const void *context, otx_bin *out)
{
    const int64_t blocks = (int64_t)columns * rows;
    int64_t *first = OTX_ZNEW(arena, int64_t, blocks + 2);
    int32_t *items;

    if (!first)
        return otx_fail_memory(run, "bake");
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_bin_box b = box(context, i);

        for (int32_t y = b.y; y < b.y_end; ++y)
            for (int32_t x = b.x; x < b.x_end; ++x)
                otx_csr_wide_count(first, (int64_t)y * columns + x, 1);
    }
    otx_csr_wide_sum(first, blocks);
    items = OTX_NEW(arena, int32_t, first[blocks + 1]);
    if (!items)
        return otx_fail_memory(run, "bake");
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_bin_box b = box(context, i);

        for (int32_t y = b.y; y < b.y_end; ++y)
            for (int32_t x = b.x; x < b.x_end; ++x)
                items[otx_csr_wide_place(first, (int64_t)y * columns + x)] = i;
    }
    *out = (otx_bin){columns, rows, first, items};
    return OSDTEX_OK;
}

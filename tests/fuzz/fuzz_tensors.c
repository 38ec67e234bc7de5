/* fuzz_tensors.c -- bytes of any kind as the container of a saved mapping.
 *
 * What is accepted must be readable to its last byte. */
#include "base/pool.h"
#include "file/tensors.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static uint64_t
sum_of(const otx_tensors *tensors)
{
    static const size_t sizes[] = {8, 8, 4, 4, 1};
    uint64_t sum = 0;

    for (int32_t i = 0; i < tensors->count; ++i)
    {
        const otx_tensor *t = &tensors->items[i];
        const size_t count =
            (size_t)t->rows * (size_t)(t->columns > 0 ? t->columns : 1);

        for (size_t k = 0; k < count * sizes[t->type]; ++k)
            sum += ((const uint8_t *)t->data)[k];
    }
    return sum;
}

int
LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const otx_allocator_hooks hooks = {.limit_bytes = 1 << 28};
    otx_allocator *allocator = otx_allocator_create(&hooks);
    otx_run run = {
        .arena = otx_arena_create(allocator),
        .scratch = otx_arena_create(allocator),
        .allocator = allocator,
        .diagnostics = otx_diagnostics_create(allocator),
    };
    otx_tensors *tensors = calloc(1, sizeof *tensors);

    if (run.arena && run.scratch && tensors &&
        otx_tensors_parse(&run, "fuzz", bytes, size, tensors) == OSDTEX_OK &&
        sum_of(tensors) == UINT64_MAX)
        abort();
    free(tensors);
    otx_arena_destroy(run.arena);
    otx_arena_destroy(run.scratch);
    otx_diagnostics_destroy(run.diagnostics);
    otx_allocator_destroy(allocator);
    return 0;
}

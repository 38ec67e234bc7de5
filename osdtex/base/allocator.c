/* allocator.c -- the host's hooks or malloc(), counted and limited. */
#include "base/allocator.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <sys/mman.h>

enum
{
    LARGE_PAGE_BYTES = 1 << 21
};

struct otx_allocator
{
    otx_allocator_hooks hooks;
    _Atomic size_t used;
    _Atomic size_t peak;
    _Atomic size_t owners; /* its creator and every arena */
};

otx_allocator *
otx_allocator_create(const otx_allocator_hooks *hooks)
{
    otx_allocator *allocator = malloc(sizeof *allocator);

    if (!allocator)
        return NULL;
    allocator->hooks = hooks ? *hooks : (otx_allocator_hooks){0};
    atomic_init(&allocator->used, 0);
    atomic_init(&allocator->peak, 0);
    atomic_init(&allocator->owners, 1);
    return allocator;
}

void
otx_allocator_hold(otx_allocator *allocator)
{
    atomic_fetch_add(&allocator->owners, 1);
}

void
otx_allocator_destroy(otx_allocator *allocator)
{
    if (allocator && atomic_fetch_sub(&allocator->owners, 1) == 1)
        free(allocator);
}

/* Counts `bytes` in, or refuses when they would pass the limit. */
static bool
reserve(otx_allocator *allocator, size_t bytes)
{
    const size_t limit = allocator->hooks.limit_bytes;
    const size_t used = atomic_fetch_add(&allocator->used, bytes) + bytes;
    size_t peak = atomic_load(&allocator->peak);

    if (used < bytes || (limit != 0 && used > limit))
    {
        atomic_fetch_sub(&allocator->used, bytes);
        return false;
    }
    while (used > peak &&
           !atomic_compare_exchange_weak(&allocator->peak, &peak, used))
    {
    }
    return true;
}

/* Asks for large pages: the first touch of small ones is a quarter of the time
 * of refinement. It is advice, and may come to nothing. */
#ifdef MADV_HUGEPAGE
static void
advise_large_pages(void *block, size_t bytes)
{
    const uintptr_t mask = LARGE_PAGE_BYTES - 1;
    const uintptr_t first = ((uintptr_t)block + mask) & ~mask;
    const uintptr_t end = ((uintptr_t)block + bytes) & ~mask;

    if (end > first)
        (void)madvise(
            (char *)block + (first - (uintptr_t)block), end - first,
            MADV_HUGEPAGE);
}
#else
static void
advise_large_pages(void *block, size_t bytes)
{
    (void)block;
    (void)bytes;
}
#endif

static void *
plain_alloc(size_t bytes)
{
    void *block = malloc(bytes);

    if (block && bytes >= 2 * (size_t)LARGE_PAGE_BYTES)
        advise_large_pages(block, bytes);
    return block;
}

void *
otx_allocator_alloc(otx_allocator *allocator, size_t bytes)
{
    void *block;

    if (!reserve(allocator, bytes))
        return NULL;
    block = allocator->hooks.alloc
                ? allocator->hooks.alloc(allocator->hooks.user, bytes)
                : plain_alloc(bytes);
    if (!block)
        atomic_fetch_sub(&allocator->used, bytes);
    return block;
}

void
otx_allocator_free(otx_allocator *allocator, void *block, size_t bytes)
{
    if (!block)
        return;
    if (allocator->hooks.release)
        allocator->hooks.release(allocator->hooks.user, block, bytes);
    else
        free(block);
    atomic_fetch_sub(&allocator->used, bytes);
}

size_t
otx_allocator_used(const otx_allocator *allocator)
{
    return atomic_load(&allocator->used);
}

size_t
otx_allocator_peak(const otx_allocator *allocator)
{
    return atomic_load(&allocator->peak);
}

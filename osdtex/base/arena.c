/* arena.c -- chained blocks over a counting heap.
 *
 * Blocks start small and double up to 1 MiB, so that thousands of small arenas
 * are cheap; a larger request gets a block of its own, so that releasing a
 * mark returns large temporaries to the system at once. */
#include "base/arena.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum
{
    ALIGNMENT = 64,
    FIRST_BLOCK_BYTES = 4096,
    LAST_BLOCK_BYTES = 1 << 20,
    LARGE_PAGE_BYTES = 1 << 21
};

struct otx_heap
{
    otx_heap_hooks hooks;
    _Atomic size_t used;
    _Atomic size_t peak;
    _Atomic size_t owners; /* its creator and every arena */
};

typedef struct chunk
{
    struct chunk *previous;
    size_t capacity; /* payload bytes */
    size_t used;
} chunk;

typedef struct deferred
{
    struct deferred *previous;
    void (*fn)(void *);
    void *object;
} deferred;

struct otx_arena
{
    otx_heap *heap;
    chunk *last;
    deferred *deferred;
    _Atomic size_t owners;
};

otx_heap *
otx_heap_create(const otx_heap_hooks *hooks)
{
    otx_heap *heap = malloc(sizeof *heap);

    if (!heap)
        return NULL;
    heap->hooks = hooks ? *hooks : (otx_heap_hooks){0};
    atomic_init(&heap->used, 0);
    atomic_init(&heap->peak, 0);
    atomic_init(&heap->owners, 1);
    return heap;
}

void
otx_heap_destroy(otx_heap *heap)
{
    if (heap && atomic_fetch_sub(&heap->owners, 1) == 1)
        free(heap);
}

/* Counts `bytes` in, or refuses when they would pass the limit. */
static bool
reserve(otx_heap *heap, size_t bytes)
{
    const size_t limit = heap->hooks.limit_bytes;
    const size_t used = atomic_fetch_add(&heap->used, bytes) + bytes;
    size_t peak = atomic_load(&heap->peak);

    if (used < bytes || (limit != 0 && used > limit))
    {
        atomic_fetch_sub(&heap->used, bytes);
        return false;
    }
    while (used > peak &&
           !atomic_compare_exchange_weak(&heap->peak, &peak, used))
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
otx_heap_alloc(otx_heap *heap, size_t bytes)
{
    void *block;

    if (!reserve(heap, bytes))
        return NULL;
    block = heap->hooks.alloc ? heap->hooks.alloc(heap->hooks.user, bytes)
                              : plain_alloc(bytes);
    if (!block)
        atomic_fetch_sub(&heap->used, bytes);
    return block;
}

void
otx_heap_free(otx_heap *heap, void *block, size_t bytes)
{
    if (!block)
        return;
    if (heap->hooks.release)
        heap->hooks.release(heap->hooks.user, block, bytes);
    else
        free(block);
    atomic_fetch_sub(&heap->used, bytes);
}

size_t
otx_heap_used(const otx_heap *heap)
{
    return atomic_load(&heap->used);
}

size_t
otx_heap_peak(const otx_heap *heap)
{
    return atomic_load(&heap->peak);
}

otx_arena *
otx_arena_create(otx_heap *heap)
{
    otx_arena *arena = otx_heap_alloc(heap, sizeof *arena);

    if (!arena)
        return NULL;
    arena->heap = heap;
    arena->last = NULL;
    arena->deferred = NULL;
    atomic_init(&arena->owners, 1);
    atomic_fetch_add(&heap->owners, 1);
    return arena;
}

/* First aligned byte of the payload. */
static char *
payload(chunk *b)
{
    const uintptr_t start = (uintptr_t)(b + 1);

    return (char *)((start + ALIGNMENT - 1) & ~(uintptr_t)(ALIGNMENT - 1));
}

static size_t
block_bytes(size_t capacity)
{
    return sizeof(chunk) + ALIGNMENT + capacity;
}

static void
run_deferred(otx_arena *arena, const deferred *until)
{
    while (arena->deferred != until)
    {
        deferred *d = arena->deferred;

        arena->deferred = d->previous;
        d->fn(d->object);
    }
}

static void
drop_blocks(otx_arena *arena, const chunk *until)
{
    while (arena->last != until)
    {
        chunk *b = arena->last;

        arena->last = b->previous;
        otx_heap_free(arena->heap, b, block_bytes(b->capacity));
    }
}

void
otx_arena_destroy(otx_arena *arena)
{
    otx_heap *heap;

    if (!arena || atomic_fetch_sub(&arena->owners, 1) != 1)
        return;
    heap = arena->heap;
    run_deferred(arena, NULL);
    drop_blocks(arena, NULL);
    otx_heap_free(heap, arena, sizeof *arena);
    otx_heap_destroy(heap);
}

static void
let_go(void *arena)
{
    otx_arena_destroy(arena);
}

bool
otx_arena_hold(otx_arena *arena, otx_arena *other)
{
    if (!otx_arena_defer(arena, let_go, other))
        return false;
    atomic_fetch_add(&other->owners, 1);
    return true;
}

static bool
grow(otx_arena *arena, size_t bytes)
{
    size_t capacity = FIRST_BLOCK_BYTES;
    chunk *b;

    if (arena->last)
        capacity = 2 * arena->last->capacity;
    if (capacity > LAST_BLOCK_BYTES)
        capacity = LAST_BLOCK_BYTES;
    if (capacity < bytes)
        capacity = bytes;

    if (capacity > SIZE_MAX - sizeof(chunk) - ALIGNMENT)
        return false;
    b = otx_heap_alloc(arena->heap, block_bytes(capacity));
    if (!b)
        return false;
    *b = (chunk){.previous = arena->last, .capacity = capacity};
    arena->last = b;
    return true;
}

void *
otx_arena_alloc(otx_arena *arena, size_t count, size_t size)
{
    size_t bytes;
    char *result;

    if (size != 0 && count > (SIZE_MAX - ALIGNMENT) / size)
        return NULL;
    bytes = (count * size + ALIGNMENT - 1) & ~(size_t)(ALIGNMENT - 1);
    if (bytes == 0)
        bytes = ALIGNMENT;
    if (!arena->last || arena->last->capacity - arena->last->used < bytes)
    {
        if (!grow(arena, bytes))
            return NULL;
    }
    result = payload(arena->last) + arena->last->used;
    arena->last->used += bytes;
    return result;
}

void *
otx_arena_zalloc(otx_arena *arena, size_t count, size_t size)
{
    void *result = otx_arena_alloc(arena, count, size);

    if (result)
        memset(result, 0, count * size);
    return result;
}

char *
otx_arena_strdup(otx_arena *arena, const char *text)
{
    const size_t bytes = strlen(text) + 1;
    char *copy = otx_arena_alloc(arena, bytes, 1);

    if (copy)
        memcpy(copy, text, bytes);
    return copy;
}

bool
otx_arena_defer(otx_arena *arena, void (*fn)(void *), void *object)
{
    deferred *d = OTX_NEW(arena, deferred, 1);

    if (!d)
        return false;
    *d = (deferred){arena->deferred, fn, object};
    arena->deferred = d;
    return true;
}

otx_arena_mark
otx_arena_here(otx_arena *arena)
{
    return (otx_arena_mark){
        arena->last, arena->last ? arena->last->used : 0, arena->deferred};
}

void
otx_arena_release(otx_arena *arena, otx_arena_mark mark)
{
    run_deferred(arena, mark.deferred);
    drop_blocks(arena, mark.block);
    if (arena->last)
        arena->last->used = mark.used;
}

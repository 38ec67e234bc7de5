/* arena.c -- chained blocks of an allocator.
 *
 * Blocks start small and double up to 1 MiB, so that thousands of small arenas
 * are cheap; a larger request gets a block of its own, so that releasing a
 * mark returns large temporaries to the system at once. */
#include "base/arena.h"

#include <stdatomic.h>
#include <string.h>

enum
{
    ALIGNMENT = 64,
    FIRST_BLOCK_BYTES = 4096,
    LAST_BLOCK_BYTES = 1 << 20
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
    otx_allocator *allocator;
    chunk *last;
    deferred *deferred;
    bool failed;
    _Atomic size_t owners;
};

otx_arena *
otx_arena_create(otx_allocator *allocator)
{
    otx_arena *arena = otx_allocator_alloc(allocator, sizeof *arena);

    if (!arena)
        return NULL;
    arena->allocator = allocator;
    arena->last = NULL;
    arena->deferred = NULL;
    arena->failed = false;
    atomic_init(&arena->owners, 1);
    otx_allocator_hold(allocator);
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
        otx_allocator_free(arena->allocator, b, block_bytes(b->capacity));
    }
}

void
otx_arena_destroy(otx_arena *arena)
{
    otx_allocator *allocator;

    if (!arena || atomic_fetch_sub(&arena->owners, 1) != 1)
        return;
    allocator = arena->allocator;
    run_deferred(arena, NULL);
    drop_blocks(arena, NULL);
    otx_allocator_free(allocator, arena, sizeof *arena);
    otx_allocator_destroy(allocator);
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
    b = otx_allocator_alloc(arena->allocator, block_bytes(capacity));
    if (!b)
        return false;
    *b = (chunk){.previous = arena->last, .capacity = capacity};
    arena->last = b;
    return true;
}

static void *
fail(otx_arena *arena)
{
    arena->failed = true;
    return NULL;
}

bool
otx_arena_failed(const otx_arena *arena)
{
    return arena->failed;
}

void *
otx_arena_alloc(otx_arena *arena, size_t count, size_t size)
{
    size_t bytes;
    char *result;

    if (size != 0 && count > (SIZE_MAX - ALIGNMENT) / size)
        return fail(arena);
    bytes = (count * size + ALIGNMENT - 1) & ~(size_t)(ALIGNMENT - 1);
    if (bytes == 0)
        bytes = ALIGNMENT;
    if (!arena->last || arena->last->capacity - arena->last->used < bytes)
    {
        if (!grow(arena, bytes))
            return fail(arena);
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
        arena->last, arena->last ? arena->last->used : 0, arena->deferred,
        arena->failed};
}

void
otx_arena_release(otx_arena *arena, otx_arena_mark mark)
{
    run_deferred(arena, mark.deferred);
    drop_blocks(arena, mark.block);
    if (arena->last)
        arena->last->used = mark.used;
    arena->failed = mark.failed;
}

/* arena.h -- memory that is freed together.
 *
 * Results of a stage live in the run's arena and die with the handle that took
 * it over; temporaries live in the run's scratch arena between a mark and its
 * release. Foreign resources (plans, files, C++ objects) are registered with
 * `otx_arena_defer`, so that error paths have nothing to free.
 *
 * Arenas are counted: one that refers into another holds it, and the other
 * then outlives whoever destroys it first. So do allocators outlive their
 * arenas.
 *
 * An arena serves one thread; a worker of the pool has its own. */
#ifndef OTX_BASE_ARENA_H
#define OTX_BASE_ARENA_H

#include "base/allocator.h"

#ifdef __cplusplus
extern "C"
{
#endif

    typedef struct otx_arena otx_arena;

    /* A place in an arena to which it can be released again. */
    typedef struct otx_arena_mark
    {
        void *block;
        size_t used;
        void *deferred;
        bool failed;
    } otx_arena_mark;

    /* NULL when memory is out. Destroying NULL is fine. */
    otx_arena *otx_arena_create(otx_allocator *allocator);
    void otx_arena_destroy(otx_arena *arena);

    /* `count * size` bytes aligned to 64, uninitialised; NULL when the product
     * overflows or memory is out. A count of 0 gives a valid pointer. */
    void *otx_arena_alloc(otx_arena *arena, size_t count, size_t size);
    /* The same, zeroed. */
    void *otx_arena_zalloc(otx_arena *arena, size_t count, size_t size);
    char *otx_arena_strdup(otx_arena *arena, const char *text);

#define OTX_NEW(arena, type, count)                                            \
    ((type *)otx_arena_alloc((arena), (size_t)(count), sizeof(type)))
#define OTX_ZNEW(arena, type, count)                                           \
    ((type *)otx_arena_zalloc((arena), (size_t)(count), sizeof(type)))

    /* Whether an allocation has failed, so that a group of them is asked once:
     *
     *     a = OTX_NEW(run->scratch, double, n);
     *     b = OTX_NEW(run->scratch, int32_t, n);
     *     OTX_TRY(otx_run_ok(run));
     *
     * Nothing may be written through a pointer before. Releasing a mark
     * forgets failures since. */
    bool otx_arena_failed(const otx_arena *arena);

    /* Calls `fn(object)` when the arena is destroyed or released past this
     * point, last registered first. False when memory is out (the caller then
     * cleans up itself). */
    bool otx_arena_defer(otx_arena *arena, void (*fn)(void *), void *object);

    /* Keeps `other` until `arena` is destroyed or released past this point,
     * whoever destroys `other` before. False when memory is out. */
    bool otx_arena_hold(otx_arena *arena, otx_arena *other);

    otx_arena_mark otx_arena_here(otx_arena *arena);
    void otx_arena_release(otx_arena *arena, otx_arena_mark mark);

#ifdef __cplusplus
}
#endif
#endif

/* allocator.h -- where memory comes from, and how much of it is out.
 *
 * One allocator a context: the host's hooks, or malloc and free, with a count
 * of the bytes handed out and a limit. All of it is safe to use from several
 * threads. */
#ifndef OTX_BASE_ALLOCATOR_H
#define OTX_BASE_ALLOCATOR_H

#include "base/status.h"

#ifdef __cplusplus
extern "C"
{
#endif

    typedef struct otx_allocator otx_allocator;

    /* `alloc` returns NULL on failure; `release` gets the size back.
     * Either may be NULL: malloc and free. `limit_bytes` 0 means no limit. */
    typedef struct otx_allocator_hooks
    {
        void *(*alloc)(void *user, size_t bytes);
        void (*release)(void *user, void *block, size_t bytes);
        void *user;
        size_t limit_bytes;
    } otx_allocator_hooks;

    otx_allocator *otx_allocator_create(const otx_allocator_hooks *hooks);
    /* One owner more: an arena of it. */
    void otx_allocator_hold(otx_allocator *allocator);
    /* One owner less; the last one takes it along. NULL is fine. */
    void otx_allocator_destroy(otx_allocator *allocator);
    void *otx_allocator_alloc(otx_allocator *allocator, size_t bytes);
    void
    otx_allocator_free(otx_allocator *allocator, void *block, size_t bytes);
    size_t otx_allocator_used(const otx_allocator *allocator);
    size_t otx_allocator_peak(const otx_allocator *allocator);

#ifdef __cplusplus
}
#endif
#endif

/* pqueue.c -- sift up, sift down. */
#include "base/pqueue.h"

#include <string.h>

otx_pqueue
otx_pqueue_make(otx_arena *arena)
{
    return (otx_pqueue){.arena = arena};
}

static bool
before(otx_pqueue_entry a, otx_pqueue_entry b)
{
    return a.key < b.key || (a.key == b.key && a.item < b.item);
}

static bool
grow(otx_pqueue *queue)
{
    const int64_t capacity =
        queue->capacity ? 2 * (int64_t)queue->capacity : 256;
    otx_pqueue_entry *entries = OTX_NEW(
        queue->arena, otx_pqueue_entry,
        capacity <= INT32_MAX ? (size_t)capacity : SIZE_MAX);

    if (!entries)
        return false;
    if (queue->count > 0)
        memcpy(
            entries, queue->entries,
            (size_t)queue->count * sizeof *queue->entries);
    queue->entries = entries;
    queue->capacity = (int32_t)capacity;
    return true;
}

void
otx_pqueue_push(otx_pqueue *queue, double key, int32_t item)
{
    const otx_pqueue_entry entry = {key, item};
    int32_t i;

    if (queue->count == queue->capacity && !grow(queue))
        return;
    for (i = queue->count++; i > 0; i = (i - 1) / 2)
    {
        if (!before(entry, queue->entries[(i - 1) / 2]))
            break;
        queue->entries[i] = queue->entries[(i - 1) / 2];
    }
    queue->entries[i] = entry;
}

bool
otx_pqueue_pop(otx_pqueue *queue, otx_pqueue_entry *out)
{
    otx_pqueue_entry last;
    int32_t i = 0;

    if (queue->count == 0)
        return false;
    *out = queue->entries[0];
    last = queue->entries[--queue->count];
    for (;;)
    {
        int32_t child = 2 * i + 1;

        if (child >= queue->count)
            break;
        if (child + 1 < queue->count &&
            before(queue->entries[child + 1], queue->entries[child]))
            ++child;
        if (!before(queue->entries[child], last))
            break;
        queue->entries[i] = queue->entries[child];
        i = child;
    }
    queue->entries[i] = last;
    return true;
}

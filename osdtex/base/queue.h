/* queue.h -- a binary min-heap of (key, item), ties by item.
 *
 * Equal keys come out in the order of their items, so that a traversal is the
 * same on every machine. Stale entries are the caller's to skip. */
#ifndef OTX_BASE_QUEUE_H
#define OTX_BASE_QUEUE_H

#include "base/arena.h"

typedef struct otx_queue_entry
{
    double key;
    int32_t item;
} otx_queue_entry;

typedef struct otx_queue
{
    otx_arena *arena; /* that it grows in */
    otx_queue_entry *entries;
    int32_t count;
    int32_t capacity;
} otx_queue;

otx_queue otx_queue_make(otx_arena *arena);
/* False when memory is out. */
bool otx_queue_push(otx_queue *queue, double key, int32_t item);
/* False when empty. */
bool otx_queue_pop(otx_queue *queue, otx_queue_entry *out);

#endif

/* pqueue.h -- a binary min-heap of (key, item), ties by item.
 *
 * Equal keys come out in the order of their items, so that a traversal is the
 * same on every machine. Stale entries are the caller's to skip. */
#ifndef OTX_BASE_PQUEUE_H
#define OTX_BASE_PQUEUE_H

#include "base/arena.h"

typedef struct otx_pqueue_entry
{
    double key;
    int32_t item;
} otx_pqueue_entry;

typedef struct otx_pqueue
{
    otx_arena *arena; /* that it grows in */
    otx_pqueue_entry *entries;
    int32_t count;
    int32_t capacity;
} otx_pqueue;

otx_pqueue otx_pqueue_make(otx_arena *arena);
/* When memory is out the item is dropped, and the arena says so: who drains
 * the queue asks it afterwards. */
void otx_pqueue_push(otx_pqueue *queue, double key, int32_t item);
/* False when empty. */
bool otx_pqueue_pop(otx_pqueue *queue, otx_pqueue_entry *out);

#endif

/* past.c -- recipes one after the other, to go back and forth in. */
#include "studio/past.h"

#include <string.h>

void
otx_past_push(otx_past *h, json_t *recipe)
{
    while (h->count > 0 && h->count > h->at + 1)
        json_decref(h->items[--h->count]);
    if (h->count == OTX_PAST_MOST)
    {
        json_decref(h->items[0]);
        memmove(h->items, h->items + 1, (OTX_PAST_MOST - 1) * sizeof *h->items);
        --h->count;
    }
    h->items[h->count] = recipe;
    h->at = h->count++;
    ++h->revision;
}

bool
otx_past_has(const otx_past *h, int by)
{
    return h->at + by >= 0 && h->at + by < h->count;
}

bool
otx_past_step(otx_past *h, int by)
{
    if (!otx_past_has(h, by))
        return false;
    h->at += by;
    ++h->revision;
    return true;
}

json_t *
otx_past_now(const otx_past *h)
{
    return h->count > 0 ? h->items[h->at] : NULL;
}

void
otx_past_free(otx_past *h)
{
    while (h->count > 0)
        json_decref(h->items[--h->count]);
    *h = (otx_past){0};
}

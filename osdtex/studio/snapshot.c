/* snapshot.c -- what the page shows: a mapping with all that is told of it. */
#include "studio/snapshot.h"

#include <stdlib.h>

otx_snapshot *
otx_snapshot_make(osdtex_mapping *mapping, osdtex_field *field)
{
    otx_snapshot *s = calloc(1, sizeof *s);

    if (!s)
        return NULL;
    atomic_init(&s->holders, 1);
    s->mapping = mapping;
    s->field = field;
    return s;
}

otx_snapshot *
otx_snapshot_hold(otx_snapshot *s)
{
    if (s)
        atomic_fetch_add(&s->holders, 1);
    return s;
}

void
otx_snapshot_release(otx_snapshot *s)
{
    if (!s || atomic_fetch_sub(&s->holders, 1) > 1)
        return;
    osdtex_field_destroy(s->field);
    osdtex_mapping_destroy(s->mapping);
    free(s);
}

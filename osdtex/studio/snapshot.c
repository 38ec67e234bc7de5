/* snapshot.c -- what the page shows: a mapping with all that is told of it. */
#include "studio/snapshot.h"

#include <stdlib.h>

otx_outcome *
otx_outcome_make(osdtex_mapping *mapping, osdtex_field *field)
{
    otx_outcome *o = calloc(1, sizeof *o);

    if (!o)
        return NULL;
    atomic_init(&o->holders, 1);
    o->mapping = mapping;
    o->field = field;
    return o;
}

otx_outcome *
otx_outcome_hold(otx_outcome *o)
{
    atomic_fetch_add(&o->holders, 1);
    return o;
}

void
otx_outcome_release(otx_outcome *o)
{
    if (!o || atomic_fetch_sub(&o->holders, 1) > 1)
        return;
    osdtex_field_destroy(o->field);
    osdtex_mapping_destroy(o->mapping);
    free(o);
}

otx_snapshot *
otx_snapshot_make(otx_outcome *outcome)
{
    otx_snapshot *s = calloc(1, sizeof *s);

    if (!s)
        return NULL;
    atomic_init(&s->holders, 1);
    s->outcome = otx_outcome_hold(outcome);
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
    json_decref(s->facts);
    otx_outcome_release(s->outcome);
    free(s);
}

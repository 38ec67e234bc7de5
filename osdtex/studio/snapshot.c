/* snapshot.c -- what the page shows: a mapping with all that is told of it. */
#include "studio/snapshot.h"

#include <stdlib.h>

/* Where its seams are, and how much its faces are stretched. */
static osdtex_status
look(osdtex_context *context, otx_outcome *o)
{
    const osdtex_status status = osdtex_seams_create(
        context, o->mapping, OTX_SNAPSHOT_PLACES_MOST, &o->seams);

    if (status != OSDTEX_OK)
        return status;
    o->stretch = calloc(
        (size_t)osdtex_mapping_describe(o->mapping)->face_count,
        sizeof *o->stretch);
    if (!o->stretch)
        return OSDTEX_ERROR_MEMORY;
    return osdtex_mapping_stretch(context, o->mapping, o->stretch);
}

osdtex_status
otx_outcome_make(
    osdtex_context *context, osdtex_mapping *mapping, osdtex_field *field,
    otx_outcome **out)
{
    otx_outcome *o = calloc(1, sizeof *o);
    osdtex_status status;

    *out = NULL;
    if (!o)
    {
        osdtex_field_destroy(field);
        osdtex_mapping_destroy(mapping);
        return OSDTEX_ERROR_MEMORY;
    }
    atomic_init(&o->holders, 1);
    o->mapping = mapping;
    o->field = field;
    status = look(context, o);
    if (status == OSDTEX_OK)
        *out = o;
    else
        otx_outcome_release(o);
    return status;
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
    free(o->stretch);
    osdtex_seams_destroy(o->seams);
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

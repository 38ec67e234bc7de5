/* snapshot.h -- what the page shows: a mapping with all that is told of it.
 *
 * Made by the thread that maps, read by those that answer; it lives as long as
 * somebody has it. */
#ifndef OTX_STUDIO_SNAPSHOT_H
#define OTX_STUDIO_SNAPSHOT_H

#include <osdtex/osdtex.h>

#include <jansson.h>
#include <stdatomic.h>

enum
{
    OTX_SNAPSHOT_EXEMPLARS_MAX = OSDTEX_EXEMPLARS_MAX,
    OTX_SNAPSHOT_PLACES_MOST = 24 /* of seams */
};

/* What a recipe has made; of several snapshots, where it comes again. */
typedef struct otx_outcome
{
    atomic_int holders;
    int64_t surface_serial; /* another number, other points and faces */
    osdtex_mapping *mapping;
    osdtex_field *field; /* NULL none */
    osdtex_seams *seams;
    float *stretch; /* of each face */
    const osdtex_exemplar *exemplars[OTX_SNAPSHOT_EXEMPLARS_MAX];
    int exemplar; /* which of those to choose among the first is */
} otx_outcome;

/* Takes the mapping and the field, whatever comes of it, and looks at what was
 * made. One holder.
 *
 *   out  NULL on failure
 *
 * CANCELLED, MEMORY. */
osdtex_status otx_outcome_make(
    osdtex_context *context, osdtex_mapping *mapping, osdtex_field *field,
    otx_outcome **out);
otx_outcome *otx_outcome_hold(otx_outcome *outcome);
void otx_outcome_release(otx_outcome *outcome);

typedef struct otx_snapshot
{
    atomic_int holders;
    int64_t serial;
    int64_t revision; /* of the recipe that it is of */
    double seconds;
    bool is_edit;  /* it was made from another mapping */
    json_t *facts; /* what the page is told with the picture; NULL none */
    otx_outcome *outcome;
} otx_snapshot;

/* Holds the outcome; NULL when memory is out. One holder. */
otx_snapshot *otx_snapshot_make(otx_outcome *outcome);
/* NULL for NULL. */
otx_snapshot *otx_snapshot_hold(otx_snapshot *snapshot);
void otx_snapshot_release(otx_snapshot *snapshot);

#endif

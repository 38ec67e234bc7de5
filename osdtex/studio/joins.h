/* joins.h -- where patches meet, and how much that shows.
 *
 * An edge whose two faces show different places of the exemplar is a seam. It
 * is as bad as its colours differ times its length; what lies in one cell of a
 * grid is seen as one place. Colours are compared as square roots, about as
 * they are seen. */
#ifndef OTX_STUDIO_JOINS_H
#define OTX_STUDIO_JOINS_H

#include "studio/snapshot.h"

enum
{
    OTX_JOINS_PLACES_MOST = 24
};

/* A seam: the edge from this corner to the next of its face. */
typedef struct otx_join
{
    int32_t corner;
    float difference; /* 0 .. 1, black beside white */
} otx_join;

typedef struct otx_joins
{
    otx_join *items; /* [count], to be freed */
    int32_t count;
    bool failed; /* memory is out; there are none */
} otx_joins;

otx_joins otx_joins_find(const otx_snapshot *snapshot);

/* The worst places, as a new array of {"point", "normal", "length",
 * "difference"} in scene units; NULL when memory is out. */
json_t *otx_joins_places(const otx_snapshot *snapshot, const otx_joins *joins);

#endif

/* decals.h -- pictures that lie over what a mapping shows.
 *
 * Each is laid out once over the faces that it covers, as one chart without a
 * cut, and ends where its picture does. What is below stays as the method made
 * it: see docs/notes/place.md. */
#ifndef OTX_MAPPING_DECALS_H
#define OTX_MAPPING_DECALS_H

#include "exemplar/exemplar.h"
#include "mapping/lookups.h"

typedef struct otx_decals
{
    /* One over the other. A fragment is a decal: its `exemplar` is one of the
     * pictures below, and it is cut out by the picture's sides alone. */
    otx_lookups lookups;
    int32_t picture_count;
    const otx_exemplar *pictures; /* [picture_count] none of which tiles */
    const otx_texture *textures;  /* [picture_count] of their linear pixels */
} otx_decals;

/* Whether any lies over a face. */
static inline bool
otx_decals_has(const otx_decals *decals, int32_t face)
{
    return decals &&
           decals->lookups.first[face + 1] > decals->lookups.first[face];
}

#endif

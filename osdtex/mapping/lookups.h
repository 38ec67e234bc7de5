/* lookups.h -- faces that show several places of the exemplar at once.
 *
 * Their colour is the mean of several lookups, whose weights are linear within
 * a triangle, as the UVs are. Only what evaluates colours can show it, such as
 * a bake; for all else these faces have UVs like any other. */
#ifndef OTX_MAPPING_LOOKUPS_H
#define OTX_MAPPING_LOOKUPS_H

#include <stdint.h>

/* Of one lookup at one corner. */
typedef struct otx_lookup
{
    float uv[2];
    float weight; /* not negative; those of a corner's lookups sum to 1 */
} otx_lookup;

typedef struct otx_lookups
{
    /* [leaf face_count + 1] into `items`: those of a face, lookup by lookup,
     * one for each of its corners. None: the face's own UVs are looked up. */
    const int64_t *first;
    const otx_lookup *items;
} otx_lookups;

#endif

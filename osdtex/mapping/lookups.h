/* lookups.h -- faces that show several places of the exemplars at once.
 *
 * A lookup gives every corner of a face a place in an exemplar and a weight,
 * both linear within a triangle, as UVs are. Most faces have none: they show
 * what their own UVs say. What several lookups come to is said in
 * mapping/show.h, which is the one that evaluates them. */
#ifndef OTX_MAPPING_LOOKUPS_H
#define OTX_MAPPING_LOOKUPS_H

#include "image/texture.h"
#include "mapping/radial.h"

#include <stdint.h>

/* How the lookups of a face go together. */
typedef enum otx_layering
{
    OTX_LAYERING_MEAN, /* by their weights, which sum to 1 */
    OTX_LAYERING_OVER  /* each over those before it, which are below; weights
                        * are coverage, from 0 to 1 */
} otx_layering;

/* What a lookup is taken from. */
typedef struct otx_fragment
{
    int32_t exemplar;
    int32_t patch;
    /* Masks multiply the weight: a picture of one channel on the unit square,
     * beyond which its border goes on, or an outline. NULL: opaque. */
    const otx_texture *mask;
    const otx_radial *outline;
    /* u, v of the mask's origin on the exemplar, and the length of its unit in
     * u and in v; no length: all of the exemplar. */
    float frame[4];
} otx_fragment;

/* One lookup at one corner. */
typedef struct otx_lookup
{
    float uv[2];
    float weight;     /* not negative */
    int32_t fragment; /* -1: the exemplar of the face's patch, opaque. The same
                       * at all corners of a lookup */
} otx_lookup;

typedef struct otx_lookups
{
    /* [leaf face_count + 1] into `items`: those of a face, lookup by lookup,
     * one for each of its corners. None: the face's own UVs are looked up. */
    const int64_t *first;
    const otx_lookup *items;
    otx_layering layering;
    int32_t fragment_count;
    const otx_fragment *fragments; /* [fragment_count] */
} otx_lookups;

#endif

/* source.h -- which exemplar a face of a mapping shows.
 *
 * Where a mapping takes from several exemplars, functions are given all of them
 * as an array; a single one is an array of one. Texels are those of their match
 * pictures, as many to a scene unit in each. */
#ifndef OTX_MAPPING_SOURCE_H
#define OTX_MAPPING_SOURCE_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

/* Index of the exemplar; 0 on faces without a patch. */
static inline int32_t
otx_source_of(const otx_mapping *mapping, int32_t face)
{
    const int32_t patch = mapping->face_patch[face];

    return mapping->patch_exemplar && patch >= 0 && patch < mapping->patch_count
               ? mapping->patch_exemplar[patch]
               : 0;
}

/* How many exemplars the mapping takes from. */
static inline int32_t
otx_source_count(const otx_mapping *mapping)
{
    return mapping->patch_exemplar ? mapping->exemplar_count : 1;
}

/* Scene units of one unit of u and of v in exemplars[k]. */
static inline otx_vec2
otx_source_unit(
    const otx_mapping *mapping, const otx_exemplar *exemplars, int32_t k)
{
    const double width = exemplars[0].match.width;

    return (otx_vec2){
        mapping->scale * (exemplars[k].match.width / width),
        mapping->scale * exemplars[k].match.height / width};
}

#endif

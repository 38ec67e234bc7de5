/* mapping_check.h -- does a mapping hold what everything behind it relies on?
 *
 * Bakes, exports, pictures and figures index arrays by what a method returns.
 * The driver therefore checks every mapping in every build before anybody sees
 * it: a method that returns rubbish ends as an internal error, and nothing is
 * written. One pass over the corners; nothing is allocated. */
#ifndef OTX_MAPPING_MAPPING_CHECK_H
#define OTX_MAPPING_MAPPING_CHECK_H

#include "base/run.h"
#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

/* Checks, in this order, of a finished mapping:
 *
 * - shape: arrays are there, the scale is a positive number, and its surface
 *   has the faces of the one that was to be covered;
 * - range: patches are numbered from 0 to patch_count - 1, of which there are
 *   no more than faces; each takes from an exemplar that exists;
 * - coverage: every face that is no hole has a patch, no hole has one;
 * - finite: every UV, also of lookups, whose weights sum to 1 at each corner;
 * - inside: no UV lies more than half a texel beyond an exemplar that does not
 *   tile along that axis, but those of lookups over one another;
 * - winding: no more than a quarter of the area shows the exemplar reversed.
 *   Less than that is a defect of the texture, not of the program, as with
 *   coordinates that have dislocations: it is a warning;
 * - folds: a warning where faces have a corner that is reversed alone.
 *
 *   surface    that was to be covered; mapping->surface may be a copy of it
 *              whose points differ
 *   exemplars  [exemplar_count] that the method was given
 *   method     its name, for the sentence
 *
 * INTERNAL, with the face, for the first thing that does not hold. */
otx_status otx_mapping_check(
    otx_run *run, const otx_mapping *mapping, const otx_surface *surface,
    const otx_exemplar *exemplars, int32_t exemplar_count, const char *method);

/* The same of a mapping that was read from the file `path`: FORMAT, since the
 * file is damaged. */
otx_status otx_mapping_check_file(
    otx_run *run, const otx_mapping *mapping, const otx_surface *surface,
    const otx_exemplar *exemplars, int32_t exemplar_count, const char *path);

#endif

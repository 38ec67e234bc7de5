/* rehearsal.h -- everything of a mapping but the mapping. */
#ifndef OTX_API_REHEARSAL_H
#define OTX_API_REHEARSAL_H

#include "api/handle.h"

/* Reads constraints, masks and settings, divides the surface between exemplars
 * and chooses the method, as osdtex_map will, but on a draft (surface/draft.h).
 * Says nothing but what would be refused: the rest the mapping says itself.
 *
 *   request  as resolved
 *   method   its name, static, out */
otx_status otx_rehearse_map(
    otx_run *run, const osdtex_cage *cage, const otx_surface *draft,
    const osdtex_exemplar *exemplar, const osdtex_map_options *options,
    const otx_map_request *request, const char **method);

#endif

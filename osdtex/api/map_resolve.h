/* map_resolve.h -- what a host asks of a mapping, with defaults filled in and
 * what cannot be refused: for the mapping itself and for what looks ahead. */
#ifndef OTX_API_MAP_RESOLVE_H
#define OTX_API_MAP_RESOLVE_H

#include "api/handle.h"

/* The level, 0 to OTX_LEVEL_MAX. ARGUMENT.
 *
 *   leaf_edge  scene units that leaf edges are to come to where the options
 *              leave the level open; 0: what suits most exemplars */
otx_status otx_resolve_level(
    otx_run *run, const osdtex_cage *cage,
    const osdtex_surface_options *options, double leaf_edge, int32_t *out);

/* The exemplar's width in scene units, before cropping; says so where it is
 * chosen here. ARGUMENT. */
otx_status otx_resolve_scale(
    otx_run *run, const osdtex_cage_info *cage, double asked, double *out);

/* Scale, of what was cropped out of the picture, and first patch. ARGUMENT. */
otx_status otx_resolve_request(
    otx_run *run, const osdtex_cage *cage, const osdtex_exemplar_info *exemplar,
    const osdtex_map_options *options, otx_map_request *out);

/* By name; the first of the table for NULL. ARGUMENT, with near names. */
otx_status
otx_resolve_method(otx_run *run, const char *name, const otx_method **out);

#endif

/* heal_call.h -- a mapping whose seams are mended. */
#ifndef OTX_API_HEAL_CALL_H
#define OTX_API_HEAL_CALL_H

#include "api/mapping_handle.h"

/* Mends the seams of a mapping that is complete, over a band of so many texels,
 * and says so in its figures.
 *
 *   band  as osdtex_map_options.heal
 *
 * ARGUMENT, CANCELLED, MEMORY. */
otx_status otx_heal_call(otx_run *run, double band, osdtex_mapping *handle);

#endif

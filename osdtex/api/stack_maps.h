/* stack_maps.h -- the maps of several materials, brought into one order. */
#ifndef OTX_API_STACK_MAPS_H
#define OTX_API_STACK_MAPS_H

#include "exemplar/exemplar.h"

/* Gives each of the exemplars, whose maps are of their pictures' sizes, all
 * kinds of maps that any has, in one order of channels, in run->arena: what one
 * lacks is flat and neutral, which is said. MEMORY. */
otx_status
otx_stack_maps_align(otx_run *run, otx_exemplar *exemplars, int32_t count);

#endif

/* stack_maps.h -- the maps of several materials, brought into one order. */
#ifndef OTX_API_STACK_MAPS_H
#define OTX_API_STACK_MAPS_H

#include "exemplar/companions.h"

/* The maps of a picture, of its size. */
typedef struct otx_stack_maps
{
    otx_companions *companions;
    const char *path; /* of the picture, for findings */
} otx_stack_maps;

/* Gives each of the sets all kinds of maps that any has, in one order of
 * channels, in run->arena: what one lacks is flat and neutral, which is said.
 *
 *   width, height  of all
 *
 * MEMORY. */
otx_status otx_stack_maps_align(
    otx_run *run, const otx_stack_maps *sets, int32_t count, int32_t width,
    int32_t height);

#endif

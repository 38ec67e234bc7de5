/* radial.h -- a mask that is an outline as seen from its middle.
 *
 * A few hundred bytes instead of a picture, and sharp at any distance. */
#ifndef OTX_MAPPING_RADIAL_H
#define OTX_MAPPING_RADIAL_H

#include "math/vec.h"

enum
{
    OTX_RADIAL_ANGLES = 160
};

/* Lengths from the middle outwards, at equal angles from the x axis on. */
typedef struct otx_radial
{
    float radius[OTX_RADIAL_ANGLES];
    float feather; /* over which it falls from 1 inside to 0 at the outline */
    float least, most; /* of the radii: see otx_radial_bound */
} otx_radial;

/* Finds the least and the greatest radius, once the others are there. */
void otx_radial_bound(otx_radial *radial);

/* The radius in a direction, linear between angles. */
double otx_radial_at(const otx_radial *radial, otx_vec2 direction);

/* What the mask leaves at a place, filtered over `width`. */
double otx_radial_alpha(const otx_radial *radial, otx_vec2 at, double width);

#endif

/* unit.h -- from the scale that is asked for to texels per scene unit.
 *
 * The scale is the width of the (first) exemplar on the surface, in scene
 * units. Lengths on the surface are compared with lengths in the exemplar in
 * texels: as many to a scene unit as this says, in every exemplar of a mapping.
 * Nobody else divides by a scale. */
#ifndef OTX_SEAM_UNIT_H
#define OTX_SEAM_UNIT_H

#include "exemplar/exemplar.h"

/* Texels per scene unit.
 *
 *   first  the exemplar that the scale belongs to
 *   scale  scene units, > 0 */
static inline double
otx_unit_texels(const otx_exemplar *first, double scale)
{
    return first->match.width / scale;
}

/* The scale at which `first` has as many texels to a scene unit. */
static inline double
otx_unit_scale(const otx_exemplar *first, double texels)
{
    return first->match.width / texels;
}

#endif

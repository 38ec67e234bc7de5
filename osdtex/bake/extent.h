/* extent.h -- how wide and high the block of a face of the cage should be.
 *
 * The corners of a face have fixed places in the unit square: a quad fills it,
 * a triangle takes half of it, others are regular. What the face measures
 * along the two axes of that square, on the limit surface, are the block's
 * sides: long faces get long blocks, so that texels are about square on the
 * surface, and the part of a block that shows has the texels of the face's
 * area, or more of them where the face's leaves are of uneven size. */
#ifndef OTX_BAKE_EXTENT_H
#define OTX_BAKE_EXTENT_H

#include "math/vec.h"
#include "surface/surface.h"

/* Corner k of a face of n in the unit square. */
otx_vec2 otx_extent_corner(int32_t n, int32_t k);

/* Measures all faces of the cage.
 *
 *   extents  [cage face_count * 2] width and height in scene units, out
 *
 * MEMORY. */
otx_status
otx_extent_measure(otx_run *run, const otx_surface *surface, double *extents);

#endif

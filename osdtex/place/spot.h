/* spot.h -- a point on the surface, as those who place something name it. */
#ifndef OTX_PLACE_SPOT_H
#define OTX_PLACE_SPOT_H

#include "math/vec.h"
#include "surface/surface.h"

typedef struct otx_spot
{
    int32_t face;       /* of the leaf level, no hole; -1: there is none */
    int32_t corners[3]; /* of the level, a facet of that face */
    double at[3];       /* barycentric, sum 1, none negative */
    otx_vec3 point;     /* scene units */
    double distance;    /* from what was asked for, scene units */
} otx_spot;

/* The point of the leaf level that is nearest to another one. */
otx_spot otx_spot_nearest(const otx_surface *surface, otx_vec3 point);

/* The middle of a face of the cage, as it is subdivided. */
otx_spot otx_spot_of_face(const otx_surface *surface, int32_t cage_face);

/* A place in a leaf face by two numbers in [0, 1): as likely anywhere on it. */
otx_spot
otx_spot_within(const otx_surface *surface, int32_t face, const double by[2]);

#endif

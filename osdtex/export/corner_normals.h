/* corner_normals.h -- normals at the corners of leaf faces, as files store
 * them.
 *
 * A vertex has the normal of the limit surface. Where infinitely sharp creases
 * meet in it, it has one for each side of them. */
#ifndef OTX_EXPORT_CORNER_NORMALS_H
#define OTX_EXPORT_CORNER_NORMALS_H

#include "surface/surface.h"

typedef struct otx_corner_normals
{
    int32_t count;
    const float *normals;   /* [count * 3], unit, in the order of first use */
    const int32_t *indices; /* [leaf corner_count] */
} otx_corner_normals;

/* Sharp are the cage's creases of sharpness 10, and of a bilinear surface all
 * edges of the cage. Made in run->scratch. MEMORY. */
otx_status otx_corner_normals_build(
    otx_run *run, const otx_surface *surface, otx_corner_normals *out);

/* The same at the corners of the cage's faces: those of the leaf faces there.
 *
 *   out  indices are [cage corner_count] */
otx_status otx_corner_normals_of_cage(
    otx_run *run, const otx_surface *surface, otx_corner_normals *out);

#endif

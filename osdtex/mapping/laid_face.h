/* laid_face.h -- a leaf face laid into its plane, beside its UVs. */
#ifndef OTX_MAPPING_LAID_FACE_H
#define OTX_MAPPING_LAID_FACE_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

enum
{
    OTX_LAID_FACE_CORNERS = 64 /* longer faces are judged by their first */
};

typedef struct otx_laid_face
{
    int32_t size;
    otx_vec2 p[OTX_LAID_FACE_CORNERS]; /* on the surface, scene units; zeros
                                        * where the face has no plane */
    otx_vec2 q[OTX_LAID_FACE_CORNERS]; /* in the exemplar, scene units */
} otx_laid_face;

/* Lays a face of a mapping.
 *
 *   exemplar         that the face shows
 *   texels_per_unit  texels of it to a scene unit */
void otx_laid_face_set(
    const otx_mapping *mapping, const otx_exemplar *exemplar,
    double texels_per_unit, int32_t face, otx_laid_face *out);

/* Signed area of a polygon. */
double otx_laid_face_area(const otx_vec2 *points, int32_t count);

/* Whether a corner that is convex on the surface is reversed in UV, though the
 * face as a whole may not be. */
bool otx_laid_face_is_folded(const otx_laid_face *face);

#endif

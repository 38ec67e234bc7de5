/* uv_survey.h -- whether a cage's own UVs can be baked onto. */
#ifndef OTX_BAKE_UV_SURVEY_H
#define OTX_BAKE_UV_SURVEY_H

#include "surface/surface.h"

/* What is told of UVs, without holes and without faces that have no area on
 * the surface either. Places are faces of the cage, the first of their kind;
 * -1 none. */
typedef struct otx_uv_survey
{
    int32_t face_count;   /* of the surface's leaves */
    int32_t outside;      /* leaves that reach beyond the UDIM tiles */
    int32_t outside_face; /* the one farthest out */
    float outside_uv[2];  /* its farthest corner */
    int32_t flat;         /* leaves without area in UV */
    int32_t flat_face;
    double overlap;       /* share of the texture that several leaves claim */
    double depth;         /* leaves on a covered texel, in the mean */
    int32_t overlap_face; /* the first that lies on another */
    double side;          /* scene units that a tile's side covers, in the
                           * mean; 0: no area */
} otx_uv_survey;

/* Looks at all UVs of a surface that has some; of a draft it takes some
 * milliseconds. Overlaps are counted at up to 512 x 512 places a tile, and not
 * looked for where UVs leave the tiles. MEMORY. */
otx_status
otx_uv_survey_run(otx_run *run, const otx_surface *surface, otx_uv_survey *out);

/* Whether a face that is no hole reaches into a UDIM tile. */
bool otx_uv_survey_has_tile(const otx_surface *surface, int32_t tile);

#endif

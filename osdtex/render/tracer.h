/* tracer.h -- which triangle a ray meets: Embree 3 behind a few lines of C.
 *
 * The model is moved and scaled into the unit ball first, so that rays keep
 * their precision wherever the artist put it and offsets along rays are
 * constants. Everything below is in units of that ball.
 *
 * Only rtcIntersect1 and rtcOccluded1 are used: packets round differently, and
 * the same ray must give the same bits whatever its neighbours are. */
#ifndef OTX_RENDER_TRACER_H
#define OTX_RENDER_TRACER_H

#include "render/scene.h"

typedef struct otx_tracer otx_tracer;

/* A point of a triangle of the model. */
typedef struct otx_hit
{
    int32_t face;
    int32_t corners[3]; /* indices into the scene's corners */
    double weights[3];  /* sum 1 */
    otx_vec3 points[3]; /* of the corners */
    otx_vec3 at;
    otx_vec3 normal; /* unit, by the winding */
} otx_hit;

/* Builds the tree over the faces that are no holes, which are fans about their
 * first corner (surface/facet.h). The tracer lives in run->scratch and borrows
 * `scene`, which must be valid. MEMORY; NUMERIC when Embree refuses. */
otx_status
otx_tracer_create(otx_run *run, const otx_scene *scene, otx_tracer **out);

/* A position of the scene in the tracer's units. */
otx_vec3 otx_tracer_inside(const otx_tracer *tracer, otx_vec3 point);

/* The first triangle along a ray of unit direction. May be called from several
 * threads. */
bool otx_tracer_hit(
    const otx_tracer *tracer, otx_vec3 origin, otx_vec3 direction,
    otx_hit *out);

/* Whether anything is met before `distance`. */
bool otx_tracer_occluded(
    const otx_tracer *tracer, otx_vec3 origin, otx_vec3 direction,
    double distance);

#endif

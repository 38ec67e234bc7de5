/* stroll.h -- straight ways over a mesh, from a vertex on. */
#ifndef OTX_METHOD_VERTEX_STROLL_H
#define OTX_METHOD_VERTEX_STROLL_H

#include "method/vertex/turk.h"
#include "surface/facet.h"

typedef struct otx_stroll
{
    const otx_turk_mesh *mesh;
    const float *points;
    otx_facet facet;
    otx_vec3 at;
    otx_vec3 heading; /* unit, in the facet's plane */
    bool ended;       /* at a border, where it stays */
} otx_stroll;

/* At a vertex, towards a direction that its tangent plane has. False where
 * there is no face with area. */
bool otx_stroll_begin(
    const otx_turk_mesh *mesh, const float *points, int32_t vertex,
    otx_vec3 heading, otx_stroll *out);

/* By an angle of (cos, sin) to the left, seen from outside. */
void otx_stroll_turn(otx_stroll *stroll, double c, double s);

/* On, over faces and the edges between them, which are unfolded. */
void otx_stroll_go(otx_stroll *stroll, double length);

/* Values of vertices, linear in the facet. */
otx_quad otx_stroll_look(const otx_stroll *stroll, const otx_quad *values);

#endif

/* connection.h -- tangent planes of faces, and how they turn into each other.
 *
 * A tangent vector of a face is a complex number in a frame of the face's
 * plane. Unfolding two faces about their common edge carries a vector from
 * one frame to the other: it turns by the edge's `turn`. What is left of a
 * turn all around a vertex is the angle defect there, so that on a closed
 * surface the defects sum to 2 pi times its Euler characteristic, exactly.
 *
 * Faces carry the directions, not vertices: a crease has two faces but no
 * tangent plane. See docs/notes/field.md. */
#ifndef OTX_FIELD_CONNECTION_H
#define OTX_FIELD_CONNECTION_H

#include "base/run.h"
#include "math/vec.h"
#include "surface/surface.h"

typedef struct otx_connection
{
    const otx_surface *surface;
    const otx_level *level;
    int32_t level_index;
    otx_vec3 *centres; /* [face_count] */
    otx_vec3 *normals; /* [face_count], unit */
    otx_vec3 *axes;    /* [face_count], unit, the frame's real axis */
    double *areas;     /* [face_count], scene units squared; 0 on holes */
    double area;       /* of all */

    /* [corner_count] half-edge k -> k + 1 in the frame of its face. */
    otx_vec2 *sides;

    /* Of edges, 0 where the edge has no second face or one is a hole. */
    double *turns;   /* [edge_count] radians, from the first face's frame to
                      * the second's, in (-pi, pi] */
    double *weights; /* [edge_count] edge length / distance of the faces'
                      * centres across it: the Laplacian's weights on faces,
                      * their inverses those on vertices */
    uint8_t *inner;  /* [edge_count] 1: between two faces that are no holes */
} otx_connection;

/* Of `level`, whose vertices are taken on the limit surface. In run->arena.
 * MEMORY. */
otx_status otx_connection_build(
    otx_run *run, const otx_surface *surface, int32_t level,
    otx_connection *out);

/* The vector of the plane of `face` that `flat` stands for. */
otx_vec3
otx_connection_lift(const otx_connection *c, int32_t face, otx_vec2 flat);

/* The part of `vector` in the plane of `face`, in its frame. */
otx_vec2
otx_connection_project(const otx_connection *c, int32_t face, otx_vec3 vector);

/* The corner of `face` at which its half-edge along `edge` starts. */
int32_t
otx_connection_corner(const otx_connection *c, int32_t edge, int32_t face);

/* Angle defects: 2 pi minus the corner angles around each vertex, [vert_count]
 * in run->arena; NAN where the vertex is not inside. MEMORY. */
otx_status
otx_connection_defects(otx_run *run, const otx_connection *c, double **out);

#endif

/* turk.h -- texture on the vertices of nested meshes, as published [Turk01].
 *
 * The hierarchy of points is the levels of a refinement to edges of about a
 * texel: vertex v of a level is vertex v of all finer ones, and every level has
 * four times the vertices of the one before. Levels count from the finest. */
#ifndef OTX_METHOD_VERTEX_TURK_H
#define OTX_METHOD_VERTEX_TURK_H

#include "method/vertex/vertex.h"

enum
{
    OTX_TURK_LEVELS = 4
};

/* A mesh of the hierarchy. */
typedef struct otx_turk_mesh
{
    const otx_level *level;
    int32_t count;       /* vertices */
    int32_t *face_first; /* [count + 2] into faces */
    int32_t *faces;      /* around each vertex */
    int32_t *near_first; /* [count + 2] into near, near_weights */
    int32_t *near;       /* vertices that an edge joins */
    float *near_weights; /* inverse lengths of these edges, sum 1 */
    otx_quad *colors;    /* [count] C_k: Lab */
    int32_t *pixels;     /* [count] of the pattern's level that these are of */
} otx_turk_mesh;

typedef struct otx_turk
{
    otx_run *run;
    const otx_surface *surface; /* refined to texels */
    const otx_guide *guide;     /* of the faces of `coarse` */
    const otx_surface *coarse;  /* that is textured */
    otx_pattern pattern;        /* G */
    double texels;              /* per scene unit */
    int32_t mesh_count;
    otx_turk_mesh meshes[OTX_TURK_LEVELS];
    otx_vec3 *down;  /* [vertices] O: where the picture's v falls, unit */
    double *sweep;   /* [vertices] s, scene units */
    int32_t *order;  /* [vertices] by s */
    otx_quad *above; /* [vertices] the coarser mesh's colours, interpolated */
} otx_turk;

/* Meshes with the relations of their vertices, and the directions on them, in
 * run->scratch. LIMIT where there would be too many, MEMORY. */
otx_status otx_turk_build(const otx_vertex *v, otx_turk *out);

/* Eq. 4: `values` drawn to those of its neighbours by t.
 *
 *   to  [mesh->count] */
void otx_turk_smooth(
    const otx_turk_mesh *mesh, double t, const otx_quad *values, otx_quad *to);

/* Eq. 1 at the vertices that a mesh has more than the coarser one: the mean of
 * the ends of the edge, or the corners of the face, that they are in.
 *
 *   values  [mesh->count], of which the first are given */
void otx_turk_interpolate(
    const otx_turk_mesh *coarser, int32_t count, otx_quad *values);

/* Sweep distances (eq. 5) and the order by them. CANCELLED, MEMORY. */
otx_status otx_turk_sweep(otx_turk *t);

/* All passes. CANCELLED, MEMORY. */
otx_status otx_turk_run(otx_turk *t);

/* Every texel of v's charts shows the place of the vertex nearest to it, gone
 * on with. MEMORY, CANCELLED. */
otx_status otx_turk_spread(const otx_turk *t, otx_vertex *v);

/* By the method as published. */
otx_status otx_turk_make(otx_vertex *v);

#endif

/* rigid.h -- the as-rigid-as-possible energy of triangles in the plane.
 *
 * E = sum over triangles and their edges of w |(u_i - u_j) - R (q_i - q_j)|^2,
 * with q the triangle laid out in its own plane, w half the cotangent opposite
 * the edge and R the triangle's best rotation [Liu08, eq. 3]. With the
 * rotations fixed it is quadratic, with a cotangent Laplacian as matrix. Both
 * the flattening of charts and the relaxation of whole mappings solve it. */
#ifndef OTX_FLATTEN_RIGID_H
#define OTX_FLATTEN_RIGID_H

#include "base/pool.h"
#include "math/vec.h"

/* Faces (fans of triangles are made of them) over local vertices. */
typedef struct otx_rigid_mesh
{
    int32_t face_count;
    int32_t vert_count;
    const int32_t *first;   /* [face_count + 1] */
    const int32_t *corners; /* local vertices */
    const int32_t *verts;   /* [vert_count] index into points */
    const float *points;    /* surface, 3 per point, scene units */
    double texels;          /* per scene unit */
    const float *density;   /* like points; NULL: 1. See otx_surface */
} otx_rigid_mesh;

typedef struct otx_rigid_triangle
{
    int32_t v[3];
    otx_vec2 q[3]; /* laid out in its own plane, texels */
    double w[3];   /* half the cotangent opposite edge (v[k], v[k+1]) */
} otx_rigid_triangle;

typedef struct otx_rigid
{
    int32_t vert_count;
    int32_t triangle_count;
    otx_rigid_triangle *triangles;
    /* Off-diagonal of the Laplacian, positive. */
    int32_t *row; /* [vert_count + 1] */
    int32_t *column;
    double *weight;
    double *diagonal;
} otx_rigid;

/* In `arena`. MEMORY, without a finding. */
otx_status
otx_rigid_build(otx_arena *arena, const otx_rigid_mesh *mesh, otx_rigid *out);

/* b = sum of w R (q_i - q_j), with the rotations that are best for `flat`. */
void otx_rigid_pull(const otx_rigid *rigid, const otx_vec2 *flat, otx_vec2 *b);

/* For those who share the same sums among threads: the corners around each
 * vertex, in the order of the triangles. */
typedef struct otx_rigid_fans
{
    int32_t *first;   /* [vert_count + 1] */
    int32_t *corners; /* 3 * triangle + corner */
    otx_vec2 *turns;  /* [triangle_count] best rotations */
} otx_rigid_fans;

/* In `arena`. MEMORY, without a finding. */
otx_status otx_rigid_fans_build(
    otx_arena *arena, const otx_rigid *rigid, otx_rigid_fans *out);

/* The rotations of the triangles [first, end) that are best for `flat`. */
void otx_rigid_fans_turn(
    const otx_rigid *rigid, const otx_vec2 *flat, int32_t first, int32_t end,
    otx_rigid_fans *fans);

/* b of the rows [first, end), with all rotations: the bits of otx_rigid_pull.
 */
void otx_rigid_fans_pull(
    const otx_rigid *rigid, const otx_rigid_fans *fans, int32_t first,
    int32_t end, otx_vec2 *b);

/* out = Laplacian x, of the rows [first, end) */
void otx_rigid_apply(
    const otx_rigid *rigid, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out);

/* Conjugate gradients on a symmetric positive semi-definite system of `count`
 * points, Jacobi preconditioned, from the x that is given. */
typedef struct otx_rigid_system
{
    int32_t count;
    /* out = A x, of the rows [first, end) */
    void (*apply)(
        const void *context, const otx_vec2 *x, int32_t first, int32_t end,
        otx_vec2 *out);
    const void *context;
    const otx_vec2 *diagonal; /* [count], positive */
    int32_t rounds;           /* at most */
    double tolerance;         /* of the first residual */
    otx_pool *pool; /* to share the rows; NULL: this thread. Same bits. */
    const otx_worker *worker; /* without a pool: asked whether to stop; NULL */
} otx_rigid_system;

/* MEMORY, without a finding; CANCELLED. */
otx_status otx_rigid_solve(
    otx_arena *scratch, const otx_rigid_system *system, const otx_vec2 *b,
    otx_vec2 *x);

#endif

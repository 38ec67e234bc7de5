/* direction.h -- the smoothest direction field, or the one that is asked for
 * (direction_solve.c), made smoother (direction_smooth.c) and handed from level
 * to level (direction.c).
 *
 * A direction of symmetry s (1 an arrow, 2 a line, 4 a cross) is kept as the
 * s-th power of a unit complex number, z = e^(i s theta), in the frame of its
 * face: powers can be averaged. The energy is that of the connection Laplacian
 * [Knoeppel13],
 *
 *     E(z) = sum over edges of w |z_g - e^(i s turn) z_f|^2.
 *
 * Its smallest eigenvector has singularities where the shape asks for them.
 * Pins hold faces to a direction; a pull attracts all faces to theirs. The
 * result is made unit by alternating smoothing and normalising [Viertel19],
 * which also lets close singularities of opposite index meet and vanish.
 *
 * [Knoeppel13] Knoeppel, Crane, Pinkall, Schroeder: Globally optimal direction
 * fields. SIGGRAPH.
 * [Viertel19] Viertel, Osting: An approach to quad meshing based on harmonic
 * cross-valued maps. */
#ifndef OTX_FIELD_DIRECTION_H
#define OTX_FIELD_DIRECTION_H

#include "field/connection.h"

/* A face that is held to a direction. */
typedef struct otx_direction_pin
{
    int32_t face;    /* of the connection's level */
    otx_vec3 vector; /* its part in the plane of the face counts */
} otx_direction_pin;

typedef struct otx_direction_request
{
    int32_t symmetry; /* 1, 2 or 4 */
    int32_t pin_count;
    const otx_direction_pin *pins; /* of several on one face, the last holds */

    /* [face_count] what attracts, see attract.h; NULL: nothing. It gives way
     * over about pull_length scene units, > 0. */
    const otx_vec2 *pull;
    double pull_length;
    /* Towards what the smoothest field leans where it may choose; zero: the
     * y axis. */
    otx_vec3 lean;
} otx_direction_request;

typedef struct otx_direction
{
    const otx_connection *connection;
    int32_t symmetry;
    otx_vec2 *powers; /* [face_count] unit; (1, 0) on holes */
} otx_direction;

/* Whether a request makes sense on a level. ARGUMENT for a symmetry other than
 * 1, 2, 4, a pin on a hole or outside the level, or one whose vector is not
 * finite or stands upright on its face. */
otx_status otx_direction_check(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request);

/* Solves for a field. Where neither pins nor a pull say anything about a
 * component of the surface, it gets its smoothest field. In run->arena.
 *
 * ARGUMENT as otx_direction_check; NUMERIC, MEMORY, CANCELLED. */
otx_status otx_direction_solve(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request, otx_direction *out);

/* Solves again for the faces of `effect` ([face_count], 1 free), all others
 * keep what they have. */
otx_status otx_direction_edit(
    otx_run *run, const otx_direction_request *request, const uint8_t *effect,
    otx_direction *field);

/* The field whose direction on each face is the part of `vectors`
 * ([face_count]) along it; faces without one continue their neighbours. In
 * run->arena. Errors as above. */
otx_status otx_direction_from_vectors(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const otx_vec3 *vectors, otx_direction *out);

/* The s-th power of a vector of a plane, its length kept. */
otx_vec2 otx_direction_power(otx_vec2 vector, int32_t symmetry);

/* `z` made unit; `otherwise` where that cannot be done. */
otx_vec2 otx_direction_unit(otx_vec2 z, otx_vec2 otherwise);

/* Angle of one representative, in (-pi / s, pi / s] of the face's frame. */
static inline double
otx_direction_angle(const otx_direction *field, int32_t face)
{
    const otx_vec2 z = field->powers[face];

    return atan2(z.y, z.x) / field->symmetry;
}

/* The same as a unit vector of the surface. */
static inline otx_vec3
otx_direction_vector(const otx_direction *field, int32_t face)
{
    return otx_connection_lift(
        field->connection, face,
        otx_vec2_polar(otx_direction_angle(field, face)));
}

/* How far the field turns across an inner edge, against parallel transport
 * from its first face to its second: radians in (-pi / s, pi / s]. */
double otx_direction_turn(const otx_direction *field, int32_t edge);

/* Turns every free face towards the mean of its neighbours and the pull,
 * `rounds` times over: what is rough becomes smooth, what is smooth stays as
 * it is. Pins hold. MEMORY. */
otx_status otx_direction_smooth(
    otx_run *run, const otx_direction_request *request, int32_t rounds,
    otx_direction *field);

/* Hands a field on to a coarser level: means over the faces below. MEMORY. */
otx_status otx_direction_coarsen(
    otx_run *run, const otx_direction *field, const otx_connection *coarser,
    otx_direction *out);

/* Hands a field on to a finer level of the same surface. MEMORY. */
otx_status otx_direction_refine(
    otx_run *run, const otx_direction *field, const otx_connection *finer,
    otx_direction *out);

#endif

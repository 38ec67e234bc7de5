/* rings.c -- where periodic coordinates are no texture coordinates. */
#include "periodic/rings.h"

/* Squared departure from the gradient that is asked for, of its square. */
static const double DISTORTED = 0.5;

/* Steps of two faces along their edge that differ by more do not match. */
static const double SAME = 1e-3;

/* Gradients of both coordinates in a face, cells per scene unit, by least
 * squares over its sides; false where there are none. */
static bool
measure_gradients(const otx_phase *phase, int32_t face, otx_vec2 out[2])
{
    const otx_connection *c = phase->connection;
    const int32_t first = c->level->face_first[face];
    const int32_t size = otx_level_face_size(c->level, face);
    double xx = 0.0, xy = 0.0, yy = 0.0, det;
    otx_vec2 b[2] = {{0, 0}, {0, 0}};

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec2 d = c->sides[first + k];
        const otx_vec2 step = otx_vec2_sub(
            phase->cells[first + (k + 1) % size], phase->cells[first + k]);

        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        b[0] = otx_vec2_add(b[0], otx_vec2_scale(step.x, d));
        b[1] = otx_vec2_add(b[1], otx_vec2_scale(step.y, d));
    }
    det = xx * yy - xy * xy;
    for (int axis = 0; axis < 2; ++axis)
        out[axis] = (otx_vec2){
            (yy * b[axis].x - xy * b[axis].y) / det,
            (xx * b[axis].y - xy * b[axis].x) / det};
    return det > 1e-12 * (xx + yy) * (xx + yy);
}

/* The first criterion. Either sense of the face will do, but one for both. */
static bool
is_distorted(
    const otx_phase *phase, const otx_phase_request *request, int32_t face)
{
    const otx_level *level = phase->connection->level;
    const otx_vec2 turn =
        otx_vec2_polar(otx_direction_angle(request->field, face));
    const int32_t size = otx_level_face_size(level, face);
    double log_scale = 0.0, agree = 0.0;
    otx_vec2 is[2], asked[2];

    if (level->face_hole[face])
        return false;
    if (!measure_gradients(phase, face, is))
        return true;
    for (int32_t k = 0; k < size; ++k)
        log_scale +=
            request->log_scale[level->face_verts[level->face_first[face] + k]] /
            size;
    for (int axis = 0; axis < 2; ++axis)
    {
        asked[axis] = otx_vec2_scale(
            exp(log_scale), otx_vec2_mul(turn, request->gradient[axis]));
        agree += otx_vec2_dot(is[axis], asked[axis]);
    }
    for (int axis = 0; axis < 2; ++axis)
    {
        const otx_vec2 off = otx_vec2_sub(
            otx_vec2_scale(agree < 0.0 ? -1.0 : 1.0, is[axis]), asked[axis]);

        if (!(otx_vec2_dot(off, off) <=
              DISTORTED * otx_vec2_dot(asked[axis], asked[axis])))
            return true;
    }
    return false;
}

/* Cells along an edge as a face has them, in the direction of edge_verts. */
static otx_vec2
step_along(const otx_phase *phase, int32_t face, int32_t edge)
{
    const otx_level *level = phase->connection->level;
    const int32_t *v = level->edge_verts + 2 * (size_t)edge;
    otx_vec2 ends[2] = {{0, 0}, {0, 0}};

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        for (int k = 0; k < 2; ++k)
            if (level->face_verts[i] == v[k])
                ends[k] = phase->cells[i];
    return otx_vec2_sub(ends[1], ends[0]);
}

/* The second criterion, up to the senses of the faces. */
static bool
is_mismatched(const otx_phase *phase, int32_t edge)
{
    const int32_t *faces =
        phase->connection->level->edge_faces + 2 * (size_t)edge;
    otx_vec2 a, b, minus, plus;

    if (!phase->connection->inner[edge])
        return false;
    a = step_along(phase, faces[0], edge);
    b = step_along(phase, faces[1], edge);
    minus = otx_vec2_sub(a, b);
    plus = otx_vec2_add(a, b);
    return !(fabs(minus.x) < SAME && fabs(minus.y) < SAME) &&
           !(fabs(plus.x) < SAME && fabs(plus.y) < SAME);
}

otx_status
otx_rings_find(
    otx_run *run, const otx_phase *phase, const otx_phase_request *request,
    otx_rings *out)
{
    const otx_level *level = phase->connection->level;

    *out = (otx_rings){
        .singular = OTX_ZNEW(run->arena, uint8_t, level->vert_count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < level->face_count; ++f)
        if (is_distorted(phase, request, f))
            for (int32_t i = level->face_first[f]; i < level->face_first[f + 1];
                 ++i)
                out->singular[level->face_verts[i]] |= OTX_RING_DISTORTED;
    for (int32_t e = 0; e < level->edge_count; ++e)
        if (is_mismatched(phase, e))
            for (int k = 0; k < 2; ++k)
                out->singular[level->edge_verts[2 * (size_t)e + k]] |=
                    OTX_RING_MISMATCHED;
    for (int32_t v = 0; v < level->vert_count; ++v)
        out->count += out->singular[v] != 0;
    return OSDTEX_OK;
}

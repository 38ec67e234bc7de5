/* phase_edge.c -- steps of periodic coordinates along edges and round faces. */
#include "periodic/phase_edge.h"

void
otx_phase_edge_corners(
    const otx_connection *c, int32_t edge, int32_t corners[2])
{
    const int32_t face = c->level->edge_faces[2 * (size_t)edge];

    corners[0] = otx_connection_corner(c, edge, face);
    corners[1] = corners[0] + 1 == c->level->face_first[face + 1]
                     ? c->level->face_first[face]
                     : corners[0] + 1;
}

double
otx_phase_edge_weight(const otx_connection *c, int32_t edge)
{
    return c->inner[edge] ? 1.0 / c->weights[edge] : 0.5;
}

double
otx_phase_face_step(
    const otx_phase_solver *s, int32_t face, int32_t corner, int axis)
{
    const int32_t edge = s->c->level->face_edges[corner];

    return s->c->level->edge_faces[2 * (size_t)edge] == face
               ? s->step[axis][edge]
               : -s->phase->match[edge] * s->step[axis][edge];
}

int
otx_phase_charge(const otx_phase_solver *s, int32_t face, int axis)
{
    const otx_level *level = s->c->level;
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += otx_phase_face_step(s, face, i, axis);
    return (int)lround(sum);
}

int
otx_phase_orientation(const otx_phase_solver *s, int32_t face, int32_t edge)
{
    return s->c->level->edge_faces[2 * (size_t)edge] == face
               ? 1
               : -s->phase->match[edge];
}

bool
otx_phase_touches_singular(const otx_phase_solver *s, int32_t face)
{
    const otx_level *level = s->c->level;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        if (s->singular[level->face_verts[i]])
            return true;
    return false;
}

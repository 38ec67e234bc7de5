/* phase_check.c -- what holds of periodic coordinates once they are solved for.
 */
#include "periodic/phase_check.h"

#include <math.h>

/* Cells by which coordinates may be off whole ones. */
static const double WHOLE = 5e-3;

static bool
is_whole(double x)
{
    return fabs(x - round(x)) < WHOLE;
}

/* The corner of a face that has a vertex. */
static int32_t
corner_of(const otx_level *level, int32_t face, int32_t vertex)
{
    int32_t c = level->face_first[face];

    while (level->face_verts[c] != vertex)
        ++c;
    return c;
}

static bool
agrees(const otx_phase *phase, int32_t edge)
{
    const otx_level *level = phase->connection->level;
    const int32_t *faces = level->edge_faces + 2 * (size_t)edge;
    const double match = phase->match[edge];

    for (int k = 0; k < 2; ++k)
    {
        const int32_t v = level->edge_verts[2 * (size_t)edge + (size_t)k];
        const otx_vec2 a = phase->cells[corner_of(level, faces[0], v)];
        const otx_vec2 b = phase->cells[corner_of(level, faces[1], v)];

        if (!is_whole(a.x - match * b.x) || !is_whole(a.y - match * b.y))
            return false;
    }
    return true;
}

const char *
otx_phase_check(const otx_phase *phase)
{
    const otx_connection *c = phase->connection;
    const otx_level *level = c->level;
    int32_t defects = 0;

    for (int32_t i = 0; i < level->corner_count; ++i)
        if (!isfinite(phase->cells[i].x) || !isfinite(phase->cells[i].y))
            return "cells are not finite";
    for (int32_t f = 0; f < level->face_count; ++f)
        defects += phase->defect[f];
    if (defects != phase->defect_count)
        return "defects are not counted";
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * (size_t)e;

        if (c->inner[e] && !phase->defect[faces[0]] &&
            !phase->defect[faces[1]] && !agrees(phase, e))
            return "cells of neighbours differ by parts of cells";
    }
    return NULL;
}

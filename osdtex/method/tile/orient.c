/* orient.c -- turns of the quads from edge loops or from an axis. */
#include "method/tile/orient.h"
#include "math/vec.h"

#include <string.h>

enum
{
    UNSEEN = 255
};

static const char STAGE[] = "map";

static int32_t
index_of_edge(const otx_level *level, int32_t face, int32_t edge)
{
    for (int32_t i = 0; i < 4; ++i)
        if (level->face_edges[4 * (size_t)face + (size_t)i] == edge)
            return i;
    return 0;
}

/* The turns of the face beyond edge `i` of `face` with which they agree. */
static uint8_t
agreeing(
    const otx_level *level, int32_t face, int32_t i, int32_t turns,
    int32_t other)
{
    const int32_t edge = level->face_edges[4 * (size_t)face + (size_t)i];

    return (uint8_t)((index_of_edge(level, other, edge) - (i - turns + 2)) & 3);
}

/* Notes edges between rows and columns, and the vertices that cause them. */
static otx_status
note_conflicts(
    otx_run *run, const otx_surface *surface, const otx_level *level,
    const uint8_t *turns, bool by_vertex)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    uint8_t *parity = OTX_ZNEW(run->scratch, uint8_t, level->vert_count);
    int64_t edges = 0, vertices = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * (size_t)e;
        const int32_t *verts = level->edge_verts + 2 * (size_t)e;

        parity[verts[0]] ^= 1;
        parity[verts[1]] ^= 1;
        /* A rim vertex is never singular. */
        if (faces[1] < 0)
            parity[verts[0]] = parity[verts[1]] = 2;
        else if (
            ((turns[faces[1]] - agreeing(
                                    level, faces[0],
                                    index_of_edge(level, faces[0], e),
                                    turns[faces[0]], faces[1])) &
             1) != 0)
            ++edges;
    }
    for (int32_t v = 0; by_vertex && v < level->vert_count; ++v)
        if (parity[v] == 1)
        {
            ++vertices;
            otx_note(
                run, OSDTEX_SEVERITY_INFO, STAGE,
                (otx_where){surface->cage->path, 0, -1, v},
                "an odd number of faces meets here, so that rows of tiles "
                "meet columns around this vertex");
        }
    if (edges > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
            "no orientation is consistent on all of the surface: rows of "
            "tiles meet columns along %lld of %d edges",
            (long long)edges, (int)level->edge_count);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_orient_walk(otx_run *run, const otx_level *l, uint8_t *turns)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *queue = OTX_NEW(run->scratch, int32_t, l->face_count);

    OTX_TRY(otx_run_ok(run));
    memset(turns, UNSEEN, (size_t)l->face_count);
    for (int32_t start = 0; start < l->face_count; ++start)
    {
        int32_t first = 0, end = 0;

        if (turns[start] != UNSEEN)
            continue;
        turns[start] = 0;
        for (queue[end++] = start; first < end; ++first)
            for (int32_t i = 0; i < 4; ++i)
            {
                const int32_t face = queue[first];
                const int32_t other = otx_level_neighbour(l, face, i);

                if (other < 0 || turns[other] != UNSEEN)
                    continue;
                turns[other] = agreeing(l, face, i, turns[face], other);
                queue[end++] = other;
            }
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

void
otx_orient_find_whole(
    const otx_level *level, const uint8_t *turns, uint8_t *whole)
{
    memset(whole, 1, (size_t)level->vert_count);
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * (size_t)e;
        const int32_t *verts = level->edge_verts + 2 * (size_t)e;

        if (faces[0] < 0 || faces[1] < 0 ||
            turns[faces[1]] == agreeing(
                                   level, faces[0],
                                   index_of_edge(level, faces[0], e),
                                   turns[faces[0]], faces[1]))
            continue;
        whole[verts[0]] = whole[verts[1]] = 0;
    }
}

otx_status
otx_orient_loops(
    otx_run *run, const otx_surface *surface, int32_t level, uint8_t *turns)
{
    const otx_level *l = &surface->levels[level];

    OTX_TRY(otx_orient_walk(run, l, turns));
    return note_conflicts(run, surface, l, turns, true);
}

otx_status
otx_orient_axis(
    otx_run *run, const otx_surface *surface, int32_t level, int32_t axis,
    uint8_t *turns)
{
    const otx_level *l = &surface->levels[level];

    for (int32_t face = 0; face < l->face_count; ++face)
    {
        const int32_t *verts = l->face_verts + 4 * (size_t)face;
        otx_vec3 p[4], u, v;
        double rise[4];

        for (int32_t i = 0; i < 4; ++i)
            p[i] = otx_vec3_load(surface->points, verts[i]);
        u = otx_vec3_unit(
            otx_vec3_sub(otx_vec3_add(p[1], p[2]), otx_vec3_add(p[0], p[3])));
        v = otx_vec3_unit(
            otx_vec3_sub(otx_vec3_add(p[2], p[3]), otx_vec3_add(p[0], p[1])));
        rise[0] = axis == 0 ? v.x : axis == 1 ? v.y : v.z;
        rise[3] = axis == 0 ? u.x : axis == 1 ? u.y : u.z;
        rise[1] = -rise[3];
        rise[2] = -rise[0];
        turns[face] = 0;
        for (uint8_t r = 1; r < 4; ++r)
            if (rise[r] > rise[turns[face]])
                turns[face] = r;
    }
    return note_conflicts(run, surface, l, turns, false);
}

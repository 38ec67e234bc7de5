/* edge_distance.c -- Dijkstra's, over the vertices of a level. */
#include "surface/edge_distance.h"

#include "base/csr.h"
#include "base/pqueue.h"
#include "math/vec.h"
#include "surface/topology.h"

#include <math.h>
#include <string.h>

/* ---- which edges --------------------------------------------------------- */

/* How many of its faces are of the surface, and no holes. */
static int
solid_faces(const otx_level *level, int32_t edge)
{
    int count = 0;

    for (size_t k = 0; k < 2; ++k)
    {
        const int32_t face = level->edge_faces[2 * (size_t)edge + k];

        count += face >= 0 && !level->face_hole[face];
    }
    return count;
}

static void
mark_open(const otx_level *level, uint8_t *out)
{
    for (int32_t e = 0; e < level->edge_count; ++e)
        out[e] = solid_faces(level, e) == 1;
}

/* Those of the cage: its corners are those of level 0. */
static otx_status
mark_tagged(otx_run *run, const otx_surface *surface, uint8_t *out)
{
    const otx_cage *cage = surface->cage;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_topology t;
    uint8_t *tagged;

    if (!otx_topology_build(
            run->scratch, cage->vert_count, cage->face_count, cage->face_first,
            cage->face_verts, &t))
        return otx_run_ok(run);
    tagged = OTX_ZNEW(run->scratch, uint8_t, t.edge_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < cage->crease_count; ++i)
    {
        const int32_t *ends = cage->crease_verts + 2 * (size_t)i;
        const int32_t edge = otx_topology_find_edge(&t, ends[0], ends[1]);

        if (edge >= 0)
            tagged[edge] = cage->crease_sharpness[i] > 0.0f;
    }
    for (int32_t c = 0; c < t.corner_count; ++c)
        out[surface->levels[0].face_edges[c]] = tagged[t.corner_edge[c]];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* To the halves of edges that are marked: from an end, which keeps its number,
 * to the vertex born of the edge. */
static void
halve(
    const otx_level *from, const otx_level *to, const uint8_t *marked,
    int32_t *born_of, uint8_t *out)
{
    memset(born_of, -1, sizeof *born_of * (size_t)to->vert_count);
    for (int32_t e = 0; e < from->edge_count; ++e)
        if (marked[e])
            born_of[from->edge_child_vert[e]] = e;
    for (int32_t e = 0; e < to->edge_count; ++e)
        for (int32_t k = 0; k < 2; ++k)
        {
            const int32_t *ends = to->edge_verts + 2 * (size_t)e;
            const int32_t parent = born_of[ends[k]];
            const int32_t *of =
                parent < 0 ? NULL : from->edge_verts + 2 * (size_t)parent;

            if (of && (of[0] == ends[1 - k] || of[1] == ends[1 - k]))
                out[e] = 1;
        }
}

static otx_status
mark_creases(otx_run *run, const otx_surface *surface, uint8_t *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    uint8_t *next = OTX_ZNEW(run->scratch, uint8_t, leaf->edge_count);
    int32_t *born_of = OTX_NEW(run->scratch, int32_t, leaf->vert_count);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(mark_tagged(run, surface, out));
    for (int32_t k = 0; k + 1 < surface->level_count; ++k)
    {
        const otx_level *to = &surface->levels[k + 1];

        memset(next, 0, (size_t)to->edge_count);
        halve(&surface->levels[k], to, out, born_of, next);
        memcpy(out, next, (size_t)to->edge_count);
    }
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        out[e] = out[e] && solid_faces(leaf, e) > 0;
    return OSDTEX_OK;
}

otx_status
otx_edge_mark(
    otx_run *run, const otx_surface *surface, otx_edge_kind kind, uint8_t **out,
    int32_t *count)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    *count = 0;
    *out = OTX_ZNEW(run->scratch, uint8_t, leaf->edge_count);
    OTX_TRY(otx_run_ok(run));
    if (kind == OTX_EDGE_BOUNDARY)
        mark_open(leaf, *out);
    else
        OTX_TRY(mark_creases(run, surface, *out));
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        *count += (*out)[e];
    return OSDTEX_OK;
}

/* ---- how far ------------------------------------------------------------- */

typedef struct march
{
    const otx_surface *surface;
    const int32_t *first, *faces; /* around each vertex, without holes */
    otx_pqueue queue;
    double *out;
} march;

static otx_status
list_faces(otx_run *run, const otx_level *level, march *m)
{
    int32_t *first =
        OTX_ZNEW(run->scratch, int32_t, (int64_t)level->vert_count + 2);
    int32_t *faces = OTX_NEW(run->scratch, int32_t, level->corner_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t c = level->face_first[f];
             c < level->face_first[f + 1] && !level->face_hole[f]; ++c)
            otx_csr_count(first, level->face_verts[c], 1);
    otx_csr_sum(first, level->vert_count);
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t c = level->face_first[f];
             c < level->face_first[f + 1] && !level->face_hole[f]; ++c)
            faces[otx_csr_place(first, level->face_verts[c])] = f;
    m->first = first;
    m->faces = faces;
    return OSDTEX_OK;
}

static void
reach(march *m, int32_t vert, double distance)
{
    if (!(distance < m->out[vert]))
        return;
    m->out[vert] = distance;
    otx_pqueue_push(&m->queue, distance, vert);
}

static void
step_from(march *m, int32_t vert)
{
    const otx_level *level = otx_surface_leaf(m->surface);
    const otx_vec3 at = otx_vec3_load(m->surface->points, vert);

    for (int32_t i = m->first[vert]; i < m->first[vert + 1]; ++i)
    {
        const int32_t face = m->faces[i];

        for (int32_t c = level->face_first[face];
             c < level->face_first[face + 1]; ++c)
        {
            const int32_t other = level->face_verts[c];
            const otx_vec3 to = otx_vec3_load(m->surface->points, other);

            reach(
                m, other, m->out[vert] + otx_vec3_length(otx_vec3_sub(to, at)));
        }
    }
}

otx_status
otx_edge_distance(
    otx_run *run, const otx_surface *surface, const uint8_t *marked,
    double *out)
{
    const otx_level *level = otx_surface_leaf(surface);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    march m = {surface, NULL, NULL, otx_pqueue_make(run->scratch), out};
    otx_pqueue_entry next;

    OTX_TRY(list_faces(run, level, &m));
    for (int32_t v = 0; v < level->vert_count; ++v)
        out[v] = (double)INFINITY;
    for (int32_t e = 0; e < level->edge_count; ++e)
        for (int32_t k = 0; k < 2 && marked[e]; ++k)
            reach(&m, level->edge_verts[2 * (size_t)e + (size_t)k], 0.0);
    for (int64_t i = 0; otx_pqueue_pop(&m.queue, &next); ++i)
    {
        if (i % 4096 == 0)
            OTX_TRY(otx_pulse(run));
        if (next.key <= out[next.item])
            step_from(&m, next.item);
    }
    OTX_TRY(otx_run_ok(run));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

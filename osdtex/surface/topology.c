/* topology.c -- edges by sorting half-edges.
 *
 * A stable counting sort by the larger vertex, then by the smaller one, leaves
 * the half-edges of an edge side by side and in corner order. A hash table
 * would do, but not with an order that is the same on every machine. */
#include "surface/topology.h"

#include "base/csr.h"

#include <string.h>

static int32_t
low_vert(const otx_topology *t, int32_t corner)
{
    const int32_t a = t->face_verts[corner];
    const int32_t b = t->face_verts[otx_topology_next(t, corner)];

    return a < b ? a : b;
}

static int32_t
high_vert(const otx_topology *t, int32_t corner)
{
    const int32_t a = t->face_verts[corner];
    const int32_t b = t->face_verts[otx_topology_next(t, corner)];

    return a < b ? b : a;
}

/* Stable counting sort of `in` (NULL: 0, 1, …) by `key` into `out`.
 *
 *   first  [vert_count + 2], overwritten */
static void
sort_corners(
    const otx_topology *t, int32_t (*key)(const otx_topology *, int32_t),
    const int32_t *in, int32_t *out, int32_t *first)
{
    memset(first, 0, ((size_t)t->vert_count + 2) * sizeof *first);
    for (int32_t i = 0; i < t->corner_count; ++i)
        otx_csr_count(first, key(t, i), 1);
    otx_csr_sum(first, t->vert_count);
    for (int32_t i = 0; i < t->corner_count; ++i)
    {
        const int32_t corner = in ? in[i] : i;

        out[otx_csr_place(first, key(t, corner))] = corner;
    }
}

/* Cuts the sorted half-edges into edges. */
static void
number_edges(otx_topology *t)
{
    int32_t edge = -1;

    for (int32_t i = 0; i < t->corner_count; ++i)
    {
        const int32_t corner = t->edge_corners[i];
        const int32_t low = low_vert(t, corner);
        const int32_t high = high_vert(t, corner);
        int32_t *verts = t->edge_verts + 2 * (size_t)(edge + 1);

        if (edge < 0 || verts[-2] != low || verts[-1] != high)
        {
            ++edge;
            verts[0] = low;
            verts[1] = high;
            t->edge_corner_first[edge] = i;
        }
        t->corner_edge[corner] = edge;
    }
    t->edge_count = edge + 1;
    t->edge_corner_first[t->edge_count] = t->corner_count;
}

bool
otx_topology_build(
    otx_arena *arena, int32_t vert_count, int32_t face_count,
    const int32_t *face_first, const int32_t *face_verts, otx_topology *out)
{
    const int32_t corner_count = face_first[face_count];
    otx_topology t = {
        .vert_count = vert_count,
        .face_count = face_count,
        .corner_count = corner_count,
        .face_first = face_first,
        .face_verts = face_verts,
        .edge_verts = OTX_NEW(arena, int32_t, 2 * (size_t)corner_count),
        .edge_corner_first = OTX_NEW(arena, int32_t, (size_t)corner_count + 1),
        .edge_corners = OTX_NEW(arena, int32_t, corner_count),
        .corner_edge = OTX_NEW(arena, int32_t, corner_count),
        .corner_face = OTX_NEW(arena, int32_t, corner_count)};
    int32_t *first = OTX_NEW(arena, int32_t, (size_t)vert_count + 2);

    if (!t.edge_verts || !t.edge_corner_first || !t.edge_corners ||
        !t.corner_edge || !t.corner_face || !first)
        return false;
    for (int32_t f = 0; f < face_count; ++f)
    {
        for (int32_t i = face_first[f]; i < face_first[f + 1]; ++i)
            t.corner_face[i] = f;
    }
    /* corner_edge holds the half-sorted corners until edges are numbered. */
    sort_corners(&t, high_vert, NULL, t.corner_edge, first);
    sort_corners(&t, low_vert, t.corner_edge, t.edge_corners, first);
    number_edges(&t);
    *out = t;
    return true;
}

int32_t
otx_topology_find_edge(const otx_topology *t, int32_t a, int32_t b)
{
    const int32_t low = a < b ? a : b;
    const int32_t high = a < b ? b : a;
    int32_t first = 0;
    int32_t end = t->edge_count;

    while (first < end)
    {
        const int32_t middle = first + (end - first) / 2;
        const int32_t *verts = t->edge_verts + 2 * (size_t)middle;

        if (verts[0] < low || (verts[0] == low && verts[1] < high))
            first = middle + 1;
        else
            end = middle;
    }
    if (first == t->edge_count || t->edge_verts[2 * (size_t)first] != low ||
        t->edge_verts[2 * (size_t)first + 1] != high)
        return -1;
    return first;
}

otx_topology_fan *
otx_topology_fans(otx_arena *arena, const otx_topology *t)
{
    otx_topology_fan *fans = OTX_NEW(arena, otx_topology_fan, t->vert_count);

    if (!fans)
        return NULL;
    for (int32_t v = 0; v < t->vert_count; ++v)
        fans[v] = (otx_topology_fan){-1, 0, 0};
    for (int32_t c = 0; c < t->corner_count; ++c)
    {
        otx_topology_fan *f = &fans[t->face_verts[c]];
        const bool border = otx_topology_twin(t, c) < 0;

        if (f->start < 0 || (border && f->border == 0))
            f->start = c;
        f->border += border;
        ++f->faces;
    }
    return fans;
}

/* Crosses, in each face, the edge that arrives at the vertex. */
int32_t
otx_topology_fan_size(const otx_topology *t, int32_t start)
{
    int32_t corner = start;
    int32_t count = 0;

    do
    {
        ++count;
        corner = otx_topology_twin(t, otx_topology_previous(t, corner));
    } while (corner >= 0 && corner != start);
    return count;
}

/* Marks the corners that a walk around their vertex meets from `start`. */
static void
mark_fan(const otx_topology *t, int32_t start, uint8_t *seen)
{
    int32_t corner = start;

    do
    {
        seen[corner] = 1;
        corner = otx_topology_twin(t, otx_topology_previous(t, corner));
    } while (corner >= 0 && corner != start);
}

/* Open fans are walked from their open side, so that a walk meets all of one;
 * what is left then are closed ones. */
int32_t
otx_topology_fan_count(otx_arena *arena, const otx_topology *t)
{
    uint8_t *seen = OTX_ZNEW(arena, uint8_t, t->corner_count);
    int32_t count = 0;

    if (!seen)
        return -1;
    for (int open = 1; open >= 0; --open)
        for (int32_t c = 0; c < t->corner_count; ++c)
        {
            if (seen[c] || (open && otx_topology_twin(t, c) >= 0))
                continue;
            mark_fan(t, c, seen);
            ++count;
        }
    return count;
}

/* weld.c -- vertices that lie in one place.
 *
 * Places are found through a hash of cells whose side is the distance: what is
 * near enough lies in the cell or beside it. */
#include "surface/weld.h"

#include "math/vec.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct cells
{
    const float *points;
    double side;
    int32_t mask;  /* buckets less one; their number is a power of two */
    int32_t *head; /* [mask + 1] the last vertex of each, -1 none */
    int32_t *next; /* [vert_count] */
} cells;

static int64_t
cell_of(const cells *c, int32_t vertex, int axis)
{
    return (int64_t)floor(
        (double)c->points[3 * (size_t)vertex + axis] / c->side);
}

static int32_t
bucket_of(const cells *c, int64_t x, int64_t y, int64_t z)
{
    const uint64_t h = (uint64_t)x * 0x9e3779b97f4a7c15u ^
                       (uint64_t)y * 0xc2b2ae3d27d4eb4fu ^
                       (uint64_t)z * 0x165667b19e3779f9u;

    return (int32_t)((h ^ h >> 29) & (uint64_t)c->mask);
}

static bool
is_near(const cells *c, int32_t a, int32_t b, double distance)
{
    return otx_vec3_length(otx_vec3_sub(
               otx_vec3_load(c->points, a), otx_vec3_load(c->points, b))) <=
           distance;
}

/* The smallest vertex of those that stay within the distance, -1 none. */
static int32_t
find_near(const cells *c, int32_t vertex, double distance)
{
    const int64_t x = cell_of(c, vertex, 0), y = cell_of(c, vertex, 1),
                  z = cell_of(c, vertex, 2);
    int32_t best = -1;

    for (int i = 0; i < 27; ++i)
    {
        const int32_t bucket =
            bucket_of(c, x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);

        for (int32_t v = c->head[bucket]; v >= 0; v = c->next[v])
            if ((best < 0 || v < best) && is_near(c, vertex, v, distance))
                best = v;
    }
    return best;
}

static bool
make_cells(
    otx_arena *arena, const float *points, int32_t count, double distance,
    cells *out)
{
    int32_t buckets = 1024;
    double largest = 0.0;

    while (buckets < count && buckets < 1 << 28)
        buckets *= 2;
    for (size_t i = 0; i < 3 * (size_t)count; ++i)
        largest = fmax(largest, fabs((double)points[i]));
    *out = (cells){
        .points = points,
        /* Cells can be numbered, however small the distance. */
        .side = fmax(fmax(distance, largest * 1e-15), 1e-300),
        .mask = buckets - 1,
        .head = OTX_NEW(arena, int32_t, buckets),
        .next = OTX_NEW(arena, int32_t, count)};
    if (!out->head || !out->next)
        return false;
    for (int32_t b = 0; b < buckets; ++b)
        out->head[b] = -1;
    return true;
}

int32_t *
otx_weld_find(
    otx_arena *arena, const float *points, int32_t vert_count,
    const uint8_t *among, double distance)
{
    int32_t *first = OTX_NEW(arena, int32_t, vert_count);
    cells c;

    if (!first || !make_cells(arena, points, vert_count, distance, &c))
        return NULL;
    for (int32_t v = 0; v < vert_count; ++v)
    {
        int32_t bucket;

        first[v] = v;
        if (among && !among[v])
            continue;
        first[v] = find_near(&c, v, distance);
        if (first[v] >= 0)
            continue;
        first[v] = v;
        bucket = bucket_of(
            &c, cell_of(&c, v, 0), cell_of(&c, v, 1), cell_of(&c, v, 2));
        c.next[v] = c.head[bucket];
        c.head[bucket] = v;
    }
    return first;
}

/* An open half-edge by the places of its ends. */
typedef struct open_edge
{
    int32_t low, high; /* places */
    int32_t corner;
    bool is_reversed; /* runs from high to low */
} open_edge;

static int
compare_edges(const void *a, const void *b)
{
    const open_edge *x = a, *y = b;

    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

static int32_t
list_open_edges(const otx_topology *t, const int32_t *places, open_edge *edges)
{
    int32_t count = 0;

    for (int32_t c = 0; c < t->corner_count; ++c)
    {
        const int32_t a = places[t->face_verts[c]];
        const int32_t b = places[t->face_verts[otx_topology_next(t, c)]];

        if (otx_topology_edge_size(t, t->corner_edge[c]) == 1 && a != b)
            edges[count++] =
                (open_edge){a < b ? a : b, a < b ? b : a, c, a > b};
    }
    qsort(edges, (size_t)count, sizeof *edges, compare_edges);
    return count;
}

/* Marks the ends of edges [first, end), which lie in one place, when some of
 * them run one way and some the other. */
static void
mark_gap(
    const otx_topology *t, const open_edge *edges, int32_t first, int32_t end,
    uint8_t *marks)
{
    bool ways[2] = {false, false};

    for (int32_t i = first; i < end; ++i)
        ways[edges[i].is_reversed] = true;
    for (int32_t i = first; ways[0] && ways[1] && i < end; ++i)
    {
        marks[t->face_verts[edges[i].corner]] = 1;
        marks[t->face_verts[otx_topology_next(t, edges[i].corner)]] = 1;
    }
}

/* The vertices at edges without a second face. */
static void
mark_open(const otx_topology *t, uint8_t *marks)
{
    for (int32_t e = 0; e < t->edge_count; ++e)
        if (otx_topology_edge_size(t, e) == 1)
            marks[t->edge_verts[2 * (size_t)e]] =
                marks[t->edge_verts[2 * (size_t)e + 1]] = 1;
}

bool
otx_weld_find_gaps(
    otx_arena *arena, const otx_topology *t, const float *points,
    double distance, otx_weld_gaps *out)
{
    uint8_t *marks = OTX_ZNEW(arena, uint8_t, t->vert_count);
    open_edge *edges = OTX_NEW(arena, open_edge, t->corner_count);
    int32_t *places;
    int32_t count;

    *out = (otx_weld_gaps){0, 0, -1};
    if (!marks || !edges)
        return false;
    mark_open(t, marks);
    places = otx_weld_find(arena, points, t->vert_count, marks, distance);
    if (!places)
        return false;
    memset(marks, 0, (size_t)t->vert_count);
    count = list_open_edges(t, places, edges);
    for (int32_t i = 0, end; i < count; i = end)
    {
        for (end = i + 1; end < count && edges[end].low == edges[i].low &&
                          edges[end].high == edges[i].high;)
            ++end;
        mark_gap(t, edges, i, end, marks);
    }
    for (int32_t v = 0; v < t->vert_count; ++v)
    {
        if (!(marks[v] & 1))
            continue;
        out->first = out->first < 0 ? v : out->first;
        ++out->vert_count;
        out->place_count += !(marks[places[v]] & 2);
        marks[places[v]] |= 2;
    }
    return true;
}

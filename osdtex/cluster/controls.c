/* controls.c -- which vertices are corners of regions, and the walk around one.
 */
#include "cluster/controls.h"

#include <limits.h>
#include <stdlib.h>

/* A side that bows out by more than this part of its length from end to end is
 * broken in two. */
static const double BOW_MOST = 0.35;

enum
{
    CONTROLS_LEAST = 3,
    OUTSIDE = -1
};

int32_t
otx_controls_cluster(const otx_controls *controls, int32_t face, int32_t level)
{
    const otx_cluster_node *nodes = controls->tree->nodes;
    int32_t node = face < 0 ? OUTSIDE : controls->face_node[face];

    while (node > 0 && nodes[node].level > level)
        node = nodes[node].parent;
    return node;
}

/* -- the walk ------------------------------------------------------------ */

typedef struct border_edge
{
    int32_t from, to, outside;
} border_edge;

static int
by_start(const void *a, const void *b)
{
    const border_edge *p = a, *q = b;

    return (p->from > q->from) - (p->from < q->from);
}

/* The edges of a node that have something else beyond them. */
static border_edge *
list_border(
    const otx_cluster_tree *tree, int32_t node, otx_arena *arena,
    int32_t *count)
{
    const otx_level *level = tree->how.dual->level;
    const otx_cluster_node *n = &tree->nodes[node];
    border_edge *edges;
    int32_t most = 0;

    *count = 0;
    for (int32_t i = n->first; i < n->end; ++i)
        most += otx_level_face_size(level, tree->faces[i]);
    edges = OTX_NEW(arena, border_edge, most);
    for (int32_t i = n->first; edges && i < n->end; ++i)
    {
        const int32_t face = tree->faces[i], first = level->face_first[face];
        const int32_t size = otx_level_face_size(level, face);

        for (int32_t k = 0; k < size; ++k)
        {
            const int32_t other = otx_level_neighbour(level, face, k);

            if (other >= 0 && tree->place[other] >= n->first &&
                tree->place[other] < n->end)
                continue;
            edges[(*count)++] = (border_edge){
                level->face_verts[first + k],
                level->face_verts[first + (k + 1) % size], other};
        }
    }
    if (edges)
        qsort(edges, (size_t)*count, sizeof *edges, by_start);
    return edges;
}

static bool
is_control(const otx_controls *controls, int32_t vert, int32_t level)
{
    return controls->vert_level[vert] <= level;
}

/* Marks the control vertices of a border that is walked already. */
static void
mark_controls(const otx_controls *controls, int32_t level, otx_outline *out)
{
    out->control_count = 0;
    for (int32_t i = 0; i < out->count; ++i)
        if (is_control(controls, out->verts[i], level))
            out->controls[out->control_count++] = i;
}

otx_status
otx_outline_trace(
    const otx_controls *controls, int32_t node, int32_t level, otx_arena *arena,
    otx_outline *out)
{
    int32_t count, start = 0;
    border_edge *edges = list_border(controls->tree, node, arena, &count);

    *out = (otx_outline){
        .verts = OTX_NEW(arena, int32_t, count),
        .outside = OTX_NEW(arena, int32_t, count),
        .controls = OTX_NEW(arena, int32_t, count),
    };
    if (otx_arena_failed(arena))
        return OSDTEX_ERROR_MEMORY;
    while (start < count && !is_control(controls, edges[start].from, level))
        ++start;
    for (const border_edge *e = &edges[start < count ? start : 0];
         e && out->count < count; ++out->count)
    {
        const border_edge key = {.from = e->to};

        out->verts[out->count] = e->from;
        out->outside[out->count] = e->outside;
        e = bsearch(&key, edges, (size_t)count, sizeof *edges, by_start);
    }
    mark_controls(controls, level, out);
    return OSDTEX_OK;
}

/* -- control vertices ---------------------------------------------------- */

static otx_status
grow_all(otx_run *run, otx_cluster_tree *tree)
{
    for (int32_t i = 0; i < tree->count; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const otx_cluster c = otx_cluster_tree_node(tree, i);

        if (c.face_count > 1)
            OTX_TRY(otx_cluster_tree_grow(run, tree, i));
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}

/* The first two clusters around a vertex, while a level is looked at. */
typedef struct around
{
    int32_t first, second;
    bool more;
} around;

enum
{
    NONE = -2
};

static void
meet(around *a, int32_t cluster)
{
    if (a->first == NONE)
        a->first = cluster;
    else if (cluster == a->first)
        return;
    else if (a->second == NONE)
        a->second = cluster;
    else
        a->more |= cluster != a->second;
}

/* Vertices that three clusters of a level share. */
static void
find_shared(otx_controls *controls, int32_t level, around *verts)
{
    const otx_level *base = controls->tree->how.dual->level;

    for (int32_t v = 0; v < base->vert_count; ++v)
        verts[v] = (around){NONE, NONE, false};
    for (int32_t f = 0; f < base->face_count; ++f)
    {
        const int32_t node = otx_controls_cluster(controls, f, level);
        const int32_t size = otx_level_face_size(base, f);

        for (int32_t k = 0; k < size; ++k)
        {
            const int32_t *v = base->face_verts + base->face_first[f];

            meet(&verts[v[k]], node);
            if (otx_level_neighbour(base, f, k) >= 0)
                continue;
            meet(&verts[v[k]], OUTSIDE);
            meet(&verts[v[(k + 1) % size]], OUTSIDE);
        }
    }
    for (int32_t v = 0; v < base->vert_count; ++v)
        if (verts[v].more && controls->vert_level[v] > level)
            controls->vert_level[v] = level;
}

static otx_vec3
point(const otx_controls *controls, const otx_outline *o, int32_t i)
{
    return otx_vec3_load(
        controls->tree->surface->points, o->verts[i % o->count]);
}

/* The vertex between two of a border that is farthest from their chord, and
 * how far, as a part of the chord; of a closed run from the point itself. */
static double
farthest(
    const otx_controls *controls, const otx_outline *o, int32_t from,
    int32_t to, int32_t *out)
{
    const otx_vec3 a = point(controls, o, from);
    const otx_vec3 chord = otx_vec3_sub(point(controls, o, to), a);
    const double length = otx_vec3_length(chord);
    double most = -1.0;

    *out = -1;
    for (int32_t i = from + 1; i < to; ++i)
    {
        const otx_vec3 way = otx_vec3_sub(point(controls, o, i), a);
        const double away =
            length > 0.0 ? otx_vec3_length(otx_vec3_cross(way, chord)) / length
                         : otx_vec3_length(way);

        if (away > most)
        {
            most = away;
            *out = i % o->count;
        }
    }
    return length > 0.0 ? most / length : INFINITY;
}

/* Breaks the side that bows out most, if it does so too much or there are too
 * few control vertices. True when it did. */
static bool
break_side(otx_controls *controls, int32_t level, otx_outline *o)
{
    const int32_t sides = o->control_count;
    double most = -1.0;
    int32_t best = -1;

    for (int32_t k = 0; k < sides; ++k)
    {
        const int32_t from = o->controls[k];
        const int32_t to =
            k + 1 < sides ? o->controls[k + 1] : o->controls[0] + o->count;
        int32_t vert;
        const double bow = farthest(controls, o, from, to, &vert);

        if (vert >= 0 && bow > most)
        {
            most = bow;
            best = vert;
        }
    }
    if (best < 0 || (most <= BOW_MOST && sides >= CONTROLS_LEAST))
        return false;
    controls->vert_level[o->verts[best]] = level;
    mark_controls(controls, level, o);
    return true;
}

/* Has every region of a level have enough control vertices. */
static otx_status
complete_level(otx_run *run, otx_controls *controls, int32_t level)
{
    const otx_cluster_tree *tree = controls->tree;

    for (int32_t i = 1; i < tree->count; ++i)
    {
        const otx_cluster_node *n = &tree->nodes[i];
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        otx_outline o;

        if (n->level != level || n->end - n->first == 1)
            continue;
        if (otx_outline_trace(controls, i, level, run->scratch, &o))
            return otx_fail_memory(run, "cluster");
        if (o.control_count == 0 && o.count > 0)
        {
            controls->vert_level[o.verts[0]] = level;
            mark_controls(controls, level, &o);
        }
        while (break_side(controls, level, &o))
            ;
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}

otx_status
otx_controls_find(otx_run *run, otx_cluster_tree *tree, otx_controls *out)
{
    const otx_level *base = tree->how.dual->level;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    around *verts = OTX_NEW(run->scratch, around, base->vert_count);

    *out = (otx_controls){
        .tree = tree,
        .vert_level = OTX_NEW(run->arena, int32_t, base->vert_count),
        .face_node = OTX_NEW(run->arena, int32_t, base->face_count),
    };
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(grow_all(run, tree));
    for (int32_t v = 0; v < base->vert_count; ++v)
        out->vert_level[v] = INT_MAX;
    for (int32_t f = 0; f < base->face_count; ++f)
        out->face_node[f] = OUTSIDE;
    for (int32_t i = 1; i < tree->count; ++i)
        if (tree->nodes[i].end - tree->nodes[i].first == 1)
            out->face_node[tree->faces[tree->nodes[i].first]] = i;
    for (int32_t level = 1; level < tree->face_level; ++level)
    {
        find_shared(out, level, verts);
        OTX_TRY(complete_level(run, out, level));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

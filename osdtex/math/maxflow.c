/* maxflow.c -- augmenting trees grown from both terminals [Boykov04].
 *
 * Two trees, rooted at the source and at the sink, grow along arcs that have
 * capacity left until they touch. The path so found is filled; nodes whose
 * arc to their parent is now full are orphans and look for a new parent in
 * their tree, or leave it. The trees survive from path to path, which is why
 * this beats textbook augmentation on graphs of short paths.
 *
 * Distances to the root carry the time at which they were known to be right
 * (the second heuristic of the paper's implementation), so that most searches
 * for a new parent end after a step. */
#include "math/maxflow.h"

#include <assert.h>
#include <limits.h>

enum
{
    NO_ARC = -1,   /* the node is in neither tree */
    TERMINAL = -2, /* the parent is the terminal itself */
    ORPHAN = -3,   /* the parent was lost and not yet replaced */
    NO_NODE = -1,
    COUNT_MAX = 1 << 30
};

typedef struct edge
{
    int64_t forward, backward;
    int32_t a, b;
} edge;

typedef struct arc
{
    int64_t residual;
    int32_t head;
    int32_t sister; /* the same edge the other way */
} arc;

typedef struct node
{
    int64_t excess;   /* left from the source, or if negative to the sink */
    int32_t parent;   /* arc towards the root, or one of the above */
    int32_t distance; /* arcs to the terminal, right at time `stamp` */
    int32_t stamp;
    int32_t next_active; /* NO_NODE: not queued; the last one names itself */
    int32_t next_orphan;
    bool sink; /* which tree, when parent is not NO_ARC */
} node;

/* First in, first out, through a link in each node. */
typedef struct queue
{
    int32_t first, last;
} queue;

struct otx_maxflow
{
    int32_t node_count, edge_count, edge_capacity;
    node *nodes;
    edge *edges;
    int32_t *arc_first; /* [node_count + 1] */
    arc *arcs;          /* [edge_count * 2], by tail */
    queue active, orphans;
    int32_t time;
    int64_t flow;
};

otx_maxflow *
otx_maxflow_create(otx_arena *arena, int32_t node_count, int32_t edge_capacity)
{
    if (node_count < 0 || edge_capacity < 0 || node_count > COUNT_MAX ||
        edge_capacity >= COUNT_MAX)
        return NULL;

    otx_maxflow *graph = OTX_ZNEW(arena, otx_maxflow, 1);

    if (!graph)
        return NULL;
    graph->node_count = node_count;
    graph->edge_capacity = edge_capacity;
    graph->nodes = OTX_ZNEW(arena, node, node_count);
    graph->arc_first = OTX_ZNEW(arena, int32_t, (int64_t)node_count + 1);
    graph->edges = OTX_NEW(arena, edge, edge_capacity);
    graph->arcs = OTX_NEW(arena, arc, 2 * (int64_t)edge_capacity);
    if (!graph->nodes || !graph->arc_first || !graph->edges || !graph->arcs)
        return NULL;
    return graph;
}

void
otx_maxflow_terminal(
    otx_maxflow *graph, int32_t index, int64_t from_source, int64_t to_sink)
{
    node *n = &graph->nodes[index];

    /* What passes straight through the node is flow already. */
    if (n->excess > 0)
        from_source += n->excess;
    else
        to_sink -= n->excess;
    graph->flow += from_source < to_sink ? from_source : to_sink;
    n->excess = from_source - to_sink;
}

void
otx_maxflow_edge(
    otx_maxflow *graph, int32_t a, int32_t b, int64_t forward, int64_t backward)
{
    assert(graph->edge_count < graph->edge_capacity && a != b);
    graph->edges[graph->edge_count++] = (edge){forward, backward, a, b};
    ++graph->arc_first[a];
    ++graph->arc_first[b];
}

/* Lays the arcs out by tail, in the order in which edges were added. */
static void
lay_out_arcs(otx_maxflow *graph)
{
    int32_t *first = graph->arc_first;
    int32_t end = 0;

    for (int32_t i = 0; i <= graph->node_count; ++i)
        first[i] = end += first[i];
    for (int32_t e = graph->edge_count; e-- > 0;)
    {
        const edge *in = &graph->edges[e];
        const int32_t forward = --first[in->a];
        const int32_t backward = --first[in->b];

        graph->arcs[forward] = (arc){in->forward, in->b, backward};
        graph->arcs[backward] = (arc){in->backward, in->a, forward};
    }
}

static void
activate(otx_maxflow *graph, int32_t index)
{
    if (graph->nodes[index].next_active != NO_NODE)
        return;
    if (graph->active.last == NO_NODE)
        graph->active.first = index;
    else
        graph->nodes[graph->active.last].next_active = index;
    graph->active.last = index;
    graph->nodes[index].next_active = index;
}

static int32_t
next_active(otx_maxflow *graph)
{
    const int32_t index = graph->active.first;

    if (index == NO_NODE)
        return NO_NODE;

    node *n = &graph->nodes[index];

    if (n->next_active == index)
        graph->active = (queue){NO_NODE, NO_NODE};
    else
        graph->active.first = n->next_active;
    n->next_active = NO_NODE;
    return index;
}

/* Orphans of the path that was filled go to the front: children of theirs,
 * which go to the back, may find their parents settled. */
static void
orphan_front(otx_maxflow *graph, int32_t index)
{
    graph->nodes[index].parent = ORPHAN;
    graph->nodes[index].next_orphan = graph->orphans.first;
    graph->orphans.first = index;
    if (graph->orphans.last == NO_NODE)
        graph->orphans.last = index;
}

static void
orphan_back(otx_maxflow *graph, int32_t index)
{
    graph->nodes[index].parent = ORPHAN;
    graph->nodes[index].next_orphan = NO_NODE;
    if (graph->orphans.last == NO_NODE)
        graph->orphans.first = index;
    else
        graph->nodes[graph->orphans.last].next_orphan = index;
    graph->orphans.last = index;
}

static void
plant_trees(otx_maxflow *graph)
{
    graph->active = graph->orphans = (queue){NO_NODE, NO_NODE};
    for (int32_t i = 0; i < graph->node_count; ++i)
    {
        node *n = &graph->nodes[i];

        n->next_active = NO_NODE;
        n->sink = n->excess < 0;
        n->parent = n->excess != 0 ? TERMINAL : NO_ARC;
        n->distance = 1;
    }
    for (int32_t i = 0; i < graph->node_count; ++i)
        if (graph->nodes[i].parent == TERMINAL)
            activate(graph, i);
}

/* What may still pass along the arc from a node of the source tree outwards,
 * or of the sink tree inwards. */
static int64_t
room(const otx_maxflow *graph, int32_t arc_index, bool sink)
{
    const arc *a = &graph->arcs[arc_index];

    return sink ? graph->arcs[a->sister].residual : a->residual;
}

/* Grows a tree from the active node `index`. Returns the arc, in the direction
 * of the flow, over which the trees touch, or NO_ARC when there is none. */
static int32_t
grow(otx_maxflow *graph, int32_t index)
{
    const node *from = &graph->nodes[index];

    for (int32_t k = graph->arc_first[index]; k < graph->arc_first[index + 1];
         ++k)
    {
        if (room(graph, k, from->sink) == 0)
            continue;

        const int32_t other = graph->arcs[k].head;
        const int32_t back = graph->arcs[k].sister;
        node *to = &graph->nodes[other];

        if (to->parent == NO_ARC)
        {
            to->sink = from->sink;
            to->parent = back;
            to->stamp = from->stamp;
            to->distance = from->distance + 1;
            activate(graph, other);
        }
        else if (to->sink != from->sink)
            return from->sink ? back : k;
        else if (to->stamp <= from->stamp && to->distance > from->distance)
        {
            to->parent = back; /* a shorter way to the root */
            to->stamp = from->stamp;
            to->distance = from->distance + 1;
        }
    }
    return NO_ARC;
}

/* The arc that carries the flow between a node and its parent. */
static arc *
flow_arc(otx_maxflow *graph, const node *n)
{
    arc *up = &graph->arcs[n->parent];

    return n->sink ? up : &graph->arcs[up->sister];
}

static int64_t
path_room(otx_maxflow *graph, int32_t index, int64_t least)
{
    const node *n = &graph->nodes[index];

    while (n->parent != TERMINAL)
    {
        const int64_t residual = flow_arc(graph, n)->residual;

        least = residual < least ? residual : least;
        n = &graph->nodes[graph->arcs[n->parent].head];
    }

    const int64_t excess = n->sink ? -n->excess : n->excess;

    return excess < least ? excess : least;
}

static void
fill_path(otx_maxflow *graph, int32_t index, int64_t amount)
{
    node *n = &graph->nodes[index];

    while (n->parent != TERMINAL)
    {
        arc *a = flow_arc(graph, n);
        const int32_t up = graph->arcs[n->parent].head;

        a->residual -= amount;
        graph->arcs[a->sister].residual += amount;
        if (a->residual == 0)
            orphan_front(graph, index);
        index = up;
        n = &graph->nodes[index];
    }
    n->excess += n->sink ? amount : -amount;
    if (n->excess == 0)
        orphan_front(graph, index);
}

static void
augment(otx_maxflow *graph, int32_t middle)
{
    arc *a = &graph->arcs[middle];
    arc *back = &graph->arcs[a->sister];
    const int32_t tail = back->head;
    int64_t amount = a->residual;

    amount = path_room(graph, tail, amount);
    amount = path_room(graph, a->head, amount);
    a->residual -= amount;
    back->residual += amount;
    fill_path(graph, tail, amount);
    fill_path(graph, a->head, amount);
    graph->flow += amount;
}

/* Arcs from a node to the terminal of its tree, INT_MAX when an orphan is on
 * the way. Nodes on the way learn their distance at the present time. */
static int32_t
root_distance(otx_maxflow *graph, int32_t index)
{
    int32_t distance = 0;
    int32_t i = index;

    for (;;)
    {
        node *n = &graph->nodes[i];

        if (n->stamp == graph->time)
        {
            distance += n->distance;
            break;
        }
        ++distance;
        if (n->parent == TERMINAL)
        {
            n->stamp = graph->time;
            n->distance = 1;
            break;
        }
        if (n->parent == ORPHAN)
            return INT_MAX;
        i = graph->arcs[n->parent].head;
    }

    int32_t left = distance;

    for (i = index; graph->nodes[i].stamp != graph->time;
         i = graph->arcs[graph->nodes[i].parent].head)
    {
        graph->nodes[i].stamp = graph->time;
        graph->nodes[i].distance = left--;
    }
    return distance;
}

/* An orphan without a new parent leaves its tree; its children are orphans,
 * and neighbours that could win it back become active. */
static void
leave_tree(otx_maxflow *graph, int32_t index)
{
    const bool sink = graph->nodes[index].sink;

    graph->nodes[index].parent = NO_ARC;
    for (int32_t k = graph->arc_first[index]; k < graph->arc_first[index + 1];
         ++k)
    {
        const int32_t other = graph->arcs[k].head;
        const node *n = &graph->nodes[other];

        if (n->parent == NO_ARC || n->sink != sink)
            continue;
        if (room(graph, k, !sink) > 0)
            activate(graph, other);
        if (n->parent >= 0 && graph->arcs[n->parent].head == index)
            orphan_back(graph, other);
    }
}

static void
adopt(otx_maxflow *graph, int32_t index)
{
    node *orphan = &graph->nodes[index];
    int32_t best = NO_ARC;
    int32_t best_distance = INT_MAX;

    for (int32_t k = graph->arc_first[index]; k < graph->arc_first[index + 1];
         ++k)
    {
        const int32_t other = graph->arcs[k].head;
        const node *n = &graph->nodes[other];

        if (n->parent == NO_ARC || n->sink != orphan->sink ||
            room(graph, k, !orphan->sink) == 0)
            continue;

        const int32_t distance = root_distance(graph, other);

        if (distance < best_distance)
        {
            best = k;
            best_distance = distance;
        }
    }
    if (best == NO_ARC)
    {
        leave_tree(graph, index);
        return;
    }
    orphan->parent = best;
    orphan->stamp = graph->time;
    orphan->distance = best_distance + 1;
}

static void
adopt_orphans(otx_maxflow *graph)
{
    while (graph->orphans.first != NO_NODE)
    {
        const int32_t index = graph->orphans.first;

        graph->orphans.first = graph->nodes[index].next_orphan;
        if (graph->orphans.first == NO_NODE)
            graph->orphans.last = NO_NODE;
        adopt(graph, index);
    }
}

int64_t
otx_maxflow_solve(otx_maxflow *graph)
{
    int32_t index;

    lay_out_arcs(graph);
    plant_trees(graph);
    while ((index = next_active(graph)) != NO_NODE)
        while (graph->nodes[index].parent != NO_ARC)
        {
            const int32_t middle = grow(graph, index);

            if (middle == NO_ARC)
                break;
            ++graph->time;
            augment(graph, middle);
            adopt_orphans(graph);
        }
    return graph->flow;
}

bool
otx_maxflow_source_side(const otx_maxflow *graph, int32_t index)
{
    const node *n = &graph->nodes[index];

    return n->parent != NO_ARC && !n->sink;
}

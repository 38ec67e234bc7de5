/* maxflow.c -- push-relabel, run backwards from the sink.
 *
 * What the sink can take is a demand at its neighbours; demands are handed
 * from node to node against the arcs, always to a node that is one step nearer
 * to the source, until the source meets them or nobody can. Demands that
 * cannot be met are simply left: the cut is known without turning the preflow
 * into a flow. Running backwards makes the nodes that the source still reaches
 * the smallest source side.
 *
 * Nodes are served first come, first served, and labels are made exact by a
 * breadth-first pass now and then [Cherkassky97]. Measured beside it:
 * augmenting trees [Boykov04] take half the time where every node has a
 * terminal, but ten times as long where only the borders have (12 s against
 * 1.1 s on 300 000 nodes), which is what the cut between two pictures looks
 * like; serving the highest label first is several times slower on both. */
#include "math/maxflow.h"

#include <assert.h>

enum
{
    NONE = -1,
    COUNT_MAX = 1 << 30,
    /* Cost of a relabelling, in arcs looked at, beside the node's own. */
    RELABEL_WORK = 12
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
    int64_t balance; /* left from the source, or if negative a demand */
    int32_t label;   /* lower bound of the arcs from the source, 1 for direct */
    int32_t current; /* arcs before it lead nowhere at this label */
    int32_t next;    /* in the queue of demands */
} node;

struct otx_maxflow
{
    int32_t node_count, edge_count, edge_capacity;
    node *nodes;
    edge *edges;
    int32_t *arc_first;  /* [node_count + 1] */
    arc *arcs;           /* [edge_count * 2], by tail */
    int32_t *order;      /* [node_count], breadth first from the source */
    int32_t first, last; /* of the queue, NONE when empty */
    int32_t far;         /* label of nodes that the source does not reach */
    int64_t work;        /* since labels were exact */
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
    graph->far = node_count + 1;
    graph->nodes = OTX_ZNEW(arena, node, node_count);
    graph->order = OTX_NEW(arena, int32_t, node_count);
    graph->arc_first = OTX_ZNEW(arena, int32_t, (int64_t)node_count + 1);
    graph->edges = OTX_NEW(arena, edge, edge_capacity);
    graph->arcs = OTX_NEW(arena, arc, 2 * (int64_t)edge_capacity);
    if (!graph->nodes || !graph->order || !graph->arc_first || !graph->edges ||
        !graph->arcs)
        return NULL;
    return graph;
}

void
otx_maxflow_terminal(
    otx_maxflow *graph, int32_t index, int64_t from_source, int64_t to_sink)
{
    node *n = &graph->nodes[index];

    /* What passes straight through the node is flow already. */
    if (n->balance > 0)
        from_source += n->balance;
    else
        to_sink -= n->balance;
    graph->flow += from_source < to_sink ? from_source : to_sink;
    n->balance = from_source - to_sink;
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
enqueue(otx_maxflow *graph, int32_t index)
{
    if (graph->first == NONE)
        graph->first = index;
    else
        graph->nodes[graph->last].next = index;
    graph->last = index;
    graph->nodes[index].next = NONE;
}

/* Puts the nodes that the source reaches into `order`, nearest first, with
 * their exact labels; returns how many they are. */
static int32_t
label_from_source(otx_maxflow *graph)
{
    int32_t count = 0;

    for (int32_t i = 0; i < graph->node_count; ++i)
    {
        node *n = &graph->nodes[i];

        n->current = graph->arc_first[i];
        n->label = n->balance > 0 ? 1 : graph->far;
        if (n->balance > 0)
            graph->order[count++] = i;
    }
    for (int32_t done = 0; done < count; ++done)
    {
        const int32_t i = graph->order[done];

        for (int32_t k = graph->arc_first[i]; k < graph->arc_first[i + 1]; ++k)
        {
            const arc *a = &graph->arcs[k];

            if (a->residual == 0 || graph->nodes[a->head].label != graph->far)
                continue;
            graph->nodes[a->head].label = graph->nodes[i].label + 1;
            graph->order[count++] = a->head;
        }
    }
    return count;
}

/* Exact labels, and a queue of the demands that can still be met, farthest
 * from the source first. */
static void
start_over(otx_maxflow *graph)
{
    graph->first = graph->last = NONE;
    graph->work = 0;
    for (int32_t q = label_from_source(graph); q-- > 0;)
        if (graph->nodes[graph->order[q]].balance < 0)
            enqueue(graph, graph->order[q]);
}

/* Hands demand of `index` to the node that the arc `out` leads to. */
static void
pull(otx_maxflow *graph, int32_t index, arc *out)
{
    arc *in = &graph->arcs[out->sister];
    node *to = &graph->nodes[out->head];
    const int64_t demand = -graph->nodes[index].balance;
    const int64_t amount = demand < in->residual ? demand : in->residual;
    const int64_t had = to->balance;

    in->residual -= amount;
    out->residual += amount;
    graph->nodes[index].balance += amount;
    to->balance -= amount;
    if (had > 0)
        graph->flow += had < amount ? had : amount;
    if (had >= 0 && to->balance < 0)
        enqueue(graph, out->head);
}

/* Raises the label to one more than the nearest node that can still help. */
static void
relabel(otx_maxflow *graph, int32_t index)
{
    const int32_t end = graph->arc_first[index + 1];
    node *n = &graph->nodes[index];

    n->label = graph->far;
    for (int32_t k = graph->arc_first[index]; k < end; ++k)
    {
        const arc *out = &graph->arcs[k];
        const int32_t label = graph->nodes[out->head].label + 1;

        if (label >= n->label || graph->arcs[out->sister].residual == 0)
            continue;
        n->label = label;
        n->current = k;
    }
    graph->work += RELABEL_WORK + end - graph->arc_first[index];
}

/* Passes the whole demand of a node on, or finds that nobody can meet it. */
static void
discharge(otx_maxflow *graph, int32_t index)
{
    const int32_t end = graph->arc_first[index + 1];
    node *n = &graph->nodes[index];

    while (n->label < graph->far)
    {
        for (; n->current < end; ++n->current)
        {
            arc *out = &graph->arcs[n->current];

            if (graph->nodes[out->head].label + 1 != n->label ||
                graph->arcs[out->sister].residual == 0)
                continue;
            pull(graph, index, out);
            if (n->balance == 0)
                return;
        }
        relabel(graph, index);
    }
}

int64_t
otx_maxflow_solve(otx_maxflow *graph)
{
    const int64_t work_limit =
        3 * (int64_t)graph->node_count + graph->edge_count;

    lay_out_arcs(graph);
    start_over(graph);
    while (graph->first != NONE)
    {
        const int32_t index = graph->first;

        graph->first = graph->nodes[index].next;
        discharge(graph, index);
        if (graph->work > work_limit)
            start_over(graph);
    }
    label_from_source(graph);
    return graph->flow;
}

bool
otx_maxflow_source_side(const otx_maxflow *graph, int32_t index)
{
    return graph->nodes[index].label < graph->far;
}

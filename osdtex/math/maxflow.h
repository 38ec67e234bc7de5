/* maxflow.h -- minimum s-t cut of a sparse graph, for seam cuts.
 *
 * Push-relabel [Goldberg88] with exact relabelling [Cherkassky97], which is
 * fast both where every node has a terminal (expansion moves) and where only
 * the border has (the cut between two pictures). Capacities are integers, so
 * that flow and cut are exact, and the side returned is the smallest source
 * side, which is unique: the answer depends neither on the algorithm nor on
 * the order of the edges.
 *
 * Usage: create, terminals and edges in any order, solve once, ask sides.
 * See docs/notes/cut.md.
 *
 * [Goldberg88] Goldberg, Tarjan: A new approach to the maximum-flow problem.
 * [Cherkassky97] Cherkassky, Goldberg: On implementing the push-relabel method
 * for the maximum flow problem. Algorithmica 19. */
#ifndef OTX_MATH_MAXFLOW_H
#define OTX_MATH_MAXFLOW_H

#include "base/arena.h"

typedef struct otx_maxflow otx_maxflow;

/* A graph of `node_count` nodes (0 is fine) and no edges, with room for
 * `edge_capacity` calls of otx_maxflow_edge. Lives in `arena` and dies with
 * it. NULL when memory is out or a count is negative or past 2^30. */
otx_maxflow *
otx_maxflow_create(otx_arena *arena, int32_t node_count, int32_t edge_capacity);

/* Adds capacities source -> node and node -> sink; calls add up.
 * Both >= 0; the sum of all capacities must stay below 2^62. */
void otx_maxflow_terminal(
    otx_maxflow *graph, int32_t node, int64_t from_source, int64_t to_sink);

/* Adds an edge a -> b of capacity `forward` and b -> a of `backward`, both
 * >= 0; a != b. Parallel edges are allowed. */
void otx_maxflow_edge(
    otx_maxflow *graph, int32_t a, int32_t b, int64_t forward,
    int64_t backward);

/* The value of the maximum flow, which is that of the minimum cut. Once. */
int64_t otx_maxflow_solve(otx_maxflow *graph);

/* After solve: whether `node` is on the source side, i.e. the source still
 * reaches it. Nodes that neither terminal reaches are on the sink side. */
bool otx_maxflow_source_side(const otx_maxflow *graph, int32_t node);

#endif

/* test_maxflow.c -- against shortest augmenting paths, and on grids. */
#include "support.h"

#include "base/random.h"
#include "math/maxflow.h"

#include <stdlib.h>

enum
{
    NODES_MAX = 14,
    SOURCE = NODES_MAX,
    SINK = NODES_MAX + 1,
    ALL = NODES_MAX + 2,
    GRAPHS = 600
};

/* Capacities as a dense matrix, and the textbook algorithm on it. */
typedef struct dense
{
    int64_t capacity[ALL][ALL];
    int64_t residual[ALL][ALL];
} dense;

static uint64_t counter;

static int32_t
draw(int32_t bound)
{
    return (int32_t)(otx_random_bits(7, 1, counter++) % (uint64_t)bound);
}

/* Breadth-first from the source; whether it reaches the sink. */
static bool
reach(const dense *graph, int parent[ALL])
{
    int queue[ALL] = {SOURCE}, first = 0, last = 1;

    for (int i = 0; i < ALL; ++i)
        parent[i] = -1;
    parent[SOURCE] = SOURCE;
    while (first < last)
    {
        const int i = queue[first++];

        for (int j = 0; j < ALL; ++j)
            if (parent[j] < 0 && graph->residual[i][j] > 0)
            {
                parent[j] = i;
                queue[last++] = j;
            }
    }
    return parent[SINK] >= 0;
}

static int64_t
reference_flow(dense *graph, int parent[ALL])
{
    int64_t flow = 0;

    memcpy(graph->residual, graph->capacity, sizeof graph->capacity);
    while (reach(graph, parent))
    {
        int64_t amount = INT64_MAX;

        for (int j = SINK; j != SOURCE; j = parent[j])
            if (graph->residual[parent[j]][j] < amount)
                amount = graph->residual[parent[j]][j];
        for (int j = SINK; j != SOURCE; j = parent[j])
        {
            graph->residual[parent[j]][j] -= amount;
            graph->residual[j][parent[j]] += amount;
        }
        flow += amount;
    }
    return flow;
}

/* Fills both graphs alike. Small capacities make many ties. */
static void
fill(otx_maxflow *graph, dense *twin, int nodes, int edges, int32_t bound)
{
    memset(twin, 0, sizeof *twin);
    for (int e = 0; e < edges; ++e)
    {
        const int a = draw(nodes);
        const int b = (a + 1 + draw(nodes - 1)) % nodes;
        const int32_t forward = draw(bound), backward = draw(bound);

        otx_maxflow_edge(graph, a, b, forward, backward);
        twin->capacity[a][b] += forward;
        twin->capacity[b][a] += backward;
    }
    for (int t = 0; t < nodes; ++t)
    {
        const int i = draw(nodes);
        const int32_t source = draw(3) ? 0 : draw(3 * bound);
        const int32_t sink = draw(3) ? 0 : draw(3 * bound);

        otx_maxflow_terminal(graph, i, source, sink);
        twin->capacity[SOURCE][i] += source;
        twin->capacity[i][SINK] += sink;
    }
}

static int64_t
cut_value(const otx_maxflow *graph, const dense *twin, int nodes)
{
    bool source[ALL] = {false};
    int64_t value = 0;

    source[SOURCE] = true;
    for (int i = 0; i < nodes; ++i)
        source[i] = otx_maxflow_source_side(graph, i);
    for (int i = 0; i < ALL; ++i)
        for (int j = 0; j < ALL; ++j)
            if (source[i] && !source[j])
                value += twin->capacity[i][j];
    return value;
}

static void
flow_and_smallest_side_match_the_reference(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int g = 0; g < GRAPHS; ++g)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const int nodes = 2 + draw(NODES_MAX - 1);
        const int edges = draw(4 * nodes);
        otx_maxflow *graph = otx_maxflow_create(run->scratch, nodes, edges);
        dense twin;
        int parent[ALL];

        fill(graph, &twin, nodes, edges, g % 3 == 0 ? 4 : 1000);

        const int64_t expected = reference_flow(&twin, parent);

        assert_int_equal(otx_maxflow_solve(graph), expected);
        assert_int_equal(cut_value(graph, &twin, nodes), expected);
        for (int i = 0; i < nodes; ++i)
            assert_int_equal(otx_maxflow_source_side(graph, i), parent[i] >= 0);
        otx_arena_release(run->scratch, mark);
    }
    test_run_destroy(run);
}

static void
empty_and_unconnected_graphs_have_no_flow(void **state)
{
    otx_run *run = test_run_create();
    otx_maxflow *none = otx_maxflow_create(run->arena, 0, 0);
    otx_maxflow *apart = otx_maxflow_create(run->arena, 3, 0);

    (void)state;
    assert_int_equal(otx_maxflow_solve(none), 0);
    otx_maxflow_terminal(apart, 0, 5, 0);
    otx_maxflow_terminal(apart, 1, 0, 5);
    assert_int_equal(otx_maxflow_solve(apart), 0);
    assert_true(otx_maxflow_source_side(apart, 0));
    assert_false(otx_maxflow_source_side(apart, 1));
    assert_false(otx_maxflow_source_side(apart, 2));
    assert_null(otx_maxflow_create(run->arena, -1, 0));
    assert_null(otx_maxflow_create(run->arena, 1, INT32_MAX));
    test_run_destroy(run);
}

static void
terminals_of_a_node_add_up(void **state)
{
    otx_run *run = test_run_create();
    otx_maxflow *graph = otx_maxflow_create(run->arena, 1, 0);

    (void)state;
    otx_maxflow_terminal(graph, 0, 3, 1);
    otx_maxflow_terminal(graph, 0, 0, 4);
    assert_int_equal(otx_maxflow_solve(graph), 3);
    assert_false(otx_maxflow_source_side(graph, 0));
    test_run_destroy(run);
}

/* A grid, left column held by the source and right column by the sink, whose
 * capacities are 100 except on a staircase of ones. */
static void
a_planted_path_through_a_grid_is_cut(void **state)
{
    enum
    {
        SIDE = 64
    };
    otx_run *run = test_run_create();
    otx_maxflow *graph =
        otx_maxflow_create(run->arena, SIDE * SIDE, 2 * SIDE * SIDE);

    (void)state;
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x)
        {
            const int i = y * SIDE + x;
            const int step = 20 + (y / 4) % 2;

            if (x + 1 < SIDE)
                otx_maxflow_edge(
                    graph, i, i + 1, x == step ? 1 : 100, x == step ? 1 : 100);
            if (y + 1 < SIDE)
                otx_maxflow_edge(
                    graph, i, i + SIDE, x == 21 ? 1 : 100, x == 21 ? 1 : 100);
            if (x == 0)
                otx_maxflow_terminal(graph, i, 10000, 0);
            if (x == SIDE - 1)
                otx_maxflow_terminal(graph, i, 0, 10000);
        }
    assert_int_equal(otx_maxflow_solve(graph), SIDE + SIDE / 4 - 1);
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x)
            assert_int_equal(
                otx_maxflow_source_side(graph, y * SIDE + x),
                x <= 20 + (y / 4) % 2);
    test_run_destroy(run);
}

/* Random terminals and edges at the size of a large seam problem: it must end
 * soon, and what it cuts must be worth the flow. */
static void
a_large_random_grid_is_cut_at_its_flow(void **state)
{
    enum
    {
        SIDE = 256
    };
    otx_run *run = test_run_create();
    otx_maxflow *graph =
        otx_maxflow_create(run->arena, SIDE * SIDE, 2 * SIDE * SIDE);
    int32_t *right = OTX_ZNEW(run->arena, int32_t, SIDE * SIDE);
    int32_t *up = OTX_ZNEW(run->arena, int32_t, SIDE * SIDE);
    int32_t *excess = OTX_ZNEW(run->arena, int32_t, SIDE * SIDE);
    int64_t cut = 0;

    (void)state;
    for (int i = 0; i < SIDE * SIDE; ++i)
    {
        excess[i] = draw(2001) - 1000;
        otx_maxflow_terminal(
            graph, i, excess[i] > 0 ? excess[i] : 0,
            excess[i] < 0 ? -excess[i] : 0);
        if (i % SIDE + 1 < SIDE)
        {
            right[i] = draw(1000);
            otx_maxflow_edge(graph, i, i + 1, right[i], right[i]);
        }
        if (i / SIDE + 1 < SIDE)
        {
            up[i] = draw(1000);
            otx_maxflow_edge(graph, i, i + SIDE, up[i], up[i]);
        }
    }

    const int64_t flow = otx_maxflow_solve(graph);

    for (int i = 0; i < SIDE * SIDE; ++i)
    {
        const bool side = otx_maxflow_source_side(graph, i);

        if (side ? excess[i] < 0 : excess[i] > 0)
            cut += abs(excess[i]);
        if (right[i] && side != otx_maxflow_source_side(graph, i + 1))
            cut += right[i];
        if (up[i] && side != otx_maxflow_source_side(graph, i + SIDE))
            cut += up[i];
    }
    assert_int_equal(cut, flow);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flow_and_smallest_side_match_the_reference),
        cmocka_unit_test(empty_and_unconnected_graphs_have_no_flow),
        cmocka_unit_test(terminals_of_a_node_add_up),
        cmocka_unit_test(a_planted_path_through_a_grid_is_cut),
        cmocka_unit_test(a_large_random_grid_is_cut_at_its_flow),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

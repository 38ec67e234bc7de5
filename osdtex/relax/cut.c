/* cut.c -- expansion moves over the patches until nothing is gained.
 *
 * In a move every face that patch alpha offers either keeps its label or takes
 * alpha; the best such choice is one minimum cut [Boykov01, sec. 5]. Terms
 * that are not submodular, which only rounding and torn charts make, are
 * truncated downwards at the present labelling, so that a move cannot raise
 * the energy; it is checked all the same. A patch whose surroundings have not
 * changed since its last move is not tried again: the move would find what it
 * found. Moves that do not see each other run at the same time (cut_order.c).
 */
#include "relax/cut.h"

#include "math/maxflow.h"
#include "relax/cut_memo.h"
#include "relax/cut_order.h"

enum
{
    NONE = -1,
    LINKS_PER_TASK = 64,
    EDGES_PER_TASK = 4096,
    MOVES_PER_STEP = 256 /* between two chances to cancel */
};

static const char stage[] = "cut";

typedef struct state
{
    otx_run *run;
    otx_cut_cost cost;
    otx_cut_memo memo;
    otx_cut_order order;
    const otx_level *leaf;
    int32_t offer_count;
    otx_cut_view *views; /* [face_count], what each face shows now */
    int32_t *local;      /* [face_count], node of the move that may change it
                          * now, or NONE */
    int64_t *changed_at; /* [face_count], move that set the label, 0 none */
    int64_t *tried_at;   /* [offer_count], last move, NONE before the first */
    int64_t *changes;    /* [offer_count], of the energy by this sweep's move */
    int32_t sweep;       /* moves are numbered from 1 through all sweeps */
} state;

/* An edge of a face that may change: what it costs as the labels are (keep),
 * when only the first or second of its faces changes (take). */
typedef struct link
{
    int32_t edge;
    int32_t node[2]; /* of edge_faces, NONE when the face cannot change */
    int64_t keep;
    int64_t take[2];
} link;

typedef struct move
{
    const state *s;
    otx_worker *worker;
    int32_t alpha;
    int32_t node_count;
    int32_t *faces;      /* [node_count] */
    otx_cut_view *takes; /* [node_count], the face as alpha shows it */
    int32_t link_count;
    link *links;
    int64_t *face_gain; /* [node_count], cost of alpha minus present cost */
} move;

static otx_status
bad_offer(otx_run *run, int32_t offer, int32_t face, const char *what)
{
    otx_where where = OTX_NOWHERE;

    where.face = face;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, stage, where, "offer %d is not usable: %s",
        (int)offer, what);
}

static otx_status
check_offer(const state *s, int32_t index)
{
    const otx_offer *offer = &s->cost.offers[index];

    for (int32_t i = 0; i < offer->face_count; ++i)
    {
        const int32_t face = offer->faces[i];

        if (face < 0 || face >= s->leaf->face_count ||
            (i > 0 && face <= offer->faces[i - 1]))
            return bad_offer(s->run, index, face, "faces must ascend");
        if (s->leaf->face_hole[face])
            return bad_offer(s->run, index, face, "it contains a hole");
        if (offer->first[i + 1] - offer->first[i] !=
            otx_level_face_size(s->leaf, face))
            return bad_offer(s->run, index, face, "corners are missing");
        if (offer->cost && !(offer->cost[i] >= 0.0f))
            return bad_offer(s->run, index, face, "a cost is negative");
    }
    return OSDTEX_OK;
}

/* Place of `face` in an offer, NONE when it is not offered. */
static int32_t
find_slot(const otx_offer *offer, int32_t face)
{
    int32_t first = 0, end = offer->face_count;

    while (first < end)
    {
        const int32_t middle = first + (end - first) / 2;

        if (offer->faces[middle] < face)
            first = middle + 1;
        else
            end = middle;
    }
    return first < offer->face_count && offer->faces[first] == face ? first
                                                                    : NONE;
}

static otx_status
load_labels(state *s, const int32_t *face_patch)
{
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
    {
        const int32_t label = face_patch[f];
        otx_where where = OTX_NOWHERE;

        s->views[f] = (otx_cut_view){NONE, NONE};
        if (label == NONE)
            continue;
        where.face = f;
        if (label < 0 || label >= s->offer_count)
            return otx_fail(
                s->run, OSDTEX_ERROR_ARGUMENT, stage, where,
                "label %d has no offer", (int)label);
        s->views[f] =
            (otx_cut_view){label, find_slot(&s->cost.offers[label], f)};
        if (s->views[f].slot == NONE)
            return otx_fail(
                s->run, OSDTEX_ERROR_ARGUMENT, stage, where,
                "the face is labelled %d, but that patch does not offer it",
                (int)label);
    }
    return OSDTEX_OK;
}

static bool
allocate_state(state *s)
{
    otx_arena *scratch = s->run->scratch;
    const int64_t faces = s->leaf->face_count;

    s->views = OTX_NEW(scratch, otx_cut_view, faces);
    s->local = OTX_NEW(scratch, int32_t, faces);
    s->changed_at = OTX_ZNEW(scratch, int64_t, faces);
    s->tried_at = OTX_NEW(scratch, int64_t, s->offer_count);
    s->changes = OTX_NEW(scratch, int64_t, s->offer_count);
    if (!s->views || !s->local || !s->changed_at || !s->tried_at || !s->changes)
        return false;
    for (int64_t f = 0; f < faces; ++f)
        s->local[f] = NONE;
    for (int32_t p = 0; p < s->offer_count; ++p)
        s->tried_at[p] = NONE;
    return true;
}

/* The energy of the labels while it is summed, in whole numbers: in any order.
 */
typedef struct tally
{
    const state *s;
    int64_t *sums; /* by task */
} tally;

static otx_status
sum_edges(void *context, int64_t index, otx_worker *worker)
{
    const tally *t = context;
    const state *s = t->s;
    const int64_t first = index * EDGES_PER_TASK;
    const int64_t end = first + EDGES_PER_TASK;

    (void)worker;
    for (int64_t e = first; e < end && e < s->leaf->edge_count; ++e)
    {
        const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)e;

        if (faces[1] < 0)
            continue;

        const otx_cut_view views[2] = {s->views[faces[0]], s->views[faces[1]]};

        t->sums[index] += otx_cut_memo_edge(&s->memo, (int32_t)e, views, 0);
    }
    return OSDTEX_OK;
}

/* Energy of the present labels, without the faces that have none, in units of
 * colour x texels. */
static otx_status
total_energy(const state *s, double *out)
{
    const int64_t tasks =
        ((int64_t)s->leaf->edge_count + EDGES_PER_TASK - 1) / EDGES_PER_TASK;
    tally t = {s, OTX_ZNEW(s->run->scratch, int64_t, tasks)};
    int64_t sum = 0;

    OTX_TRY(otx_run_ok(s->run));
    OTX_TRY(otx_pool_for(s->run->pool, tasks, sum_edges, &t));
    for (int64_t i = 0; i < tasks; ++i)
        sum += t.sums[i];
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
        if (s->views[f].label >= 0)
            sum += otx_cut_cost_face(&s->cost, f, s->views[f]);
    *out = (double)sum * s->cost.unit;
    return OSDTEX_OK;
}

/* Whether a label on or beside the faces of an offer has changed since the
 * offer was last expanded. */
static bool
worth_trying(const state *s, int32_t alpha)
{
    const otx_offer *offer = &s->cost.offers[alpha];
    const int64_t since = s->tried_at[alpha];

    if (since == NONE)
        return true;
    for (int32_t i = 0; i < offer->face_count; ++i)
    {
        const int32_t face = offer->faces[i];
        const int32_t size = otx_level_face_size(s->leaf, face);

        if (s->changed_at[face] > since)
            return true;
        for (int32_t k = 0; k < size; ++k)
        {
            const int32_t other = otx_level_neighbour(s->leaf, face, k);

            if (other >= 0 && s->changed_at[other] > since)
                return true;
        }
    }
    return false;
}

/* Nodes are the faces that alpha offers and another patch owns. */
static bool
list_nodes(state *s, move *m)
{
    const otx_offer *offer = &s->cost.offers[m->alpha];
    otx_arena *scratch = m->worker->scratch;

    m->faces = OTX_NEW(scratch, int32_t, offer->face_count);
    m->takes = OTX_NEW(scratch, otx_cut_view, offer->face_count);
    m->face_gain = OTX_NEW(scratch, int64_t, offer->face_count);
    if (!m->faces || !m->takes || !m->face_gain)
        return false;
    for (int32_t i = 0; i < offer->face_count; ++i)
    {
        const int32_t face = offer->faces[i];
        const otx_cut_view take = {m->alpha, i};

        if (s->views[face].label == m->alpha)
            continue;
        m->face_gain[m->node_count] =
            otx_cut_cost_face(&s->cost, face, take) -
            otx_cut_cost_face(&s->cost, face, s->views[face]);
        m->faces[m->node_count] = face;
        m->takes[m->node_count] = take;
        s->local[face] = m->node_count++;
    }
    return true;
}

/* Every edge of a node once: from the side of its first node. */
static bool
list_links(const state *s, move *m)
{
    const otx_level *leaf = s->leaf;
    int64_t capacity = 0;

    for (int32_t n = 0; n < m->node_count; ++n)
        capacity += otx_level_face_size(leaf, m->faces[n]);
    m->links = OTX_NEW(m->worker->scratch, link, capacity);
    if (!m->links)
        return false;
    for (int32_t n = 0; n < m->node_count; ++n)
        for (int32_t k = leaf->face_first[m->faces[n]];
             k < leaf->face_first[m->faces[n] + 1]; ++k)
        {
            const int32_t edge = leaf->face_edges[k];
            const int32_t *faces = leaf->edge_faces + 2 * (size_t)edge;

            if (faces[1] < 0 || leaf->face_hole[faces[0]] ||
                leaf->face_hole[faces[1]])
                continue;

            const int32_t a = s->local[faces[0]], b = s->local[faces[1]];

            if (a != NONE && b != NONE && n != (a < b ? a : b))
                continue;
            m->links[m->link_count++] = (link){.edge = edge, .node = {a, b}};
        }
    return true;
}

static void
cost_link(const move *m, link *l)
{
    const state *s = m->s;
    const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)l->edge;
    otx_cut_view keep[2], take[2];

    for (int k = 0; k < 2; ++k)
    {
        keep[k] = s->views[faces[k]];
        take[k] = l->node[k] == NONE ? keep[k] : m->takes[l->node[k]];
    }

    const otx_cut_view first[2] = {take[0], keep[1]};
    const otx_cut_view second[2] = {keep[0], take[1]};

    l->keep = otx_cut_memo_edge(&s->memo, l->edge, keep, 0);
    l->take[0] = otx_cut_memo_edge(&s->memo, l->edge, first, 0);

    /* Inside one patch both choices put the same two charts side by side. */
    if (keep[0].label == keep[1].label && keep[0].label >= 0 &&
        l->node[0] != NONE && l->node[1] != NONE &&
        otx_cut_cost_joined(&s->cost, l->edge, keep[0], keep[1]) &&
        otx_cut_cost_joined(&s->cost, l->edge, take[0], take[1]))
        l->take[1] = l->take[0];
    else
        l->take[1] = otx_cut_memo_edge(&s->memo, l->edge, second, 1);
}

static otx_status
cost_links(void *context, int64_t index, otx_worker *worker)
{
    move *m = context;
    const int64_t first = index * LINKS_PER_TASK;
    const int64_t end = first + LINKS_PER_TASK;

    (void)worker;
    for (int64_t i = first; i < end && i < m->link_count; ++i)
        cost_link(m, &m->links[i]);
    return OSDTEX_OK;
}

/* `gain` is what taking alpha adds to the energy, the source side takes. */
static void
add_choice(otx_maxflow *graph, int32_t node, int64_t gain)
{
    otx_maxflow_terminal(
        graph, node, gain < 0 ? -gain : 0, gain > 0 ? gain : 0);
}

/* Both faces may change. With x = 1 for take and E(1,1) = 0 the cost is
 *   E(0,0) + (E(1,0) - E(0,0)) x0 - E(1,0) x1
 *   + (E(0,1) + E(1,0) - E(0,0)) (1 - x0) x1. */
static void
add_pair(otx_maxflow *graph, const link *l)
{
    const int64_t sum = l->take[0] + l->take[1];
    const int64_t keep = l->keep < sum ? l->keep : sum;

    add_choice(graph, l->node[0], l->take[0] - keep);
    add_choice(graph, l->node[1], -l->take[0]);
    if (sum > keep)
        otx_maxflow_edge(graph, l->node[1], l->node[0], sum - keep, 0);
}

static otx_maxflow *
build_graph(const move *m)
{
    otx_maxflow *graph =
        otx_maxflow_create(m->worker->scratch, m->node_count, m->link_count);

    if (!graph)
        return NULL;
    for (int32_t n = 0; n < m->node_count; ++n)
        add_choice(graph, n, m->face_gain[n]);
    for (int32_t i = 0; i < m->link_count; ++i)
    {
        const link *l = &m->links[i];

        if (l->node[0] != NONE && l->node[1] != NONE)
            add_pair(graph, l);
        else if (l->node[0] != NONE)
            add_choice(graph, l->node[0], l->take[0] - l->keep);
        else
            add_choice(graph, l->node[1], l->take[1] - l->keep);
    }
    return graph;
}

/* What the cut adds to the energy, truncation not counted. */
static int64_t
energy_change(const move *m, const otx_maxflow *graph)
{
    int64_t change = 0;

    for (int32_t n = 0; n < m->node_count; ++n)
        if (otx_maxflow_source_side(graph, n))
            change += m->face_gain[n];
    for (int32_t i = 0; i < m->link_count; ++i)
    {
        const link *l = &m->links[i];
        bool take[2];

        for (int k = 0; k < 2; ++k)
            take[k] = l->node[k] != NONE &&
                      otx_maxflow_source_side(graph, l->node[k]);
        if (take[0] && take[1])
            change -= l->keep;
        else if (take[0] || take[1])
            change += l->take[take[1] ? 1 : 0] - l->keep;
    }
    return change;
}

static void
apply(state *s, const move *m, const otx_maxflow *graph)
{
    for (int32_t n = 0; n < m->node_count; ++n)
    {
        if (!otx_maxflow_source_side(graph, n))
            continue;
        s->views[m->faces[n]] = m->takes[n];
        s->changed_at[m->faces[n]] = s->tried_at[m->alpha];
    }
}

static otx_status
run_move(state *s, move *m)
{
    otx_maxflow *graph;

    if (!list_nodes(s, m) || !list_links(s, m))
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_pool_share(
        m->worker, (m->link_count + LINKS_PER_TASK - 1) / LINKS_PER_TASK,
        cost_links, m));
    graph = build_graph(m);
    if (!graph)
        return OSDTEX_ERROR_MEMORY;
    otx_maxflow_solve(graph);
    s->changes[m->alpha] = energy_change(m, graph);
    if (s->changes[m->alpha] < 0)
        apply(s, m, graph);
    return OSDTEX_OK;
}

/* The move at a place of the sweep, when those that it waits for are made. */
static otx_status
expand(void *context, int64_t place, otx_worker *worker)
{
    state *s = context;
    const int32_t alpha = s->order.offers[place];
    move m = {.s = s, .worker = worker, .alpha = alpha};
    otx_status status;

    s->changes[alpha] = 0;
    if (!worth_trying(s, alpha))
        return OSDTEX_OK;
    s->tried_at[alpha] = (int64_t)s->sweep * s->offer_count + alpha + 1;
    status = run_move(s, &m);
    for (int32_t n = 0; n < m.node_count; ++n)
        s->local[m.faces[n]] = NONE;
    return status;
}

/* All moves of a sweep, as if one after the other. */
static otx_status
sweep(state *s, otx_cut_stats *stats)
{
    const double steps = (double)s->cost.options->sweeps * s->offer_count;

    for (int32_t first = 0; first < s->offer_count; first += MOVES_PER_STEP)
    {
        const int32_t left = s->offer_count - first;
        const int32_t end =
            first + (left < MOVES_PER_STEP ? left : MOVES_PER_STEP);

        OTX_TRY(otx_progress(
            s->run, stage,
            ((double)s->sweep * s->offer_count + first) / steps));
        OTX_TRY(otx_loop_result(
            s->run, stage,
            otx_pool_for_ordered(
                s->run->pool, &s->order.places, first, end, expand, s)));
    }
    for (int32_t p = 0; p < s->offer_count; ++p)
    {
        stats->moves += s->changes[p] < 0;
        stats->rejected += s->changes[p] > 0;
    }
    return OSDTEX_OK;
}

static otx_status
sweep_offers(state *s, otx_cut_stats *stats)
{
    for (; s->sweep < s->cost.options->sweeps; ++s->sweep)
    {
        const int32_t moves = stats->moves;

        OTX_TRY(sweep(s, stats));
        ++stats->sweeps;
        if (stats->moves == moves)
            break;
    }
    return otx_progress(s->run, stage, 1.0);
}

/* Writes the labels out and counts what became of them. */
static otx_status
store_labels(const state *s, int32_t *face_patch, otx_cut_stats *stats)
{
    uint8_t *used = OTX_ZNEW(s->run->scratch, uint8_t, s->offer_count);

    OTX_TRY(otx_run_ok(s->run));
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
    {
        const int32_t label = s->views[f].label;

        stats->changed += face_patch[f] != label;
        face_patch[f] = label;
        if (label >= 0)
            used[label] = 1;
    }
    for (int32_t p = 0; p < s->offer_count; ++p)
        stats->patches += used[p];
    return OSDTEX_OK;
}

static otx_status
cut_labels(state *s, int32_t *face_patch, otx_cut_stats *stats)
{
    if (!allocate_state(s))
        return otx_fail_memory(s->run, stage);
    for (int32_t p = 0; p < s->offer_count; ++p)
        OTX_TRY(check_offer(s, p));
    OTX_TRY(load_labels(s, face_patch));
    if (otx_cut_memo_create(
            s->run->scratch, &s->cost, s->offer_count, &s->memo) != OSDTEX_OK)
        return otx_fail_memory(s->run, stage);
    OTX_TRY(otx_cut_order_build(
        s->run, s->run->arena, s->leaf, s->cost.offers, s->offer_count,
        &s->order));
    OTX_TRY(total_energy(s, &stats->energy_before));
    OTX_TRY(sweep_offers(s, stats));
    OTX_TRY(total_energy(s, &stats->energy_after));
    return store_labels(s, face_patch, stats);
}

otx_status
otx_cut_run(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_offer *offers, int32_t offer_count,
    const otx_cut_options *options, int32_t *face_patch, otx_cut_stats *out)
{
    if (!(options->texels_per_unit > 0.0) ||
        !isfinite(options->texels_per_unit))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, stage, OTX_NOWHERE,
            "texels per scene unit must be a positive number");

    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_cut_stats stats = {0};
    state s = {
        .run = run,
        .cost = otx_cut_cost_create(surface, exemplars, offers, options),
        .leaf = otx_surface_leaf(surface),
        .offer_count = offer_count,
    };
    const otx_status status = cut_labels(&s, face_patch, &stats);

    otx_arena_release(run->scratch, mark);
    if (status == OSDTEX_OK && out)
        *out = stats;
    return status;
}

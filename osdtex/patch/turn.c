/* turn.c -- which nodes are fitted next, and which at the same time.
 *
 * The key puts coarser clusters first and, within a level, those with the
 * largest share of textured border, so that a patch finds as much to match as
 * there is [Soler02, sec. 2.2].
 *
 * Nodes that share no border hardly see each other. Those at the head of the
 * queue are therefore fitted together, against what is committed before, and
 * committed in the order of the queue. A turn depends on the queue alone, not
 * on the number of threads, and so does the result. */
#include "patch/turn.h"

enum
{
    HELD_MOST = 64 /* entries that are passed over in search of a turn */
};

/* A node joins a turn only when it has at least this part of the textured
 * share that the first one has: one that can wait finds more to match. */
static const double WAVE_SHARE = 0.75;

static double
textured_share(const otx_node *node)
{
    return node->border > 0.0 ? node->textured / node->border : 0.0;
}

/* Flattest first where nothing is textured yet; below any difference that the
 * textured share can make. */
double
otx_turn_key(const otx_mosaic *m, int32_t index)
{
    const otx_node *node = &m->forest.nodes[index];
    const double bend = fmin(node->chart.distortion - 1.0, 1.0);

    return 4.0 * node->depth - textured_share(node) + 1e-3 * bend;
}

static bool
is_stale(const otx_mosaic *m, const otx_pqueue_entry *entry)
{
    const otx_node *node = &m->forest.nodes[entry->item];

    return node->patch >= 0 || node->retired ||
           (isfinite(entry->key) && entry->key > otx_turn_key(m, entry->item));
}

/* Keeps the node and its neighbours out of the rest of the turn. */
static void
mark(otx_mosaic *m, int32_t index)
{
    const otx_level *leaf = m->job.leaves.level;
    const otx_node *node = &m->forest.nodes[index];

    m->forest.nodes[index].turn = m->forest.turn_count;
    for (int32_t i = 0; i < node->leaf_count; ++i)
        for (int32_t k = 0; k < otx_level_face_size(leaf, node->leaves[i]); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, node->leaves[i], k);

            if (other >= 0 && m->forest.leaf_node[other] >= 0)
                m->forest.nodes[m->forest.leaf_node[other]].turn =
                    m->forest.turn_count;
        }
}

/* Whether a turn may have more than its first node. The paper fits patches one
 * by one, and so is the user's first; where nothing is textured there is
 * nothing yet to fit to. */
static bool
may_grow(const otx_mosaic *m, const otx_pqueue_entry *first)
{
    return m->job.settings.mode == OTX_PATCH_BEST && isfinite(first->key) &&
           textured_share(&m->forest.nodes[first->item]) > 0.0;
}

static bool
is_as_good(const otx_mosaic *m, int32_t index, int32_t first)
{
    const otx_node *a = &m->forest.nodes[index], *b = &m->forest.nodes[first];

    return a->depth == b->depth &&
           textured_share(a) >= WAVE_SHARE * textured_share(b);
}

otx_status
otx_turn_next(otx_mosaic *m, otx_pqueue *queue, otx_fit *fits, int32_t *count)
{
    otx_pqueue_entry held[HELD_MOST], entry;
    int32_t held_count = 0, most = 1;

    *count = 0;
    ++m->forest.turn_count;
    while (*count < most && held_count < HELD_MOST &&
           otx_pqueue_pop(queue, &entry))
    {
        if (is_stale(m, &entry))
            continue;
        if (*count == 0)
            most = may_grow(m, &entry) ? OTX_TURN_NODES : 1;
        else if (!is_as_good(m, entry.item, fits[0].node))
        {
            held[held_count++] = entry;
            break;
        }
        else if (m->forest.nodes[entry.item].turn == m->forest.turn_count)
        {
            held[held_count++] = entry;
            continue;
        }
        mark(m, entry.item);
        fits[(*count)++] = (otx_fit){.node = entry.item};
    }
    for (int32_t i = 0; i < held_count; ++i)
        otx_pqueue_push(queue, held[i].key, held[i].item);
    return otx_run_ok(m->job.run);
}

void
otx_turn_push(
    const otx_mosaic *m, otx_pqueue *queue, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; ++i)
        if (!m->forest.nodes[i].retired)
            otx_pqueue_push(queue, otx_turn_key(m, i), i);
}

void
otx_turn_wake(otx_mosaic *m, otx_pqueue *queue, int32_t index)
{
    const otx_level *leaf = m->job.leaves.level;
    const otx_node *node = &m->forest.nodes[index];

    for (int32_t i = 0; i < node->leaf_count; ++i)
    {
        const int32_t f = node->leaves[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            otx_node *next;

            if (other < 0 || leaf->face_hole[other] ||
                m->cover.face_patch[other] >= 0)
                continue;
            next = &m->forest.nodes[m->forest.leaf_node[other]];
            next->textured += otx_forest_edge_length(
                m, leaf->face_edges[leaf->face_first[f] + k]);
            otx_pqueue_push(
                queue, otx_turn_key(m, m->forest.leaf_node[other]),
                m->forest.leaf_node[other]);
        }
    }
}

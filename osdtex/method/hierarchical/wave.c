/* wave.c -- which nodes are fitted next, and which at the same time.
 *
 * The key puts coarser clusters first and, within a level, those with the
 * largest share of textured border, so that a patch finds as much to match as
 * there is [Soler02, sec. 2.2].
 *
 * Nodes that share no border hardly see each other. Those at the head of the
 * queue are therefore fitted together, against what is committed before, and
 * committed in the order of the queue. A wave depends on the queue alone, not
 * on the number of threads, and so does the result. */
#include "method/hierarchical/hierarchical.h"

enum
{
    HELD_MOST = 64 /* entries that are passed over in search of a wave */
};

/* A node joins a wave only when it has at least this part of the textured
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
otx_wave_key(const otx_mapper *m, int32_t index)
{
    const otx_node *node = &m->nodes[index];
    const double bend = fmin(node->chart.distortion - 1.0, 1.0);

    return 4.0 * node->depth - textured_share(node) + 1e-3 * bend;
}

static bool
is_stale(const otx_mapper *m, const otx_pqueue_entry *entry)
{
    const otx_node *node = &m->nodes[entry->item];

    return node->patch >= 0 || node->retired ||
           (isfinite(entry->key) && entry->key > otx_wave_key(m, entry->item));
}

/* Keeps the node and its neighbours out of the rest of the wave. */
static void
mark(otx_mapper *m, int32_t index)
{
    const otx_level *leaf = m->leaves.level;
    const otx_node *node = &m->nodes[index];

    m->nodes[index].wave = m->wave_count;
    for (int32_t i = 0; i < node->leaf_count; ++i)
        for (int32_t k = 0; k < otx_level_face_size(leaf, node->leaves[i]); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, node->leaves[i], k);

            if (other >= 0 && m->leaf_node[other] >= 0)
                m->nodes[m->leaf_node[other]].wave = m->wave_count;
        }
}

/* Whether a wave may have more than its first node. The paper fits patches one
 * by one, and so is the user's first; where nothing is textured there is
 * nothing yet to fit to. */
static bool
may_grow(const otx_mapper *m, const otx_pqueue_entry *first)
{
    return m->settings.mode == OTX_HIERARCHICAL_BEST && isfinite(first->key) &&
           textured_share(&m->nodes[first->item]) > 0.0;
}

static bool
is_as_good(const otx_mapper *m, int32_t index, int32_t first)
{
    const otx_node *a = &m->nodes[index], *b = &m->nodes[first];

    return a->depth == b->depth &&
           textured_share(a) >= WAVE_SHARE * textured_share(b);
}

otx_status
otx_wave_next(otx_mapper *m, otx_pqueue *queue, otx_fit *fits, int32_t *count)
{
    otx_pqueue_entry held[HELD_MOST], entry;
    int32_t held_count = 0, most = 1;

    *count = 0;
    ++m->wave_count;
    while (*count < most && held_count < HELD_MOST &&
           otx_pqueue_pop(queue, &entry))
    {
        if (is_stale(m, &entry))
            continue;
        if (*count == 0)
            most = may_grow(m, &entry) ? OTX_WAVE_NODES : 1;
        else if (!is_as_good(m, entry.item, fits[0].node))
        {
            held[held_count++] = entry;
            break;
        }
        else if (m->nodes[entry.item].wave == m->wave_count)
        {
            held[held_count++] = entry;
            continue;
        }
        mark(m, entry.item);
        fits[(*count)++] = (otx_fit){.node = entry.item};
    }
    for (int32_t i = 0; i < held_count; ++i)
        if (!otx_pqueue_push(queue, held[i].key, held[i].item))
            return otx_fail_memory(m->run, "map");
    return OSDTEX_OK;
}

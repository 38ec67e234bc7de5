/* nodes.c -- the clusters of a run: where they start, how they split.
 *
 * Grown clusters are unions of the faces of one level, the coarsest whose faces
 * are a good deal smaller than a patch: so patches are made of whole cage
 * faces where the cage is fine, and of subdivision patches where it is coarse.
 */
#include "method/hierarchical/hierarchical.h"

#include "flatten/recursive.h"

#include <string.h>

/* A patch is at least about this many faces of the level it is grown from. */
static const double FACES_PER_DIAMETER = 4.0;

/* How much cluster borders seek bends of the surface; from 0.5 to 4 the
 * number of clusters that fail the flatness test changes little. */
static const double BEND = 1.0;

/* Texels: a narrower band sees no structure; a collar of 140 gave the seams of
 * one of 80 with fewer patches, and charts grow with its square. */
static const double BAND_MINIMUM = 4.0;
static const double BAND_MAXIMUM = 32.0;
static const double COLLAR_MAXIMUM = 140.0;

/* A collar holds at least about two rings of leaves. */
static const double COLLAR_LEAVES = 2.5;

/* Times that a collar is made narrower where it folds its core. */
static const int NARROWER = 3;

/* Share of the exemplar's shorter side that a patch may fill. */
static const double EXEMPLAR_SHARE = 0.8;

static otx_status
append_node(otx_mapper *m, const otx_cluster *cluster, int32_t depth)
{
    otx_node *node;

    if (m->node_count == m->node_capacity)
    {
        const int32_t capacity = m->node_capacity ? 2 * m->node_capacity : 256;
        otx_node *nodes = OTX_NEW(m->run->arena, otx_node, capacity);

        if (!nodes)
            return otx_fail_memory(m->run, "map");
        if (m->node_count > 0)
            memcpy(nodes, m->nodes, (size_t)m->node_count * sizeof *nodes);
        m->nodes = nodes;
        m->node_capacity = capacity;
    }
    node = &m->nodes[m->node_count++];
    *node = (otx_node){.cluster = *cluster, .depth = depth, .patch = -1};
    node->leaves = otx_cluster_leaves(
        m->run->arena, m->surface, cluster, &node->leaf_count);
    if (!node->leaves)
        return otx_fail_memory(m->run, "map");
    node->supply = otx_supply_wanted(m, node->leaves[0]);
    for (int32_t i = 0; i < node->leaf_count; ++i)
        m->leaf_node[node->leaves[i]] = m->node_count - 1;
    return OSDTEX_OK;
}

double
otx_nodes_edge_length(const otx_mapper *m, int32_t edge)
{
    const int32_t *v =
        otx_surface_leaf(m->surface)->edge_verts + 2 * (size_t)edge;

    return m->texels * otx_surface_density(m->surface, v, 2) *
           otx_vec3_length(otx_vec3_sub(
               otx_vec3_load(m->surface->points, v[0]),
               otx_vec3_load(m->surface->points, v[1])));
}

/* Length of the outline, and of its textured part. */
static void
measure_border(otx_mapper *m, int32_t index)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    otx_node *node = &m->nodes[index];

    node->border = node->textured = 0.0;
    for (int32_t i = 0; i < node->leaf_count; ++i)
    {
        const int32_t f = node->leaves[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            double length;

            if (other < 0 || leaf->face_hole[other] ||
                m->leaf_node[other] == index)
                continue;
            length = otx_nodes_edge_length(
                m, leaf->face_edges[leaf->face_first[f] + k]);
            node->border += length;
            if (m->face_patch[other] >= 0)
                node->textured += length;
        }
    }
}

static otx_status
append_list(otx_mapper *m, const otx_cluster_list *list, int32_t depth)
{
    const int32_t first = m->node_count;

    for (int32_t i = 0; i < list->count; ++i)
        OTX_TRY(append_node(m, &list->clusters[i], depth));
    for (int32_t i = first; i < m->node_count; ++i)
        measure_border(m, i);
    return OSDTEX_OK;
}

/* The coarsest level whose faces are small against a patch. */
static int32_t
atom_level(const otx_mapper *m)
{
    double size = m->settings.patch / FACES_PER_DIAMETER;
    int32_t level = 0;

    for (int32_t k = 1; k < m->supply_count; ++k)
        size = fmin(size, m->supplies[k].settings.patch / FACES_PER_DIAMETER);
    while (
        level + 1 < m->surface->level_count &&
        m->texels *
                sqrt(m->surface->area / m->surface->levels[level].face_count) >
            size)
        ++level;
    return level;
}

/* The dual of a level, made when it is first asked for. */
static otx_status
dual_of(otx_mapper *m, int32_t level, const otx_dual **out)
{
    *out = level == m->leaves.level_index ? &m->leaves : &m->duals[level];
    if ((*out)->level)
        return OSDTEX_OK;
    return otx_dual_build(m->run, m->surface, level, &m->duals[level]);
}

otx_status
otx_nodes_grow(
    const otx_mapper *m, const otx_supply *supply, const otx_dual *dual,
    const otx_cluster *region, otx_cluster_list *out)
{
    const double diameter = supply->settings.patch / m->texels;

    return otx_cluster_grow(
        m->run, dual, region, diameter * diameter, 1, BEND, out);
}

/* Clusters of what asks for each exemplar. */
static otx_status
start_grown(otx_mapper *m)
{
    otx_cluster regions[OTX_EXEMPLARS_MAX];
    otx_cluster_list list;
    const otx_dual *dual;

    OTX_TRY(otx_supply_regions(m, atom_level(m), regions));
    OTX_TRY(dual_of(m, regions[0].level, &dual));
    for (int32_t k = 0; k < m->supply_count; ++k)
    {
        if (regions[k].face_count == 0)
            continue;
        OTX_TRY(otx_nodes_grow(m, &m->supplies[k], dual, &regions[k], &list));
        OTX_TRY(append_list(m, &list, 0));
    }
    return OSDTEX_OK;
}

otx_status
otx_nodes_start(otx_mapper *m)
{
    otx_cluster_list list;
    const otx_dual *dual;

    if (!m->given && m->settings.clusters == OTX_HIERARCHICAL_GROWN)
        return start_grown(m);
    if (m->given)
        OTX_TRY(otx_given_clusters(m, &list));
    else
    {
        OTX_TRY(dual_of(m, 0, &dual));
        OTX_TRY(otx_cluster_faces(m->run, dual, &list));
    }
    return append_list(m, &list, 0);
}

/* -- charts -------------------------------------------------------------- */

enum
{
    NODES_PER_STEP = 64 /* between two chances to cancel */
};

typedef struct flatten_job
{
    otx_mapper *mapper;
    int32_t first;
} flatten_job;

/* Side of a square of the cluster's area, texels. */
double
otx_nodes_size(const otx_mapper *m, const otx_node *node)
{
    return m->texels * sqrt(node->cluster.area);
}

double
otx_nodes_band(const otx_mapper *m, const otx_node *node)
{
    return fmin(
        BAND_MAXIMUM,
        fmax(BAND_MINIMUM, m->settings.band * otx_nodes_size(m, node)));
}

double
otx_nodes_collar(const otx_mapper *m, const otx_node *node)
{
    const double band = otx_nodes_band(m, node);

    if (m->settings.cut != OTX_HIERARCHICAL_ON)
        return band;
    return fmax(
        otx_supply_meets(m, node) ? fmax(band, m->transition) : band,
        fmin(COLLAR_MAXIMUM, m->settings.collar * otx_nodes_size(m, node)));
}

/* A crumpled collar can fold the core that it is laid out with: then a
 * narrower one is taken, in the end none, which leaves single faces whole. */
static otx_status
build_joint(
    const otx_mapper *m, otx_node *node, otx_chart_request *request,
    otx_worker *worker)
{
    for (int32_t i = NARROWER;; --i)
    {
        OTX_TRY(otx_chart_build(
            request, node->leaves, node->leaf_count, &m->spaces[worker->index],
            worker->scratch, node->arena, &node->chart));
        if (i == 0 || node->chart.worst < (double)INFINITY)
            return OSDTEX_OK;
        request->collar = i > 1 ? 0.5 * request->collar : 0.0;
    }
}

static otx_status
flatten_node(void *context, int64_t index, otx_worker *worker)
{
    const flatten_job *job = context;
    otx_mapper *m = job->mapper;
    otx_node *node = &m->nodes[job->first + index];
    otx_chart_request request = {
        .surface = m->surface,
        .leaves = &m->leaves,
        .texels = m->texels,
        .collar = fmax(
            otx_nodes_collar(m, node),
            COLLAR_LEAVES * m->texels * m->surface->mean_edge_length),
        .bend = BEND,
        .rounds = 5,
        .worker = worker,
    };

    node->arena = otx_arena_create(m->run->allocator);
    if (!node->arena)
        return OSDTEX_ERROR_MEMORY;
    /* A cluster of several faces has no control polygon of its own. */
    if (m->settings.flatten == OTX_HIERARCHICAL_RECURSIVE &&
        node->cluster.face_count == 1)
        return otx_recursive_build(
            &request, node->cluster.level, node->cluster.faces[0],
            &m->spaces[worker->index], worker->scratch, node->arena,
            &node->chart);
    return build_joint(m, node, &request, worker);
}

void
otx_nodes_free(otx_mapper *m)
{
    for (int32_t i = 0; i < m->node_count; ++i)
        otx_arena_destroy(m->nodes[i].arena);
    m->node_count = 0;
}

static void
free_charts(void *object)
{
    otx_nodes_free(object);
}

bool
otx_nodes_defer(otx_mapper *m)
{
    return otx_arena_defer(m->run->arena, free_charts, m);
}

otx_status
otx_nodes_flatten(otx_mapper *m, int32_t first, int32_t end)
{
    while (first < end)
    {
        const int32_t count =
            end - first < NODES_PER_STEP ? end - first : NODES_PER_STEP;
        flatten_job job = {m, first};
        const otx_status status =
            otx_pool_for(m->run->pool, count, flatten_node, &job);

        if (status == OSDTEX_ERROR_MEMORY)
            return otx_fail_memory(m->run, "map");
        OTX_TRY(status);
        first += count;
        OTX_TRY(otx_progress(m->run, "flatten", (double)first / end));
    }
    return OSDTEX_OK;
}

bool
otx_nodes_can_split(const otx_mapper *m, const otx_node *node)
{
    return node->cluster.face_count > 1 ||
           node->cluster.level + 1 < m->surface->level_count;
}

bool
otx_nodes_is_flat(const otx_mapper *m, const otx_node *node)
{
    const otx_image *image = &otx_supply_of(m, node)->exemplar->match;
    const double side = fmin(image->width, image->height);

    return otx_supply_is_pure(m, node) &&
           otx_nodes_size(m, node) <= EXEMPLAR_SHARE * side &&
           node->chart.distortion <= m->settings.flatness &&
           node->chart.worst <= 2.0 * m->settings.flatness;
}

/* Grows about two clusters inside one of several faces. */
static otx_status
split_grown(otx_mapper *m, const otx_node *node, otx_cluster_list *out)
{
    const otx_dual *dual;

    OTX_TRY(dual_of(m, node->cluster.level, &dual));
    return otx_cluster_grow(
        m->run, dual, &node->cluster, 0.5 * node->cluster.area, 2, BEND, out);
}

otx_status
otx_nodes_split(otx_mapper *m, int32_t index)
{
    otx_node *node = &m->nodes[index];
    const int32_t depth = node->depth + 1;
    otx_cluster_list list;

    node->retired = true;
    otx_arena_destroy(node->arena);
    node->arena = NULL;
    if (node->cluster.face_count > 1)
        OTX_TRY(split_grown(m, node, &list));
    else
        OTX_TRY(
            otx_cluster_children(m->run, m->surface, &node->cluster, &list));
    ++m->stats->split_count;
    return append_list(m, &list, depth);
}

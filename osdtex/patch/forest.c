/* forest.c -- the clusters of a run: where they start, how they split.
 *
 * Regions are unions of the faces of one level, the coarsest whose faces are a
 * good deal smaller than a patch: so patches are made of whole cage faces where
 * the cage is fine, and of subdivision patches where it is coarse. */
#include "patch/given_patches.h"
#include "patch/mosaic.h"

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
append_node(otx_mosaic *m, const otx_cluster *cluster, int32_t depth)
{
    otx_node *node;

    if (m->forest.count == m->forest.capacity)
    {
        const int32_t capacity =
            m->forest.capacity ? 2 * m->forest.capacity : 256;
        otx_node *nodes = OTX_NEW(m->job.run->arena, otx_node, capacity);

        OTX_TRY(otx_run_ok(m->job.run));
        if (m->forest.count > 0)
            memcpy(
                nodes, m->forest.nodes,
                (size_t)m->forest.count * sizeof *nodes);
        m->forest.nodes = nodes;
        m->forest.capacity = capacity;
    }
    node = &m->forest.nodes[m->forest.count++];
    *node = (otx_node){.cluster = *cluster, .depth = depth, .patch = -1};
    node->leaves = otx_cluster_leaves(
        m->job.run->arena, m->job.surface, cluster, &node->leaf_count);
    OTX_TRY(otx_run_ok(m->job.run));
    node->supply = otx_supply_wanted(&m->job, node->leaves[0]);
    for (int32_t i = 0; i < node->leaf_count; ++i)
        m->forest.leaf_node[node->leaves[i]] = m->forest.count - 1;
    return OSDTEX_OK;
}

double
otx_forest_edge_length(const otx_mosaic *m, int32_t edge)
{
    const int32_t *v =
        otx_surface_leaf(m->job.surface)->edge_verts + 2 * (size_t)edge;

    return m->job.texels * otx_surface_density(m->job.surface, v, 2) *
           otx_vec3_length(otx_vec3_sub(
               otx_vec3_load(m->job.surface->points, v[0]),
               otx_vec3_load(m->job.surface->points, v[1])));
}

/* Length of the outline, and of its textured part. */
static void
measure_border(otx_mosaic *m, int32_t index)
{
    const otx_level *leaf = otx_surface_leaf(m->job.surface);
    otx_node *node = &m->forest.nodes[index];

    node->border = node->textured = 0.0;
    for (int32_t i = 0; i < node->leaf_count; ++i)
    {
        const int32_t f = node->leaves[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            double length;

            if (other < 0 || leaf->face_hole[other] ||
                m->forest.leaf_node[other] == index)
                continue;
            length = otx_forest_edge_length(
                m, leaf->face_edges[leaf->face_first[f] + k]);
            node->border += length;
            if (m->cover.face_patch[other] >= 0)
                node->textured += length;
        }
    }
}

static otx_status
append_list(otx_mosaic *m, const otx_cluster_list *list, int32_t depth)
{
    const int32_t first = m->forest.count;

    for (int32_t i = 0; i < list->count; ++i)
        OTX_TRY(append_node(m, &list->clusters[i], depth));
    for (int32_t i = first; i < m->forest.count; ++i)
        measure_border(m, i);
    return OSDTEX_OK;
}

/* The coarsest level whose faces are small against a patch. */
static int32_t
atom_level(const otx_mosaic *m)
{
    double size = m->job.settings.patch / FACES_PER_DIAMETER;
    int32_t level = 0;

    for (int32_t k = 1; k < m->job.exemplar_count; ++k)
        size = fmin(
            size, m->supplies.items[k].settings.patch / FACES_PER_DIAMETER);
    while (level + 1 < m->job.surface->level_count &&
           m->job.texels * sqrt(
                               m->job.surface->area /
                               m->job.surface->levels[level].face_count) >
               size)
        ++level;
    return level;
}

/* All faces of a level. */
static otx_status
whole_level(const otx_mosaic *m, int32_t level, otx_cluster *out)
{
    const int32_t count = m->job.surface->levels[level].face_count;
    int32_t *faces = OTX_NEW(m->job.run->scratch, int32_t, count);

    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t f = 0; f < count; ++f)
        faces[f] = f;
    *out = (otx_cluster){level, count, faces, m->job.surface->area, -1};
    return OSDTEX_OK;
}

/* What is not given, what asks for each exemplar, or the faces of the cage. */
static otx_status
list_parts(otx_mosaic *m, otx_cluster_part *parts, int32_t *count)
{
    otx_cluster regions[OTX_EXEMPLARS_MAX];

    *count = 1;
    if (!m->job.given && m->job.settings.clusters != OTX_PATCH_GROWN)
    {
        parts[0].target = 0.0;
        return whole_level(m, 0, &parts[0].region);
    }
    *count = m->job.exemplar_count;
    if (m->job.given)
        for (int32_t k = 0; k < *count; ++k)
            OTX_TRY(otx_given_region(&m->job, &m->cover, k, &regions[k]));
    else
        OTX_TRY(otx_supply_regions(m, atom_level(m), regions));
    for (int32_t k = 0; k < *count; ++k)
    {
        const double side = m->supplies.items[k].settings.patch / m->job.texels;

        parts[k] = (otx_cluster_part){regions[k], side * side};
    }
    return OSDTEX_OK;
}

otx_status
otx_forest_start(otx_mosaic *m)
{
    const otx_arena_mark mark = otx_arena_here(m->job.run->scratch);
    otx_cluster_part parts[OTX_EXEMPLARS_MAX];
    const otx_dual *dual = &m->job.leaves;
    otx_cluster_list regions;
    int32_t count, level;

    OTX_TRY(list_parts(m, parts, &count));
    level = parts[0].region.level;
    if (level != dual->level_index)
    {
        dual = &m->forest.dual;
        OTX_TRY(
            otx_dual_build(m->job.run, m->job.surface, level, &m->forest.dual));
    }
    OTX_TRY(otx_cluster_tree_create(
        m->job.run, m->job.surface, dual, BEND, parts, count, &m->forest.tree));
    otx_arena_release(m->job.run->scratch, mark);
    if (m->job.settings.flatten == OTX_PATCH_RECURSIVE && !m->job.given)
        OTX_TRY(otx_controls_find(
            m->job.run, &m->forest.tree, &m->forest.controls));
    OTX_TRY(otx_cluster_tree_list(m->job.run, &m->forest.tree, 0, &regions));
    return append_list(m, &regions, 0);
}

/* -- charts -------------------------------------------------------------- */

enum
{
    NODES_PER_STEP = 64 /* between two chances to cancel */
};

typedef struct flatten_job
{
    otx_mosaic *mosaic;
    int32_t first;
} flatten_job;

/* Side of a square of the cluster's area, texels. */
double
otx_forest_size(const otx_mosaic *m, const otx_node *node)
{
    return m->job.texels * sqrt(node->cluster.area);
}

double
otx_forest_band(const otx_mosaic *m, const otx_node *node)
{
    return fmin(
        BAND_MAXIMUM,
        fmax(BAND_MINIMUM, m->job.settings.band * otx_forest_size(m, node)));
}

double
otx_forest_collar(const otx_mosaic *m, const otx_node *node)
{
    const double band = otx_forest_band(m, node);

    if (m->job.settings.cut != OTX_PATCH_ON)
        return band;
    return fmax(
        otx_supply_meets(m, node) ? fmax(band, m->supplies.transition) : band,
        fmin(
            COLLAR_MAXIMUM, m->job.settings.collar * otx_forest_size(m, node)));
}

/* A crumpled collar can fold the core that it is laid out with: then a
 * narrower one is taken, in the end none, which leaves single faces whole. */
static otx_status
build_joint(
    const otx_mosaic *m, otx_node *node, otx_chart_request *request,
    otx_worker *worker)
{
    for (int32_t i = NARROWER;; --i)
    {
        OTX_TRY(otx_chart_build(
            request, node->leaves, node->leaf_count,
            &m->forest.spaces[worker->index], worker->scratch, node->arena,
            &node->chart));
        if (i == 0 || node->chart.worst < (double)INFINITY)
            return OSDTEX_OK;
        request->collar = i > 1 ? 0.5 * request->collar : 0.0;
    }
}

/* Parts of surfaces that are textured already have neighbours that are no
 * clusters: their regions are flattened with what is around. */
static bool
is_recursive(const otx_mosaic *m, const otx_node *node)
{
    return m->job.settings.flatten == OTX_PATCH_RECURSIVE &&
           (!m->job.given || node->cluster.face_count == 1);
}

static otx_status
flatten_node(void *context, int64_t index, otx_worker *worker)
{
    const flatten_job *job = context;
    otx_mosaic *m = job->mosaic;
    otx_node *node = &m->forest.nodes[job->first + index];
    otx_chart_request request = {
        .surface = m->job.surface,
        .leaves = &m->job.leaves,
        .texels = m->job.texels,
        .collar = fmax(
            otx_forest_collar(m, node),
            COLLAR_LEAVES * m->job.texels * m->job.surface->mean_edge_length),
        .bend = BEND,
        .rounds = 5,
        .worker = worker,
    };

    node->arena = otx_arena_create(m->job.run->allocator);
    if (!node->arena)
        return OSDTEX_ERROR_MEMORY;
    if (is_recursive(m, node))
        return otx_recursive_build(
            &request, &m->forest.controls, &node->cluster,
            &m->forest.spaces[worker->index], worker->scratch, node->arena,
            &node->chart);
    return build_joint(m, node, &request, worker);
}

void
otx_forest_free(otx_mosaic *m)
{
    for (int32_t i = 0; i < m->forest.count; ++i)
    {
        otx_arena_destroy(m->forest.nodes[i].arena);
        m->forest.nodes[i].arena = NULL;
    }
}

static void
free_charts(void *object)
{
    otx_forest_free(object);
}

bool
otx_forest_defer(otx_mosaic *m)
{
    return otx_arena_defer(m->job.run->arena, free_charts, m);
}

otx_status
otx_forest_flatten(otx_mosaic *m, int32_t first, int32_t end)
{
    while (first < end)
    {
        const int32_t count =
            end - first < NODES_PER_STEP ? end - first : NODES_PER_STEP;
        flatten_job job = {m, first};
        const otx_status status =
            otx_pool_for(m->job.run->pool, count, flatten_node, &job);

        if (status == OSDTEX_ERROR_MEMORY)
            return otx_fail_memory(m->job.run, "map");
        OTX_TRY(status);
        first += count;
        OTX_TRY(otx_progress(m->job.run, "flatten", (double)first / end));
    }
    return OSDTEX_OK;
}

bool
otx_forest_can_split(const otx_mosaic *m, const otx_node *node)
{
    return node->cluster.face_count > 1 ||
           node->cluster.level + 1 < m->job.surface->level_count;
}

bool
otx_forest_is_flat(const otx_mosaic *m, const otx_node *node)
{
    const otx_image *image = &otx_supply_of(m, node)->exemplar->match;
    const double side = fmin(image->width, image->height);

    return otx_supply_is_pure(m, node) &&
           otx_forest_size(m, node) <= EXEMPLAR_SHARE * side &&
           node->chart.distortion <= m->job.settings.flatness &&
           node->chart.worst <= 2.0 * m->job.settings.flatness;
}

int32_t
otx_forest_patches(const otx_mosaic *m, int32_t level)
{
    int32_t count = 0;

    for (int32_t i = 0; i < m->forest.count; ++i)
        count += m->forest.nodes[i].patch >= 0 &&
                 otx_cluster_tree_level(
                     &m->forest.tree, &m->forest.nodes[i].cluster) == level;
    return count;
}

otx_status
otx_forest_split(otx_mosaic *m, int32_t index)
{
    otx_node *node = &m->forest.nodes[index];
    const int32_t depth = node->depth + 1;
    otx_cluster_list list;

    node->retired = true;
    otx_arena_destroy(node->arena);
    node->arena = NULL;
    OTX_TRY(otx_cluster_tree_children(
        m->job.run, &m->forest.tree, &node->cluster, &list));
    ++m->tally.splits;
    return append_list(m, &list, depth);
}

otx_status
otx_forest_settle(otx_mosaic *m, int32_t first)
{
    while (first < m->forest.count)
    {
        const int32_t end = m->forest.count;

        OTX_TRY(otx_forest_flatten(m, first, end));
        for (int32_t i = first; i < end; ++i)
            if (!otx_forest_is_flat(m, &m->forest.nodes[i]) &&
                otx_forest_can_split(m, &m->forest.nodes[i]))
                OTX_TRY(otx_forest_split(m, i));
        first = end;
    }
    return OSDTEX_OK;
}

/* hierarchical.c -- the main loop [Soler02, sec. 2.2].
 *
 * One queue for all levels; wave.c says what comes first. Flatness depends on
 * the surface alone, so clusters that are not flat are split before anything
 * is fitted, and all charts are made in parallel. */
#include "method/hierarchical/hierarchical.h"

#include "method/density.h"
#include "seam/unit.h"

/* Flattens the nodes from `first` on, splits what is not flat, and goes on with
 * the children, until all are. */
static otx_status
flatten_from(otx_mapper *m, int32_t first)
{
    while (first < m->node_count)
    {
        const int32_t end = m->node_count;

        OTX_TRY(otx_nodes_flatten(m, first, end));
        for (int32_t i = first; i < end; ++i)
            if (!otx_nodes_is_flat(m, &m->nodes[i]) &&
                otx_nodes_can_split(m, &m->nodes[i]))
                OTX_TRY(otx_nodes_split(m, i));
        first = end;
    }
    return OSDTEX_OK;
}

/* Tells the neighbours of a new patch that more of their border is textured.
 */
static bool
wake_neighbours(otx_mapper *m, otx_pqueue *queue, int32_t index)
{
    const otx_level *leaf = m->leaves.level;
    const otx_node *node = &m->nodes[index];

    for (int32_t i = 0; i < node->leaf_count; ++i)
    {
        const int32_t f = node->leaves[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            otx_node *next;

            if (other < 0 || leaf->face_hole[other] ||
                m->face_patch[other] >= 0)
                continue;
            next = &m->nodes[m->leaf_node[other]];
            next->textured += otx_nodes_edge_length(
                m, leaf->face_edges[leaf->face_first[f] + k]);
            if (!otx_pqueue_push(
                    queue, otx_wave_key(m, m->leaf_node[other]),
                    m->leaf_node[other]))
                return false;
        }
    }
    return true;
}

static bool
push_range(otx_mapper *m, otx_pqueue *queue, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; ++i)
        if (!m->nodes[i].retired &&
            !otx_pqueue_push(queue, otx_wave_key(m, i), i))
            return false;
    return true;
}

/* Puts the children of a node that fitted nowhere into the queue. */
static otx_status
descend(otx_mapper *m, otx_pqueue *queue, int32_t index)
{
    const int32_t first = m->node_count;

    OTX_TRY(otx_nodes_split(m, index));
    OTX_TRY(flatten_from(m, first));
    if (!push_range(m, queue, first, m->node_count))
        return otx_fail_memory(m->run, "map");
    return OSDTEX_OK;
}

static otx_status
fails_to_fit(otx_mapper *m, int32_t index)
{
    const otx_cage *cage = m->surface->cage;
    const int32_t face = m->leaves.level->face_cage[m->nodes[index].leaves[0]];

    return otx_fail(
        m->run, OSDTEX_ERROR_LIMIT, "map",
        (otx_where){
            cage->path, cage->face_line ? cage->face_line[face] : 0, face, -1},
        cage->scheme == OTX_SCHEME_NONE
            ? "face %d is larger than the exemplar, which does not tile; raise "
              "{scale}, or subdivide the mesh with {scheme} bilinear"
            : "a leaf of face %d is larger than the exemplar, which does not "
              "tile; raise {level} or {scale}",
        face);
}

/* Commits a wave in its order; what is not accepted is split. */
static otx_status
settle(otx_mapper *m, otx_pqueue *queue, const otx_fit *fits, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
    {
        const int32_t index = fits[i].node;

        if (otx_fit_commit(m, &fits[i]))
        {
            if (!wake_neighbours(m, queue, index))
                return otx_fail_memory(m->run, "map");
        }
        else if (!otx_nodes_can_split(m, &m->nodes[index]))
            return fails_to_fit(m, index);
        else
            OTX_TRY(descend(m, queue, index));
    }
    return OSDTEX_OK;
}

static otx_status
fit_all(otx_mapper *m)
{
    otx_pqueue queue = otx_pqueue_make(m->run->scratch);
    const int32_t first = otx_first_node(m);
    otx_fit fits[OTX_WAVE_NODES];
    int32_t count;

    if ((first >= 0 && !otx_pqueue_push(&queue, -INFINITY, first)) ||
        !push_range(m, &queue, 0, m->node_count))
        return otx_fail_memory(m->run, "map");
    OTX_TRY(otx_wave_next(m, &queue, fits, &count));
    while (count > 0)
    {
        OTX_TRY(otx_fit_find(m, fits, count));
        OTX_TRY(settle(m, &queue, fits, count));
        /* The user's first patch was split: its part comes first. */
        if (first >= 0 && m->patch_count == 0 &&
            !otx_pqueue_push(&queue, -INFINITY, otx_first_node(m)))
            return otx_fail_memory(m->run, "map");
        OTX_TRY(otx_progress(
            m->run, "fit", fmin(1.0, m->done_area / m->total_area)));
        OTX_TRY(otx_wave_next(m, &queue, fits, &count));
    }
    return OSDTEX_OK;
}

static otx_status
allocate(otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;
    const int32_t threads = otx_pool_threads(m->run->pool);

    m->leaf_node = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    m->face_patch = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    m->patch_node = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    m->uvs = OTX_ZNEW(m->run->arena, otx_vec2, leaf->corner_count);
    m->spaces = OTX_NEW(m->run->arena, otx_chart_space, threads);
    if (!m->leaf_node || !m->face_patch || !m->patch_node || !m->uvs ||
        !m->spaces)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        m->leaf_node[f] = m->face_patch[f] = -1;
    if (m->given)
        otx_given_take(m);
    for (int32_t t = 0; t < threads; ++t)
        OTX_TRY(otx_chart_space_create(
            m->run, m->run->arena, m->surface, &m->spaces[t]));
    return OSDTEX_OK;
}

static otx_status
prepare(otx_mapper *m)
{
    OTX_TRY(otx_dual_build(
        m->run, m->surface, m->surface->level_count - 1, &m->leaves));
    for (int32_t f = 0; f < m->leaves.level->face_count; ++f)
        m->total_area += m->leaves.areas[f];
    OTX_TRY(allocate(m));
    if (!otx_nodes_defer(m))
        return otx_fail_memory(m->run, "map");
    return otx_supply_prepare(m);
}

/* All exemplars, the settings resolved for each. */
static void
list_supplies(
    otx_mapper *m, const otx_hierarchical_settings *settings,
    const otx_guide *guides)
{
    for (int32_t k = 0; k < m->supply_count; ++k)
    {
        otx_supply *s = &m->supplies[k];

        s->exemplar = &m->exemplars[k];
        s->settings = *settings;
        s->guide = guides && guides[k].directions ? &guides[k] : NULL;
        otx_hierarchical_resolve(&s->settings, m->exemplars);
        if (k > 0)
            otx_hierarchical_adapt(&s->settings, m->exemplars, s->exemplar);
    }
    m->settings = m->supplies[0].settings;
}

/*   guides  [exemplars]; without directions: not to be followed */
static otx_status
cover(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_map_request *request, const otx_guide *guides,
    const otx_hierarchical_settings *settings, const otx_method_given *given,
    otx_mapping *out, otx_map_stats *stats)
{
    otx_mapper *m = OTX_ZNEW(run->arena, otx_mapper, 1);

    if (!m)
        return otx_fail_memory(run, "map");
    m->run = run;
    m->surface = surface;
    m->exemplars = exemplars;
    m->supply_count = request->demand ? request->exemplar_count : 1;
    m->request = request;
    m->given = given;
    m->stats = stats;
    m->texels = otx_unit_texels(exemplars, request->scale);
    list_supplies(m, settings, guides);
    stats->threshold = m->settings.tau;

    OTX_TRY(prepare(m));
    OTX_TRY(otx_nodes_start(m));
    if (m->given && m->node_count == 0)
    {
        /* Nothing to cover, nothing to join. */
        m->settings.cut = OTX_HIERARCHICAL_OFF;
        m->settings.relax = OTX_HIERARCHICAL_RELAX_OFF;
    }
    otx_map_stats_stage(stats, "flatten");
    OTX_TRY(flatten_from(m, 0));
    otx_map_stats_stage(stats, "fit");
    OTX_TRY(fit_all(m));
    if (m->patch_count > 0)
        stats->fit_error_mean /= m->patch_count;
    return otx_assemble(m, out);
}

static otx_status
fill(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings,
    const otx_method_given *given, otx_mapping *out, otx_map_stats *stats)
{
    return cover(
        run, surface, exemplar, request, request->guide, settings, given, out,
        stats);
}

/* A field for patches to follow, where exemplar k has a direction.
 *
 *   known  what the exemplar is taken for; NULL: it is analysed
 *   kind   out: its name */
static otx_status
make_guide(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, int32_t k, const otx_analysis *known,
    otx_guide *guide, const char **kind)
{
    const otx_constraint_set *constraints;
    otx_analysis a;

    if (known)
        a = *known;
    else
        OTX_TRY(otx_analysis_run(
            run, &exemplar->lab, exemplar->wrap_x, exemplar->wrap_y, &a));
    *kind = otx_analysis_name(a.kind);
    if (a.kind == OTX_ANALYSIS_ISOTROPIC)
        return OSDTEX_OK;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "the exemplar is %s, at %.0f degrees: patches follow a field of "
        "symmetry %d",
        otx_analysis_name(a.kind), a.angle * 180.0 / OTX_PI, (int)a.symmetry);
    OTX_TRY(
        otx_first_constrain(run, surface, request, k, a.angle, &constraints));
    return otx_guide_make(run, surface, &a, constraints, guide);
}

static otx_status
make_guides(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_hierarchical_settings *settings, const otx_map_request *request,
    otx_guide *guides, otx_map_stats *stats)
{
    const int32_t count = request->demand ? request->exemplar_count : 1;

    if (request->guide)
        guides[0] = *request->guide;
    if (settings->guide != OTX_HIERARCHICAL_AUTO ||
        settings->mode == OTX_HIERARCHICAL_PAPER)
        return OSDTEX_OK;
    for (int32_t k = request->guide ? 1 : 0; k < count; ++k)
        OTX_TRY(make_guide(
            run, surface, &exemplars[k], request, k,
            k == 0 ? request->analysis : NULL, &guides[k], &stats->classes[k]));
    return OSDTEX_OK;
}

/* The sizes that the user asks for. */
static otx_status
make_density(
    otx_run *run, const otx_hierarchical_settings *settings,
    const otx_map_request *request, const otx_surface **surface)
{
    const otx_surface *plain = *surface;

    if (settings->flatten != OTX_HIERARCHICAL_RECURSIVE &&
        settings->mode != OTX_HIERARCHICAL_PAPER)
        return otx_density_apply(run, plain, request->constraints, surface);
    OTX_TRY(otx_density_apply(run, plain, request->constraints, surface));
    if (*surface != plain)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "map", OTX_NOWHERE,
            "the published method has one size everywhere; the scales among "
            "the constraints are left out");
    *surface = plain;
    return OSDTEX_OK;
}

static otx_status
map(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    otx_guide *guides = OTX_ZNEW(run->arena, otx_guide, OTX_EXEMPLARS_MAX);

    if (!guides)
        return otx_fail_memory(run, "map");
    OTX_TRY(make_density(run, settings, request, &surface));
    OTX_TRY(
        make_guides(run, surface, exemplars, settings, request, guides, stats));
    return cover(
        run, surface, exemplars, request, guides, settings, NULL, out, stats);
}

static void
resolve(void *settings, const otx_exemplar *exemplar)
{
    otx_hierarchical_resolve(settings, exemplar);
}

const otx_method otx_method_hierarchical = {
    .name = "hierarchical",
    .summary = "Covers the surface with patches of the exemplar, coarse to "
               "fine, that continue one another.",
    .source = "Soler, Cani, Angelidis: Hierarchical Pattern Mapping, 2002",
    .options = otx_hierarchical_options,
    .option_count = OTX_HIERARCHICAL_OPTION_COUNT,
    .settings_bytes = sizeof(otx_hierarchical_settings),
    .mixes = true,
    .begins = true,
    .resolve = resolve,
    .map = map,
    .fill = fill,
};

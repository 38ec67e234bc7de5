/* heal.c -- seams mended: charts, synthesis, and what comes of it. */
#include "heal/heal.h"

#include "heal/gate.h"
#include "heal/undo.h"
#include "territory/made.h"

#include <string.h>

enum
{
    CORE = 288,       /* texels across, of what a chart makes */
    LONGEST = 128,    /* texels of a section */
    AGAIN = 24,       /* texels beside a band that is undone */
    LEVELS_AGAIN = 3, /* of what is made again, which is whole already */
    ROUNDS_AGAIN = 4
};

#define SEEN 0.01 /* of the exemplar's spread: no less is a difference */

typedef struct healer
{
    const otx_heal_options *options;
    uint8_t *seam; /* [leaf edge_count] to be mended */
    otx_section_list sections;
    uint8_t *mended; /* [sections.count] */
    otx_target_set set;
    double itself; /* mean distance of the exemplar at hand from its rest */
    otx_heal_figures *figures;
} healer;

/* Where two exemplars meet is no seam to mend. */
static otx_status
list_seams(healer *h, otx_heal_figures *figures)
{
    const otx_level *leaf = otx_surface_leaf(h->set.mapping->surface);
    otx_run *run = h->set.run;
    const otx_mapping *mapping = h->set.mapping;
    otx_seam_list seams;

    h->seam = OTX_ZNEW(run->scratch, uint8_t, leaf->edge_count);
    if (!h->seam)
        return otx_fail_memory(run, "heal");
    OTX_TRY(otx_seam_collect(run, mapping, h->set.exemplars, &seams));
    for (int32_t i = 0; i < seams.edge_count; ++i)
        h->seam[seams.edges[i]] = !seams.transition[i];
    figures->seam_length = seams.total_length - seams.transition_length;
    if (!h->options->gate)
        return OSDTEX_OK;
    OTX_TRY(otx_section_find(run, leaf, &seams, LONGEST, &h->sections));
    h->mended = OTX_ZNEW(run->scratch, uint8_t, h->sections.count);
    return otx_run_ok(run);
}

static otx_status
synthesise(
    healer *h, const otx_pattern *pattern, const otx_synth_chart *charts,
    int32_t levels, int32_t starts, int32_t rounds)
{
    otx_run *run = h->set.run;
    otx_synth_options options = otx_synth_mending();

    options.levels = levels;
    options.coarse_radius = h->options->coarse_radius;
    options.starts = starts;
    options.rounds = rounds;
    options.seed = run->seed + (uint64_t)h->set.exemplar;
    options.stage = "heal";
    return otx_synth_run(
        run, pattern, charts, h->set.territory.count, &options);
}

/* Texels near seams that are to be mended are FREE; the number of them. */
static otx_status
fill(healer *h, int64_t *free)
{
    otx_target_set *set = &h->set;

    *free = 0;
    for (int32_t k = 0; k < set->territory.count; ++k)
    {
        otx_plot *plot = &set->plots[k];

        if (set->territory.exemplar[k] != set->exemplar)
            continue;
        memset(plot->near, 0, (size_t)plot->width * (size_t)plot->height);
        otx_plot_mark(
            set->mapping->surface, h->seam, 0.5 * h->options->band, plot);
    }
    for (int32_t k = 0; k < set->territory.count; ++k)
        if (set->territory.exemplar[k] == set->exemplar)
        {
            OTX_TRY(otx_target_fill(set, k));
            *free += set->targets[k].free;
        }
    return OSDTEX_OK;
}

/* What is mended is what shows more than nine of ten windows elsewhere. */
static void
choose(healer *h, const otx_gate_view *view)
{
    const otx_level *leaf = otx_surface_leaf(h->set.mapping->surface);
    const otx_section_list *list = &h->sections;
    const double least = SEEN * h->set.exemplars[h->set.exemplar].lab_sigma;

    for (int32_t i = 0; i < list->count; ++i)
    {
        const otx_section_sum on = view->on[i];

        if (on.count > 0)
            h->mended[i] =
                on.sum > (view->interior_p90 + least) * (double)on.count;
    }
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        if (list->of_edge[e] >= 0)
            h->seam[e] = h->mended[list->of_edge[e]];
}

static double
mean_of(const healer *h, const otx_section_sum *sums)
{
    otx_section_sum all = {0.0, 0};

    for (int32_t i = 0; i < h->sections.count; ++i)
        if (h->mended[i])
        {
            all.sum += sums[i].sum;
            all.count += sums[i].count;
        }
    return all.count > 0 ? all.sum / (double)all.count : 0.0;
}

/* Distances before (0) or after (1), of the exemplar that has most to tell. */
static void
tell(healer *h, const otx_gate_view *view, int when)
{
    const double sigma = h->set.exemplars[h->set.exemplar].lab_sigma;
    const double unit = sigma > 0.0 ? 1.0 / sigma : 0.0;
    otx_heal_figures *f = h->figures;

    if (when == 0) /* that was the gate */
        f->windows_interior_p90 = unit * view->interior_p90;
    f->windows_itself = unit * h->itself;
    f->windows_on[when] = unit * mean_of(h, view->on);
    f->windows_around[when] = unit * mean_of(h, view->around);
    f->windows_all[when] = view->all.count > 0
                               ? unit * view->all.sum / (double)view->all.count
                               : 0.0;
}

static void
read_collars(healer *h)
{
    for (int32_t k = 0; k < h->set.territory.count; ++k)
        if (h->set.territory.exemplar[k] == h->set.exemplar)
            otx_target_read_collar(&h->set, k);
}

/* What got worse around is not to be mended. Returns whether there is any.
 *
 *   undone  [leaf edge_count] zeros */
static bool
reject(
    healer *h, const otx_gate_view *before, const otx_gate_view *after,
    uint8_t *undone)
{
    const otx_level *leaf = otx_surface_leaf(h->set.mapping->surface);
    const otx_section_list *list = &h->sections;
    bool any = false;

    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t i = list->of_edge[e];

        if (i < 0 || !h->seam[e] || before->around[i].count == 0 ||
            after->around[i].sum <= before->around[i].sum)
            continue;
        h->mended[i] = 0;
        h->seam[e] = 0;
        undone[e] = 1;
        any = true;
    }
    return any;
}

/* Looks at what was made, and cuts what it did not help as it was. */
static otx_status
check(
    healer *h, const otx_pattern *pattern, otx_synth_chart *charts,
    const otx_gate_view *before)
{
    otx_target_set *set = &h->set;
    const otx_level *leaf = otx_surface_leaf(set->mapping->surface);
    uint8_t *undone = OTX_ZNEW(set->run->scratch, uint8_t, leaf->edge_count);
    otx_gate_view after;
    otx_undo kept;
    int64_t free;

    OTX_TRY(otx_run_ok(set->run));
    read_collars(h);
    OTX_TRY(otx_gate_judge(set, pattern, &h->sections, &after));
    if (reject(h, before, &after, undone))
    {
        OTX_TRY(
            otx_undo_keep(set, undone, 0.5 * h->options->band + AGAIN, &kept));
        OTX_TRY(fill(h, &free));
        otx_undo_freeze(set, &kept);
        otx_target_charts(set, charts);
        OTX_TRY(synthesise(h, pattern, charts, LEVELS_AGAIN, 1, ROUNDS_AGAIN));
        otx_undo_thaw(set, &kept);
        read_collars(h);
        OTX_TRY(otx_gate_judge(set, pattern, &h->sections, &after));
    }
    tell(h, before, 0);
    tell(h, &after, 1);
    return OSDTEX_OK;
}

/* All charts of one exemplar, made together. */
static otx_status
heal_exemplar(healer *h)
{
    otx_target_set *set = &h->set;
    const int32_t count = set->territory.count;
    otx_synth_chart *charts =
        OTX_NEW(set->run->scratch, otx_synth_chart, count);
    otx_gate_view before;
    otx_pattern pattern;
    int64_t free = 0;

    if (!charts)
        return otx_fail_memory(set->run, "heal");
    OTX_TRY(fill(h, &free));
    if (free == 0)
        return OSDTEX_OK;
    OTX_TRY(otx_target_pattern(set, h->options->levels, &pattern));
    if (h->options->gate)
    {
        OTX_TRY(otx_gate_judge_exemplar(set, &pattern, &h->itself));
        OTX_TRY(otx_gate_judge(set, &pattern, &h->sections, &before));
        choose(h, &before);
        tell(h, &before, 0);
        tell(h, &before, 1);
        OTX_TRY(fill(h, &free));
        if (free == 0)
            return OSDTEX_OK;
    }
    otx_target_charts(set, charts);
    OTX_TRY(synthesise(
        h, &pattern, charts, h->options->levels, h->options->starts, 0));
    if (!h->options->gate)
        return OSDTEX_OK;
    return check(h, &pattern, charts, &before);
}

static otx_status
heal(healer *h, const otx_source_field **out)
{
    otx_target_set *set = &h->set;
    otx_heal_figures *figures = h->figures;
    const int32_t radius = h->options->coarse_radius;

    OTX_TRY(list_seams(h, figures));
    if (!(figures->seam_length > 0.0))
        return OSDTEX_OK;
    OTX_TRY(otx_target_set_lay_out(
        set, CORE, (double)(radius << (h->options->levels - 1)) + 4.0));
    for (set->exemplar = 0; set->exemplar < otx_source_count(set->mapping);
         ++set->exemplar)
        OTX_TRY(heal_exemplar(h));
    for (int32_t k = 0; k < set->territory.count; ++k)
    {
        figures->charts += set->targets[k].free > 0;
        figures->texels += set->targets[k].free;
    }
    figures->sections = h->sections.count;
    for (int32_t i = 0; i < h->sections.count; ++i)
        if (h->mended[i])
        {
            ++figures->mended;
            figures->mended_length += h->sections.lengths[i];
        }
    figures->area = set->texels * set->texels * set->mapping->surface->area;
    return figures->texels > 0 ? otx_made_hand_out(set, out) : OSDTEX_OK;
}

otx_status
otx_heal_run(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_heal_options *options, const otx_source_field **out,
    otx_heal_figures *figures)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    healer h = {
        .options = options,
        .figures = figures,
        .set = {
            .run = run,
            .mapping = mapping,
            .exemplars = exemplars,
            .texels = otx_seam_texels_per_unit(mapping, exemplars)}};
    otx_status status;

    *out = NULL;
    *figures = (otx_heal_figures){0};
    status = heal(&h, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

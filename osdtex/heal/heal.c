/* heal.c -- seams mended: charts, synthesis, and what comes of it. */
#include "heal/heal.h"

#include "mapping/seam.h"
#include "territory/made.h"

enum
{
    CORE = 288 /* texels across, of what a chart makes */
};

typedef struct healer
{
    const otx_heal_options *options;
    uint8_t *seam; /* [leaf edge_count] */
    otx_target_set set;
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
    return OSDTEX_OK;
}

static otx_status
synthesise(healer *h, const otx_synth_chart *charts)
{
    otx_run *run = h->set.run;
    otx_synth_options options = otx_synth_mending();
    otx_pattern pattern;

    options.levels = h->options->levels;
    options.coarse_radius = h->options->coarse_radius;
    options.starts = h->options->starts;
    options.seed = run->seed + (uint64_t)h->set.exemplar;
    options.stage = "heal";
    OTX_TRY(otx_target_pattern(&h->set, options.levels, &pattern));
    return otx_synth_run(
        run, &pattern, charts, h->set.territory.count, &options);
}

/* All charts of one exemplar, made together. */
static otx_status
heal_exemplar(healer *h)
{
    otx_target_set *set = &h->set;
    const int32_t count = set->territory.count;
    otx_synth_chart *charts =
        OTX_NEW(set->run->scratch, otx_synth_chart, count);
    int64_t free = 0;

    if (!charts)
        return otx_fail_memory(set->run, "heal");
    for (int32_t k = 0; k < count; ++k)
        if (set->territory.exemplar[k] == set->exemplar)
        {
            OTX_TRY(otx_target_fill(set, k));
            free += set->targets[k].free;
        }
    otx_target_charts(set, charts);
    return free > 0 ? synthesise(h, charts) : OSDTEX_OK;
}

static otx_status
heal(healer *h, const otx_source_field **out, otx_heal_figures *figures)
{
    otx_target_set *set = &h->set;
    const int32_t radius = h->options->coarse_radius;

    OTX_TRY(list_seams(h, figures));
    if (!(figures->seam_length > 0.0))
        return OSDTEX_OK;
    OTX_TRY(otx_target_set_lay_out(
        set, CORE, (double)(radius << (h->options->levels - 1)) + 4.0));
    for (int32_t k = 0; k < set->territory.count; ++k)
        otx_plot_mark(
            set->mapping->surface, h->seam, 0.5 * h->options->band,
            &set->plots[k]);
    for (set->exemplar = 0; set->exemplar < otx_source_count(set->mapping);
         ++set->exemplar)
        OTX_TRY(heal_exemplar(h));
    for (int32_t k = 0; k < set->territory.count; ++k)
    {
        figures->charts += set->targets[k].free > 0;
        figures->texels += set->targets[k].free;
    }
    figures->area = set->texels * set->texels * set->mapping->surface->area;
    return otx_made_hand_out(set, out);
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
        .set = {
            .run = run,
            .mapping = mapping,
            .exemplars = exemplars,
            .texels = otx_seam_texels_per_unit(mapping, exemplars)}};
    otx_status status;

    *out = NULL;
    *figures = (otx_heal_figures){0};
    status = heal(&h, out, figures);
    otx_arena_release(run->scratch, mark);
    return status;
}

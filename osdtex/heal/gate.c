/* gate.c -- which seams are mended: those that show, where mending helps. */
#include "heal/gate.h"

#include "base/sort.h"

#define ON 8.0      /* texels: windows have a middle every eight */
#define AROUND 48.0 /* texels that are looked at for what mending does */
#define AWAY 40.0   /* texels from which no seam is in a window of 56 */

otx_status
otx_gate_judge_exemplar(
    otx_target_set *set, const otx_pattern *pattern, double *out)
{
    otx_judge_options options = otx_judge_options_default();
    double ignored;

    options.seed = set->run->seed;
    options.passes = 12; /* from nothing */
    return otx_judge_itself(
        set->run, pattern, AWAY, &options, 0.9, out, &ignored);
}

/* Everything is there; what the chart does not own is looked at only. */
static uint8_t *
kinds_of(const otx_target_set *set, int32_t k)
{
    const otx_plot *plot = &set->plots[k];
    const int64_t count = (int64_t)plot->width * plot->height;
    const uint8_t *kinds = set->targets[k].kinds;
    uint8_t *out = OTX_NEW(set->run->scratch, uint8_t, count);

    for (int64_t i = 0; out && i < count; ++i)
        out[i] = kinds[i] == OTX_SYNTH_VOID ? (uint8_t)OTX_SYNTH_VOID
                 : plot->facets[i] / OTX_PLOT_FACETS < plot->chart->core_count
                     ? (uint8_t)OTX_SYNTH_FREE
                     : (uint8_t)OTX_SYNTH_FROZEN;
    return out;
}

static otx_status
charts_of(const otx_target_set *set, otx_synth_chart *out)
{
    for (int32_t k = 0; k < set->territory.count; ++k)
    {
        out[k] = (otx_synth_chart){0};
        if (set->territory.exemplar[k] != set->exemplar ||
            set->plots[k].width == 0)
            continue;
        out[k] = (otx_synth_chart){
            .width = set->plots[k].width,
            .height = set->plots[k].height,
            .kinds = kinds_of(set, k),
            .metric = set->targets[k].metric,
            .matches = set->targets[k].matches};
    }
    return otx_run_ok(set->run);
}

static void
add_all(const otx_judged *judged, otx_section_sum *sum)
{
    for (int64_t i = 0; i < (int64_t)judged->width * judged->height; ++i)
        if (judged->distances[i] >= 0.0f)
        {
            sum->sum += judged->distances[i];
            ++sum->count;
        }
}

static otx_status
find_interior(
    const otx_target_set *set, const otx_section_list *list, otx_gate_view *out)
{
    const otx_arena_mark mark = otx_arena_here(set->run->scratch);
    double *values = OTX_NEW(set->run->scratch, double, out->all.count);
    int64_t n = 0, count;

    OTX_TRY(otx_run_ok(set->run));
    for (int32_t k = 0; k < set->territory.count; ++k)
        if (out->judged[k].width > 0)
        {
            OTX_TRY(otx_section_beyond(
                set, k, &out->judged[k], list, AWAY, values + n, &count));
            n += count;
        }
    otx_sort_doubles(values, (size_t)n);
    out->interior_p90 = n > 0 ? values[(9 * n) / 10] : 0.0;
    otx_arena_release(set->run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_gate_look(otx_target_set *set, const otx_pattern *pattern, otx_judged *out)
{
    const int32_t count = set->territory.count;
    otx_judge_options options = otx_judge_options_default();
    otx_synth_chart *charts =
        OTX_NEW(set->run->scratch, otx_synth_chart, count);

    options.seed = set->run->seed;
    OTX_TRY(otx_run_ok(set->run));
    OTX_TRY(charts_of(set, charts));
    return otx_judge_windows(set->run, pattern, charts, count, &options, out);
}

otx_status
otx_gate_judge(
    otx_target_set *set, const otx_pattern *pattern,
    const otx_section_list *list, otx_gate_view *out)
{
    otx_arena *arena = set->run->scratch;
    const int32_t count = set->territory.count;

    *out = (otx_gate_view){
        .judged = OTX_NEW(arena, otx_judged, count),
        .on = OTX_ZNEW(arena, otx_section_sum, list->count),
        .around = OTX_ZNEW(arena, otx_section_sum, list->count)};
    OTX_TRY(otx_run_ok(set->run));
    OTX_TRY(otx_gate_look(set, pattern, out->judged));
    for (int32_t k = 0; k < count; ++k)
    {
        if (out->judged[k].width == 0)
            continue;
        add_all(&out->judged[k], &out->all);
        OTX_TRY(
            otx_section_measure(set, k, &out->judged[k], list, ON, out->on));
        OTX_TRY(otx_section_measure(
            set, k, &out->judged[k], list, AROUND, out->around));
    }
    return find_interior(set, list, out);
}

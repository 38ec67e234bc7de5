/* figures.c -- the numbers beside the picture. */
#include "studio/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the report, those that a person directs by. */
static const char *const SHOWN[] = {
    "seams.visible_share", "seams.energy", "seams.delta_e_p50",
    "seams.length_texels", "distortion.stretch_ratio_p95"};

static json_t *
report_figures(osdtex_context *context, const osdtex_mapping *mapping)
{
    osdtex_report_options options = osdtex_report_options_default();
    osdtex_report *report;
    json_t *rows = NULL;

    options.windows = 0;
    if (osdtex_report_create(context, mapping, &options, &report) != OSDTEX_OK)
        return NULL;

    const osdtex_report_info *info = osdtex_report_describe(report);

    rows = json_array();
    for (int32_t i = 0; i < info->figure_count; ++i)
        for (size_t k = 0; k < sizeof SHOWN / sizeof *SHOWN; ++k)
            if (strcmp(info->figures[i].key, SHOWN[k]) == 0 &&
                isfinite(info->figures[i].value))
                json_array_append_new(
                    rows,
                    json_pack(
                        "{s:s, s:f, s:s, s:s}", "key", info->figures[i].key,
                        "value", info->figures[i].value, "unit",
                        info->figures[i].unit, "sentence",
                        info->figures[i].sentence));
    osdtex_report_destroy(report);
    return rows;
}

static json_t *
worst_places(const otx_snapshot *s)
{
    const osdtex_seams_info *seams = osdtex_seams_describe(s->outcome->seams);
    json_t *list = json_array();

    for (int32_t i = 0; i < seams->place_count; ++i)
    {
        const osdtex_seam_place *p = &seams->places[i];

        json_array_append_new(
            list, json_pack(
                      "{s:[f,f,f], s:[f,f,f], s:f, s:f}", "point", p->point[0],
                      p->point[1], p->point[2], "normal", p->normal[0],
                      p->normal[1], p->normal[2], "length", p->length,
                      "difference", p->difference));
    }
    return list;
}

json_t *
otx_figures_facts(const otx_snapshot *s)
{
    const osdtex_mapping_info *m = osdtex_mapping_describe(s->outcome->mapping);
    const osdtex_exemplar_info *e =
        osdtex_exemplar_describe(s->outcome->exemplars[0]);

    return json_pack(
        "{s:i, s:i, s:s, s:f, s:i, s:o}", "faces", (int)m->face_count,
        "patches", (int)m->patch_count, "method", m->method, "scale", m->scale,
        "slices", (int)e->slices, "places", worst_places(s));
}

json_t *
otx_figures_of(osdtex_context *context, const otx_snapshot *s)
{
    json_t *rows = report_figures(context, s->outcome->mapping);
    osdtex_exemplar_structure structure;

    if (!rows)
        return NULL;
    if (osdtex_exemplar_analyse(
            context, s->outcome->exemplars[0], &structure) != OSDTEX_OK)
    {
        json_decref(rows);
        return NULL;
    }
    return json_pack(
        "{s:s, s:i, s:o}", "class", structure.name, "symmetry",
        (int)structure.symmetry, "rows", rows);
}

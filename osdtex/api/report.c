/* report.c -- what was done, as JSON for scripts.
 *
 * Keys are sorted and numbers are printed by jansson, which undoes a decimal
 * comma. What is in it is described in docs/report.md. */
#include "api/report.h"
#include "api/field_report.h"
#include "api/handle.h"
#include "api/report_handover.h"
#include "api/tile_report.h"
#include "base/hash.h"
#include "mapping/measure.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

static const char *const schemes[] = {"catmark", "loop", "bilinear", "none"};
static const char *const boundaries[] = {"none", "edgeOnly", "edgeAndCorner"};
static const char *const fvars[] = {
    "none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};

/* Text that may be absent, and whose bytes a file may have made up: what is no
 * UTF-8 is replaced by '?'. */
static json_t *
text_of(const char *text)
{
    json_t *result = text ? json_string(text) : json_null();
    char plain[1024];
    size_t i = 0;

    if (result)
        return result;
    for (; text[i] && i + 1 < sizeof plain; ++i)
        plain[i] = text[i] >= ' ' && text[i] <= '~' ? text[i] : '?';
    plain[i] = '\0';
    return json_string(plain);
}

/* JSON has no infinity: such a figure is null. */
static json_t *
real_of(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static void
set(json_t *object, const char *key, json_t *value)
{
    json_object_set_new(object, key, value);
}

static void
set_text(json_t *object, const char *key, const char *value)
{
    set(object, key, text_of(value));
}

static void
set_real(json_t *object, const char *key, double value)
{
    set(object, key, real_of(value));
}

static void
set_int(json_t *object, const char *key, int64_t value)
{
    set(object, key, json_integer((json_int_t)value));
}

static json_t *
add_object(json_t *parent, const char *key)
{
    json_t *object = json_object();

    set(parent, key, object);
    return object;
}

static json_t *
add_array(json_t *parent, const char *key)
{
    json_t *array = json_array();

    set(parent, key, array);
    return array;
}

static void
put_exemplar(json_t *e, const osdtex_exemplar_info *exemplar)
{
    set_text(e, "path", exemplar->path);
    set_text(e, "hash", exemplar->hash);
    set_text(e, "type", exemplar->type);
    set_int(e, "width", exemplar->width);
    set_int(e, "height", exemplar->height);
    set_int(e, "channels", exemplar->channels);
}

/* The other maps of a material, by what they are. */
static void
put_maps(json_t *parent, const otx_companions *companions)
{
    json_t *maps;

    if (!otx_companions_are_there(companions))
        return;
    maps = add_object(parent, "maps");
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const otx_companion *map = &companions->maps[k];
        json_t *one;

        if (!map->is_there)
            continue;
        one = add_object(maps, otx_companion_name((otx_companion_kind)k));
        set_text(one, "path", map->path);
        if (map->layer)
            set_text(one, "layer", map->layer);
        set_text(one, "hash", map->hash);
        set_text(one, "type", map->type);
        set_text(one, "space", "data");
        set_int(one, "channel", map->channel);
        set_int(one, "width", map->width);
        set_int(one, "height", map->height);
        if (k == OTX_COMPANION_NORMAL)
            set_text(one, "y", map->y_down ? "down" : "up");
        if (map->is_inverted)
            set(one, "inverted", json_true());
    }
}

static void
put_inputs(json_t *root, const osdtex_mapping *mapping)
{
    const osdtex_cage_info *cage = &mapping->surface->cage->info;
    const osdtex_exemplar_info *exemplar = &mapping->exemplar->info;
    json_t *inputs = add_object(root, "inputs");
    json_t *c = add_object(inputs, "cage");
    json_t *e = add_object(inputs, "exemplar");

    set_text(c, "path", cage->path);
    set_text(c, "hash", cage->hash);
    set_int(c, "vertices", cage->vert_count);
    set_int(c, "faces", cage->face_count);
    set_int(c, "edges", cage->edge_count);
    set_int(c, "components", cage->component_count);
    set_int(c, "boundary_edges", cage->boundary_edge_count);
    set_int(c, "creases", cage->crease_count);
    set_int(c, "corners", cage->corner_count);
    set_int(c, "holes", cage->hole_count);
    set_real(c, "diagonal", cage->diagonal);
    put_exemplar(e, exemplar);
    put_maps(e, &mapping->exemplar->exemplar.companions);
}

/* Of several: what became of each. */
static void
put_exemplars(
    json_t *root, const osdtex_mapping *mapping, const otx_measure *measure)
{
    json_t *list, *transitions;

    if (mapping->source_count == 1)
        return;
    list = add_array(root, "exemplars");
    for (int32_t k = 0; k < mapping->source_count; ++k)
    {
        const osdtex_exemplar_info *info = &mapping->sources[k]->info;
        const otx_exemplar *exemplar = &mapping->exemplars[k];
        const otx_measure_share *share = &measure->shares[k];
        json_t *one = json_object();

        json_array_append_new(list, one);
        put_exemplar(one, info);
        put_maps(one, &exemplar->companions);
        set_text(one, "from", info->source_space);
        set_text(one, "class", mapping->figures.classes[k]);
        set(one, "wrap_x", json_boolean(info->wrap_x));
        set(one, "wrap_y", json_boolean(info->wrap_y));
        set_real(
            one, "scale",
            mapping->mapping.scale * exemplar->match.width /
                mapping->exemplars[0].match.width);
        set_int(one, "faces", share->faces);
        set_real(
            one, "area_share",
            measure->area > 0.0 ? share->area / measure->area : 0.0);
        set_real(one, "coverage", share->coverage);
    }
    transitions = add_object(root, "transitions");
    set_real(transitions, "length_texels", measure->transition_length);
    set_real(transitions, "delta_e_rms", measure->transition_rms);
}

static void
put_settings(json_t *options, const osdtex_mapping *mapping)
{
    json_t *settings = add_object(options, "settings");
    char text[64];

    for (int32_t i = 0; i < mapping->method->option_count; ++i)
    {
        const otx_option *option = &mapping->method->options[i];

        otx_option_text(option, mapping->settings, text);
        set_text(settings, option->name, text);
    }
}

static void
put_options(
    json_t *root, const osdtex_context *context, const osdtex_mapping *mapping)
{
    const osdtex_cage_info *cage = &mapping->surface->cage->info;
    const otx_map_request *request = &mapping->request;
    json_t *options = add_object(root, "options");

    set_text(options, "method", mapping->method->name);
    set_text(options, "scheme", schemes[cage->scheme]);
    set_text(options, "boundary", boundaries[cage->boundary]);
    set_text(options, "fvar", fvars[cage->fvar]);
    set_int(options, "level", mapping->surface->info.level);
    set_real(options, "scale", mapping->mapping.scale);
    set_int(options, "seed", (int64_t)mapping->seed);
    set_int(options, "threads", otx_pool_threads(context->pool));
    set_int(options, "memory_limit", (int64_t)context->options.memory_limit);
    if (request->first_face >= 0)
    {
        json_t *first = add_object(options, "first_patch");

        set_int(first, "face", request->first_face);
        set_real(first, "u", request->first_position.x);
        set_real(first, "v", request->first_position.y);
        set_real(first, "angle", request->first_angle * 180.0 / OTX_PI);
    }
    put_settings(options, mapping);
}

static void
put_colour(
    json_t *root, const osdtex_context *context, const osdtex_mapping *mapping)
{
    const osdtex_exemplar_info *info = &mapping->exemplar->info;
    json_t *colour = add_object(root, "colour");
    json_t *decisions = add_array(colour, "decisions");
    char hash[OTX_HASH_TEXT_BYTES];
    osdtex_diagnostic d;

    set_text(
        colour, "config",
        context->colour.path ? context->colour.path : "built in");
    if (context->colour.path && otx_hash_file(context->colour.path, hash))
        set_text(colour, "config_hash", hash);
    set_text(colour, "from", info->source_space);
    set_text(colour, "to", info->linear_space);
    if (otx_receiver_name(mapping->exemplar->exemplar.receiver))
        set_text(
            colour, "for",
            otx_receiver_name(mapping->exemplar->exemplar.receiver));
    set_text(colour, "match_space", info->match_space);
    set_text(colour, "embedding", info->embedding);
    set(colour, "wrap_x", json_boolean(info->wrap_x));
    set(colour, "wrap_y", json_boolean(info->wrap_y));
    set(colour, "made_tileable", json_boolean(info->made_tileable));
    for (int32_t i = 0; i < osdtex_diagnostic_count(context); ++i)
    {
        osdtex_diagnostic_get(context, i, &d);
        if (strcmp(d.stage, "colour") == 0)
            json_array_append_new(decisions, text_of(d.message));
    }
}

/* The object below `parent` that a figure's name leads into, made where it is
 * not there, and what is left of the name. */
static json_t *
figure_parent(json_t *parent, const char *name, const char **key)
{
    const char *dot = strchr(name, '.');
    char group[64];
    json_t *inner;

    *key = name;
    if (!dot)
        return parent;
    snprintf(group, sizeof group, "%.*s", (int)(dot - name), name);
    inner = json_object_get(parent, group);
    return figure_parent(
        inner ? inner : add_object(parent, group), dot + 1, key);
}

static void
put_figure(json_t *mapping, const otx_figure *figure)
{
    const char *key;
    json_t *parent = figure_parent(mapping, figure->name, &key), *list;

    switch (figure->kind)
    {
    case OTX_FIGURE_COUNT:
        set_int(parent, key, (int64_t)figure->value);
        return;
    case OTX_FIGURE_REAL:
        set_real(parent, key, figure->value);
        return;
    case OTX_FIGURE_ITEM:
        list = json_object_get(parent, key);
        json_array_append_new(
            list ? list : add_array(parent, key),
            json_integer((json_int_t)figure->value));
    }
}

static void
put_mapping(json_t *root, const osdtex_mapping *mapping)
{
    const otx_figures *figures = &mapping->figures;
    const osdtex_surface_info *surface = &mapping->surface->info;
    json_t *m = add_object(root, "mapping");

    set_int(m, "leaf_faces", surface->face_count);
    set_int(m, "leaf_vertices", surface->vert_count);
    set_real(m, "area", surface->area);
    set_real(m, "mean_edge_length", surface->mean_edge_length);
    set_int(m, "patches", mapping->mapping.patch_count);
    for (int32_t i = 0; i < figures->count; ++i)
        put_figure(m, &figures->rows[i]);
}

static void
put_seams(json_t *root, const otx_measure *measure)
{
    json_t *seams = add_object(root, "seams");
    json_t *windows = add_object(seams, "windows");

    set_real(seams, "energy", measure->seam_energy);
    set_real(seams, "delta_e_rms", measure->seam_rms);
    set_real(seams, "delta_e_p50", measure->seam_p50);
    set_real(seams, "delta_e_p95", measure->seam_p95);
    set_real(seams, "rms_per_sigma", measure->seam_rms_sigma);
    set_real(seams, "rms_per_step", measure->seam_rms_step);
    set_real(seams, "p95_per_sigma", measure->seam_p95_sigma);
    set_real(seams, "visible_share", measure->seam_visible_share);
    set_real(seams, "length_texels", measure->seam_length);
    set_real(seams, "share_of_edges", measure->seam_share);
    set_real(seams, "per_100_texels", measure->seams_per_100);
    set_int(windows, "count", measure->windows);
    set_real(windows, "seam_p50", measure->window_seam_p50);
    set_real(windows, "seam_p90", measure->window_seam_p90);
    set_real(windows, "interior_p50", measure->window_interior_p50);
    set_real(windows, "interior_p90", measure->window_interior_p90);
}

static void
put_distortion(json_t *root, const otx_measure *measure)
{
    json_t *d = add_object(root, "distortion");
    json_t *e = add_object(root, "exemplar");

    set_int(d, "flips", measure->flips);
    set_int(d, "folds", measure->folds);
    set_int(d, "uncovered", measure->uncovered);
    set_int(d, "outside", measure->outside);
    set_real(d, "outside_max_texels", measure->outside_max);
    set_real(d, "log_area_mean", measure->log_area_mean);
    set_real(d, "stretch_l2_mean", measure->stretch_l2_mean);
    set_real(d, "stretch_l2_p95", measure->stretch_l2_p95);
    set_real(d, "stretch_ratio_mean", measure->stretch_ratio_mean);
    set_real(d, "stretch_ratio_p95", measure->stretch_ratio_p95);
    set_real(e, "coverage", measure->coverage);
    set_real(e, "lab_sigma", measure->lab_sigma);
    set_real(e, "lab_step", measure->lab_step);
    set_real(e, "texels_per_unit", measure->texels_per_unit);
    set_real(e, "area_texels", measure->area);
}

static void
put_cost(
    json_t *root, const osdtex_context *context, const osdtex_mapping *mapping)
{
    json_t *seconds = add_object(root, "seconds");
    json_t *stages = add_object(seconds, "map_stages");
    json_t *memory = add_object(root, "memory");
    struct rusage usage;

    for (int32_t i = 0; i < context->time_count; ++i)
        set_real(seconds, context->times[i].stage, context->times[i].seconds);
    for (int32_t i = 0; i < mapping->figures.stage_count; ++i)
        set_real(
            stages, mapping->figures.stages[i].name,
            mapping->figures.stages[i].seconds);
    set_int(
        memory, "peak_bytes", (int64_t)otx_allocator_peak(context->allocator));
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        set_int(memory, "peak_resident_bytes", 1024 * (int64_t)usage.ru_maxrss);
}

static void
put_diagnostics(json_t *root, const osdtex_context *context)
{
    static const char *const severities[] = {"info", "warning", "error"};
    json_t *list = add_array(root, "diagnostics");
    osdtex_diagnostic d;

    for (int32_t i = 0; i < osdtex_diagnostic_count(context); ++i)
    {
        json_t *one = json_object();

        osdtex_diagnostic_get(context, i, &d);
        set_text(one, "severity", severities[d.severity]);
        set_text(one, "status", osdtex_status_name(d.status));
        set_text(one, "stage", d.stage);
        set_text(one, "file", d.file);
        set_int(one, "line", d.line);
        set_int(one, "face", d.face);
        set_int(one, "vertex", d.vertex);
        set_int(one, "count", d.count);
        set_text(one, "message", d.message);
        json_array_append_new(list, one);
    }
}

static void
release_json(void *root)
{
    json_decref(root);
}

otx_status
otx_report_build(
    otx_call *call, const osdtex_mapping *mapping, int32_t windows,
    json_t **out)
{
    const otx_measure_options how = {.window_count = windows};
    const osdtex_context *context = call->context;
    otx_run *run = &call->run;
    char mark[OTX_MARK_BYTES];
    otx_measure measure;
    json_t *root;

    run->seed = mapping->seed;
    OTX_TRY(otx_measure_run(
        run, &mapping->mapping, mapping->exemplars, &how, &measure));
    root = json_object();
    if (!root || !otx_arena_defer(run->arena, release_json, root))
    {
        json_decref(root);
        return otx_fail_memory(run, "report");
    }
    set_int(root, "schema", OTX_REPORT_SCHEMA);
    set_text(root, "version", osdtex_version());
    set_text(root, "build", osdtex_build());
    otx_mark_print(run->mark, mark);
    if (mark[0])
        set_text(root, "mark", mark);
    put_inputs(root, mapping);
    put_options(root, context, mapping);
    put_colour(root, context, mapping);
    put_mapping(root, mapping);
    OTX_TRY(otx_tile_report_add(run, mapping, root));
    OTX_TRY(otx_field_report_add(run, mapping, root));
    put_seams(root, &measure);
    put_distortion(root, &measure);
    put_exemplars(root, mapping, &measure);
    put_cost(root, context, mapping);
    put_diagnostics(root, context);
    OTX_TRY(otx_report_handover(call, mapping, &measure, root));
    *out = root;
    return OSDTEX_OK;
}

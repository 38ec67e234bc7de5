/* method.c -- the table of methods and the driver. */
#include "method/method.h"

#include "mapping/mapping_check.h"
#include "method/scale_check.h"
#include "seam/unit.h"

#include <string.h>
#include <time.h>

extern const otx_method otx_method_hierarchical;
extern const otx_method otx_method_material;
extern const otx_method otx_method_tile;

static const otx_method *const METHODS[] = {
    &otx_method_hierarchical,
    &otx_method_material,
    &otx_method_tile,
};

int32_t
otx_method_count(void)
{
    return (int32_t)(sizeof METHODS / sizeof METHODS[0]);
}

const otx_method *
otx_method_at(int32_t index)
{
    return METHODS[index];
}

const otx_method *
otx_method_find(const char *name)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (strcmp(METHODS[i]->name, name) == 0)
            return METHODS[i];
    return NULL;
}

static double
now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void
otx_map_stats_stage(otx_map_stats *stats, const char *name)
{
    const double time = now();

    if (stats->stage_count > 0)
        stats->stages[stats->stage_count - 1].seconds += time;
    if (name && stats->stage_count < OTX_STAGE_MAX)
    {
        stats->stages[stats->stage_count].name = name;
        stats->stages[stats->stage_count++].seconds = -time;
    }
}

/* Requests that no method could answer. */
static otx_status
check(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request)
{
    if (!(request->scale > 0.0) || !isfinite(request->scale))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "the scale is %g; give the exemplar's width in scene units, a "
            "positive number",
            request->scale);
    if (request->first_face >= surface->cage->face_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map",
            (otx_where){surface->cage->path, 0, request->first_face, -1},
            "the first patch asks for face %d, and the cage has faces 0 to %d",
            (int)request->first_face, (int)surface->cage->face_count - 1);
    if (request->first_face >= 0 && surface->cage->face_hole &&
        surface->cage->face_hole[request->first_face])
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map",
            (otx_where){surface->cage->path, 0, request->first_face, -1},
            "the first patch asks for face %d, which is a hole; begin at one "
            "that is textured",
            (int)request->first_face);
    if (!(surface->area > 0.0))
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, "map",
            otx_where_file(surface->cage->path),
            "the surface has no area; there is nothing to texture");
    return otx_scale_check(run, surface, 1.0, exemplar, request->scale);
}

otx_status
otx_method_map(
    otx_run *run, const otx_method *method, const otx_surface *surface,
    const otx_exemplar *exemplar, const otx_map_request *request,
    const void *settings, otx_mapping *out, otx_map_stats *stats)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    *stats = (otx_map_stats){0};
    *out = (otx_mapping){0};
    OTX_TRY(check(run, surface, exemplar, request));
    if (request->demand && !method->mixes)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, "map", OTX_NOWHERE,
            "the method '%s' takes one exemplar; several are for the method "
            "'%s'",
            method->name, otx_method_at(0)->name);
    if (request->first_face >= 0 && !method->begins)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "map", OTX_NOWHERE,
            "the method '%s' has no first patch, and leaves it out; it is for "
            "the method '%s'",
            method->name, otx_method_at(0)->name);
    otx_map_stats_stage(stats, "prepare");
    OTX_TRY(method->map(run, surface, exemplar, request, settings, out, stats));
    otx_map_stats_stage(stats, NULL);
    otx_arena_release(run->scratch, mark);
    return otx_mapping_check(
        run, out, surface, exemplar,
        request->demand ? request->exemplar_count : 1, method->name);
}

otx_status
otx_method_fill(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const otx_method_given *given,
    otx_mapping *out, otx_map_stats *stats)
{
    const otx_method *method = NULL;
    void *settings;

    for (int32_t i = 0; i < otx_method_count() && !method; ++i)
        if (otx_method_at(i)->fill)
            method = otx_method_at(i);
    if (!method)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, "map", OTX_NOWHERE,
            "this build has no method that fills in patches");
    settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    if (!settings)
        return otx_fail_memory(run, "map");
    otx_option_defaults(method->options, method->option_count, settings);
    return method->fill(
        run, surface, exemplar, request, settings, given, out, stats);
}

/* Fewest lattice cells that a surface shows when they are laid over it as a
 * whole: on fewer, defects are everywhere. */
static const double CELLS_MIN = 60.0;

otx_status
otx_method_choose(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const otx_method **out)
{
    const double texels = otx_unit_texels(exemplar, request->scale);
    const otx_method *lattice = otx_method_find("material");
    otx_analysis a;
    double cells = 0.0;

    if (request->analysis)
        a = *request->analysis;
    else
        OTX_TRY(otx_analysis_run(
            run, &exemplar->lab, exemplar->wrap_x, exemplar->wrap_y, &a));
    if (a.kind == OTX_ANALYSIS_LATTICE)
        cells = surface->area * texels * texels /
                otx_vec2_cross(a.generators[0], a.generators[1]);
    *out = lattice && cells >= CELLS_MIN ? lattice : otx_method_at(0);
    if (a.kind == OTX_ANALYSIS_LATTICE)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
            "method %s: the exemplar is a lattice, and the surface has room "
            "for %.0f of its cells, of %.0f that are needed at least%s",
            (*out)->name, cells, CELLS_MIN,
            *out == lattice ? "; limbs under two cells that it cannot follow "
                              "get guided patches"
                            : "");
    else
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
            "method %s: the exemplar is %s, and only a lattice can run through",
            (*out)->name, otx_analysis_name(a.kind));
    return OSDTEX_OK;
}

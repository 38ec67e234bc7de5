/* tiles_call.c -- making tiled textures. */
#include "api/call.h"
#include "api/handle.h"
#include "api/method_settings.h"
#include "export/companion_files.h"
#include "export/texture_file.h"
#include "tiling/tileset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "tiles";

/* The edges of the caller as the stage takes them. */
static otx_status
choose_edges(
    otx_run *run, const osdtex_exemplar_info *info,
    const osdtex_tiles_options *options, otx_tileset_options *out)
{
    otx_tileset_edge *edges;

    if (options->edge_count < 0 || (options->edge_count > 0 && !options->edges))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no edge templates are given");
    edges = OTX_NEW(run->arena, otx_tileset_edge, options->edge_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < options->edge_count; ++i)
    {
        const osdtex_tiles_edge *e = &options->edges[i];

        /* Written so that NaN is refused, too. */
        if (!(e->x >= 0.0 && e->x <= info->width && e->y >= 0.0 &&
              e->y <= info->height && isfinite(e->angle) &&
              e->length <= hypot(info->width, info->height)))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "edge template %d leaves the picture, which is %d x %d texels: "
                "its middle is at (%g, %g), its length %g",
                i + 1, info->width, info->height, e->x, e->y, e->length);
        edges[i] = (otx_tileset_edge){{e->x, e->y}, e->angle, e->length};
    }
    out->edges = edges;
    out->edge_count = options->edge_count;
    return OSDTEX_OK;
}

static otx_status
choose_options(
    otx_run *run, const osdtex_exemplar_info *info,
    const osdtex_tiles_options *o, otx_tileset_options *out)
{
    *out = (otx_tileset_options){
        .boundaries = o->boundaries,
        .corners = o->corners,
        .cell = o->tile_size,
        .gutter = o->gutter,
        .oriented = o->oriented != 0,
        .ramp = o->ramp != 0,
        .has_corner = o->has_corner != 0,
        .corner = {o->corner_x, o->corner_y},
        .background =
            {o->background[0], o->background[1], o->background[2],
             o->background[3]},
    };
    return choose_edges(run, info, o, out);
}

static int
compare_names(const void *a, const void *b)
{
    const int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;

    return p < q ? -1 : p > q;
}

/* The names that a surface needs, ascending. */
static otx_status
choose_names(
    otx_run *run, const otx_exemplar *exemplar, const osdtex_surface *surface,
    const osdtex_tiles_options *options, otx_tileset_options *out)
{
    const otx_surface *s = &surface->surface;
    const otx_method *method = otx_method_for_tiles();
    const otx_map_request request = {
        .scale = options->scale > 0.0 ? options->scale
                                      : surface->cage->info.default_scale,
        .first_face = -1,
    };
    otx_job job = {
        .run = run,
        .surface = s,
        .exemplars = exemplar,
        .exemplar_count = 1,
        .request = &request,
    };
    otx_tile_layout layout;
    int32_t face_count, count = 0, *names;

    if (!method)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, STAGE, OTX_NOWHERE,
            "this build has no method that lays tiles, so that nothing can say "
            "which a mesh needs");
    OTX_TRY(otx_method_settings_read(
        run, method, options->settings, options->setting_count, exemplar,
        s->cage, &job.settings));
    OTX_TRY(otx_tileset_plan(run, exemplar, out, &layout));
    OTX_TRY(method->tiles(&job, &layout, &names, &face_count));
    qsort(names, (size_t)face_count, sizeof *names, compare_names);
    for (int32_t i = 0; i < face_count; ++i)
        if (names[i] >= 0 && (count == 0 || names[i] != names[count - 1]))
            names[count++] = names[i];
    if (count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, otx_where_file(s->cage->path),
            "all faces of the mesh are holes; there is nothing to texture");
    out->names = names;
    out->name_count = count;
    return OSDTEX_OK;
}

static otx_status
write_set(
    otx_run *run, const char *path, const otx_exemplar *exemplar,
    const otx_tileset *made)
{
    otx_exemplar tiles = *exemplar;
    otx_atomic_file_set *set;

    /* No other file says where the tiles are. */
    tiles.type = OTX_TEXTURE_EXR;
    OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    OTX_TRY(otx_texture_file_write(
        run, set, path, &tiles, &made->linear, &made->layout));
    /* Heights as they were: how much they are in scene units is asked for where
     * the tiles are mapped. */
    tiles.linear = made->linear;
    tiles.tiles = made->layout;
    tiles.companions = made->companions;
    tiles.companions.height_range = 1.0;
    tiles.companions.height_middle = 0.0;
    OTX_TRY(otx_companion_files_write(run, set, path, &tiles, 1.0));
    return otx_atomic_file_commit(run, set, true);
}

static otx_status
write_tiles(
    otx_run *run, const osdtex_exemplar *exemplar,
    const osdtex_surface *surface, const osdtex_tiles_options *options,
    const char *path, osdtex_tiles_info *out)
{
    osdtex_tiles_options ours = osdtex_tiles_options_default();
    otx_tileset_options how;
    otx_tileset made;

    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (!exemplar || !path || ours.setting_count < 0 ||
        (ours.setting_count > 0 && !ours.settings))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no exemplar, no path, or no settings are given");
    run->seed = ours.seed;
    OTX_TRY(choose_options(run, &exemplar->info, &ours, &how));
    if (surface)
        OTX_TRY(choose_names(run, &exemplar->exemplar, surface, &ours, &how));
    OTX_TRY(otx_tileset_make(run, &exemplar->exemplar, &how, &made));
    OTX_TRY(write_set(run, path, &exemplar->exemplar, &made));
    if (out)
        *out = (osdtex_tiles_info){
            .tile_count = made.tile_count,
            .tile_size = made.layout.cell,
            .width = made.linear.width,
            .height = made.linear.height,
            .corner_cut = made.corner_seam,
            .edge_cut = made.strip_seam,
            .inner_cut = made.inner_seam,
            .random_pair = made.random_pair,
            .vertex_window = made.layout.figures.vertex_window,
            .inner_window = made.layout.figures.inner_window,
        };
    return OSDTEX_OK;
}

osdtex_status
osdtex_tiles_write(
    osdtex_context *context, const osdtex_exemplar *exemplar,
    const osdtex_surface *surface, const osdtex_tiles_options *options,
    const char *path, osdtex_tiles_info *out)
{
    otx_call call;

    if (out)
        *out = (osdtex_tiles_info){0};
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(
        &call, write_tiles(&call.run, exemplar, surface, options, path, out));
}

/* saved_mapping.c -- mappings read back from files. */
#include "api/call.h"
#include "api/exemplar_handle.h"
#include "api/heal_call.h"
#include "api/map_input.h"
#include "api/mapping_info.h"
#include "api/method_settings.h"
#include "api/place_call.h"
#include "api/saved_about.h"
#include "api/saved_decals.h"
#include "api/saved_field.h"
#include "api/saved_lookups.h"
#include "file/tensors.h"
#include "mapping/mapping_check.h"
#include "method/scale_check.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char STAGE[] = "mapping";

/* A file being read. The handles of what it names are held by the mapping and
 * dropped here. */
typedef struct loader
{
    otx_call *call;
    const char *path;
    osdtex_mapping_read_options options;
    otx_tensors *tensors;
    otx_saved_about about;
    osdtex_mapping *mapping;
    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_exemplar *exemplars[OTX_EXEMPLARS_MAX];
} loader;

static otx_status
damaged(const loader *l, const char *what)
{
    return otx_fail(
        &l->call->run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(l->path),
        "the saved mapping is damaged: %s", what);
}

/* A file that the mapping at `path` names: where it says, else beside the
 * mapping. */
static otx_status
find_file(otx_run *run, const char *path, const char *named, const char **out)
{
    const char *slash = strrchr(path, '/'), *last = strrchr(named, '/');
    const int folder = slash ? (int)(slash + 1 - path) : 0;
    char beside[PATH_MAX];

    *out = named;
    if (access(named, F_OK) == 0)
        return OSDTEX_OK;
    for (int i = 0; i < 2; ++i)
    {
        const char *name = i == 0 || !last ? named : last + 1;

        if (snprintf(beside, sizeof beside, "%.*s%s", folder, path, name) <
                (int)sizeof beside &&
            access(beside, F_OK) == 0)
        {
            *out = otx_arena_strdup(run->arena, beside);
            return otx_run_ok(run);
        }
    }
    return OSDTEX_OK;
}

/* Rest positions may differ: UVs go with the faces, and the mapping remembers
 * what it was made for. */
static otx_status
compare_points(const loader *l)
{
    const otx_cage *cage = &l->cage->cage;
    const size_t count = 3 * (size_t)cage->vert_count;
    const otx_tensor *points = otx_tensors_find(
        l->tensors, "cage_points", OTX_TENSOR_F32, cage->vert_count, 3);
    const otx_tensor *origin =
        otx_tensors_find(l->tensors, "cage_origin", OTX_TENSOR_F64, 3, 0);
    const float *from = points ? points->data : NULL;
    float *made_for;

    if (!from || memcmp(from, cage->points, count * sizeof *from) == 0)
        return OSDTEX_OK;
    made_for = OTX_NEW(l->call->run.arena, float, count);
    OTX_TRY(otx_run_ok(&l->call->run));
    for (size_t i = 0; i < count; ++i)
    {
        const double *shift = origin ? origin->data : cage->origin;

        if (!isfinite(from[i]))
            return damaged(l, "a point of its cage is not finite");
        made_for[i] =
            (float)((double)from[i] + shift[i % 3] - cage->origin[i % 3]);
    }
    l->mapping->made_for = made_for;
    otx_note(
        &l->call->run, OSDTEX_SEVERITY_INFO, STAGE,
        otx_where_file(l->cage->info.path),
        "the cage has the faces that were mapped in another pose; the texture "
        "goes with them");
    return OSDTEX_OK;
}

/* A pipe that a file names is waited for in vain. */
static bool
is_no_file(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 && !S_ISREG(info.st_mode);
}

/* Asked before a level is refined that the arrays are not of. */
static otx_status
check_level(const loader *l)
{
    const otx_cage *cage = &l->cage->cage;
    const otx_tensor *faces =
        otx_tensors_find(l->tensors, "face_patch", OTX_TENSOR_I32, -1, 0);

    return faces && (double)faces->rows ==
                        otx_surface_face_count(cage, l->about.level)
               ? OSDTEX_OK
               : damaged(l, "its arrays do not fit the cage at its level");
}

/* As find_file; of what is to be read.
 *
 *   what  "cage" */
static otx_status
find_named(
    const loader *l, const char *what, const char *named, const char **out)
{
    char sentence[80];

    OTX_TRY(find_file(&l->call->run, l->path, named, out));
    if (!is_no_file(*out))
        return OSDTEX_OK;
    snprintf(
        sentence, sizeof sentence, "its %s is a folder, a pipe or a device",
        what);
    return damaged(l, sentence);
}

/* Reads a cage, and says whether its faces are those that were mapped. */
static otx_status
read_cage_file(loader *l, const char *path, bool *fits)
{
    const char *topology;

    OTX_TRY(osdtex_cage_read(l->call->context, path, &l->about.cage, &l->cage));
    OTX_TRY(otx_saved_topology(&l->call->run, &l->cage->cage, &topology));
    *fits = strcmp(topology, l->about.topology) == 0;
    return OSDTEX_OK;
}

/* The cage that the mapping names. */
static otx_status
read_own_cage(loader *l, const char **path, bool *fits)
{
    OTX_TRY(find_named(l, "cage", l->about.cage_path, path));
    return read_cage_file(l, *path, fits);
}

/* The cage that is asked for, or else the mapping's own. */
static otx_status
find_cage(loader *l)
{
    const char *path = l->options.cage;
    bool fits = false;

    if (path)
        OTX_TRY(read_cage_file(l, path, &fits));
    if (!fits && path && l->options.other_faces)
    {
        osdtex_cage_destroy(l->cage);
        l->cage = NULL;
        path = NULL;
    }
    if (!path)
        OTX_TRY(read_own_cage(l, &path, &fits));
    if (fits)
        return OSDTEX_OK;
    return otx_fail(
        &l->call->run, OSDTEX_ERROR_ARGUMENT, STAGE, otx_where_file(path),
        "the cage has other faces than the one that was mapped; map it "
        "anew, or give the one that the mapping was made for");
}

static otx_status
read_cage(loader *l)
{
    osdtex_context *context = l->call->context;
    osdtex_surface_options level = osdtex_surface_options_default();

    OTX_TRY(find_cage(l));
    OTX_TRY(compare_points(l));
    OTX_TRY(check_level(l));
    level.level = l->about.level;
    return osdtex_surface_refine(context, l->cage, &level, &l->surface);
}

static otx_status
check_texels(const loader *l, const otx_exemplar_cuts *cuts)
{
    const int64_t count = (int64_t)cuts->width * cuts->height;

    for (int64_t i = 0; i < count; ++i)
        if (cuts->texels[i] < 0 || cuts->texels[i] >= count)
            return damaged(l, "an exemplar's texels are out of range");
    return OSDTEX_OK;
}

/* The maps that are asked for, else those of the material; another picture has
 * none of these. */
static otx_status
choose_maps(loader *l, int32_t k, bool swapped)
{
    otx_saved_exemplar *s = &l->about.exemplars[k];

    if (k == 0 && l->options.map_count > 0)
    {
        s->options.maps = l->options.maps;
        s->options.map_count = l->options.map_count;
        s->options.height_range = l->options.height_range;
        s->options.height_middle = l->options.height_middle;
        return OSDTEX_OK;
    }
    if (swapped)
        s->options.map_count = 0;
    s->options.maps = s->maps;
    for (int32_t i = 0; i < s->options.map_count; ++i)
        OTX_TRY(find_named(l, "map", s->maps[i].path, &s->maps[i].path));
    return OSDTEX_OK;
}

static otx_status
read_exemplar(loader *l, int32_t k)
{
    otx_saved_exemplar *s = &l->about.exemplars[k];
    const char *path = l->options.exemplars[k];
    const bool swapped = path != NULL;
    const otx_tensor *texels;
    char name[OTX_TENSOR_NAME_BYTES];

    if (!path)
        OTX_TRY(find_named(l, "exemplar", s->path, &path));
    snprintf(name, sizeof name, "exemplar_texels_%d", (int)k);
    texels = otx_tensors_find(
        l->tensors, name, OTX_TENSOR_I32,
        (int64_t)s->cuts.width * s->cuts.height, 0);
    if (s->rearranged && !texels)
        return damaged(l, "an exemplar's texels are missing");
    s->cuts.texels = s->rearranged ? texels->data : NULL;
    if (s->rearranged)
        OTX_TRY(check_texels(l, &s->cuts));
    s->options.tileable = OSDTEX_TILEABLE_KEEP;
    s->options.normals_y_down = k == 0 && l->options.normals_y_down;
    /* Another picture says itself what its colours are. */
    if (swapped)
        s->options.from = l->options.from;
    if (l->options.to || l->options.receiver != OSDTEX_RECEIVER_ANY)
    {
        s->options.to = l->options.to;
        s->options.receiver = l->options.receiver;
    }
    s->options.texture_type = l->options.texture_type;
    /* Integers have a space of their own. */
    if (l->options.texture_type > OSDTEX_TEXTURE_EXR && !l->options.to)
        s->options.to = NULL;
    OTX_TRY(choose_maps(l, k, swapped));
    OTX_TRY(otx_exemplar_handle_read(
        l->call->context, path, &s->options, &s->cuts,
        l->options.without_figures != 0 && l->options.heal == 0.0,
        &l->exemplars[k]));
    if (!swapped && s->hash && l->exemplars[k]->exemplar.source_hash &&
        strcmp(s->hash, l->exemplars[k]->exemplar.source_hash) != 0)
        otx_note(
            &l->call->run, OSDTEX_SEVERITY_WARNING, STAGE, otx_where_file(path),
            "the picture has changed since the mapping was saved; the mapping "
            "is applied to what it is now");
    l->exemplars[k]->exemplar.wrap_x = s->wrap_x;
    l->exemplars[k]->exemplar.wrap_y = s->wrap_y;
    return OSDTEX_OK;
}

/* What the mapping is measured by: compared at as many texels to a unit. */
static otx_status
list_exemplars(const loader *l)
{
    otx_run *run = &l->call->run;
    osdtex_mapping *m = l->mapping;
    otx_exemplar *list = OTX_NEW(run->arena, otx_exemplar, OTX_EXEMPLARS_MAX);

    OTX_TRY(otx_run_ok(run));
    m->exemplars = list;
    m->source_count = l->about.exemplar_count;
    m->exemplar = l->exemplars[0];
    for (int32_t k = 0; k < m->source_count; ++k)
    {
        const otx_saved_exemplar *s = &l->about.exemplars[k];
        const otx_exemplar *from = &l->exemplars[k]->exemplar;

        m->sources[k] = l->exemplars[k];
        OTX_TRY(otx_call_hold(run, l->exemplars[k]->arena));
        list[k] = *from;
        if (from->match.width != s->match_width ||
            from->match.height != s->match_height)
            OTX_TRY(otx_exemplar_resize(
                run, from, s->match_width, s->match_height, &list[k]));
    }
    return OSDTEX_OK;
}

static const void *
need(
    const loader *l, const char *name, otx_tensor_type type, int64_t rows,
    int64_t columns)
{
    const otx_tensor *t =
        otx_tensors_find(l->tensors, name, type, rows, columns);

    return t ? t->data : NULL;
}

/* Faces that show more than their own UVs. */
static otx_status
join_shown(const loader *l, otx_mapping *out)
{
    otx_vec2 unit[OTX_EXEMPLARS_MAX];
    const char *what;

    OTX_TRY(otx_saved_lookups_join(
        &l->call->run, l->tensors, (otx_layering)l->about.layering,
        l->about.exemplar_count, out, &what));
    if (what)
        return damaged(l, what);
    for (int32_t k = 0; k < l->about.exemplar_count; ++k)
        unit[k] = (otx_vec2){
            1.0 / l->about.exemplars[k].match_width,
            1.0 / l->about.exemplars[k].match_height};
    OTX_TRY(otx_saved_field_join(
        &l->call->run, l->tensors, unit, l->about.exemplar_count, out, &what));
    return what ? damaged(l, what) : OSDTEX_OK;
}

/* Whether numbers can be drawn, and solved with; NULL can. */
static bool
are_finite(const void *doubles, int64_t count)
{
    const double *values = doubles;

    for (int64_t i = 0; values && i < count; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* What is shown and gone on from by edits, and may be missing. */
static otx_status
join_fields(const loader *l, const otx_level *leaf, otx_mapping *out)
{
    otx_run *run = &l->call->run;
    otx_guide *guide = OTX_ZNEW(run->arena, otx_guide, 1);
    otx_cell_map *cells = OTX_ZNEW(run->arena, otx_cell_map, 1);

    OTX_TRY(otx_run_ok(run));
    *guide = (otx_guide){
        need(l, "guide", OTX_TENSOR_F64, leaf->face_count, 3),
        l->about.guide_symmetry, l->about.guide_angle};
    *cells = (otx_cell_map){
        need(l, "cells", OTX_TENSOR_F64, leaf->corner_count, 2),
        need(l, "cells_open", OTX_TENSOR_U8, leaf->face_count, 0),
        need(l, "defects", OTX_TENSOR_F64, l->about.defect_count, 3),
        l->about.defect_count};
    if (!are_finite(guide->directions, 3 * (int64_t)leaf->face_count) ||
        !are_finite(cells->cells, 2 * (int64_t)leaf->corner_count) ||
        !are_finite(cells->defects, 3 * (int64_t)l->about.defect_count))
        return damaged(l, "a direction or a cell is not finite");
    if (guide->directions && guide->symmetry > 0)
        out->guide = guide;
    if (cells->cells && cells->open && cells->defects)
        out->lattice = cells;
    return OSDTEX_OK;
}

/* The surface with the density that the texture has, if it has one. */
static otx_status
join_density(const loader *l, const otx_level *leaf, otx_mapping *out)
{
    const float *density =
        need(l, "density", OTX_TENSOR_F32, leaf->vert_count, 0);
    otx_surface *surface;

    if (!density)
        return OSDTEX_OK;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        /* Written so that NaN is damaged too. */
        if (!(density[v] > 0.0f && density[v] < HUGE_VALF))
            return damaged(l, "a density is not a positive number");
    surface = OTX_NEW(l->call->run.arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(&l->call->run));
    *surface = *out->surface;
    surface->density = density;
    out->surface = surface;
    return OSDTEX_OK;
}

static otx_status
join_arrays(const loader *l, otx_mapping *out)
{
    const otx_level *leaf = otx_surface_leaf(&l->surface->surface);
    otx_run *run = &l->call->run;
    const float *uvs = need(l, "uvs", OTX_TENSOR_F32, leaf->corner_count, 2);
    const int32_t *patch =
        need(l, "face_patch", OTX_TENSOR_I32, leaf->face_count, 0);

    if (!uvs || !patch)
        return damaged(l, "its arrays do not fit the cage");
    *out = (otx_mapping){
        .surface = &l->surface->surface,
        .scale = l->about.scale,
        .uvs = OTX_NEW(run->arena, float, 2 * (size_t)leaf->corner_count),
        .face_patch = OTX_NEW(run->arena, int32_t, leaf->face_count),
        .patch_count = l->about.patch_count,
        .exemplar_count = l->about.exemplar_count,
        .patch_exemplar =
            need(l, "patch_exemplar", OTX_TENSOR_U8, l->about.patch_count, 0),
        .along = need(l, "along", OTX_TENSOR_F32, leaf->vert_count, 0),
    };
    OTX_TRY(otx_run_ok(run));
    memcpy(out->uvs, uvs, 2 * sizeof *uvs * (size_t)leaf->corner_count);
    memcpy(out->face_patch, patch, sizeof *patch * (size_t)leaf->face_count);
    if (l->about.exemplar_count > 1 && !out->patch_exemplar)
        return damaged(l, "it does not say which exemplar its patches show");
    OTX_TRY(join_shown(l, out));
    OTX_TRY(join_density(l, leaf, out));
    return join_fields(l, leaf, out);
}

/* The pictures of the decals that were saved, as textures. */
static otx_status
read_pictures(const loader *l, otx_decals *decals)
{
    otx_run *run = &l->call->run;
    const int32_t count = l->about.picture_count;
    otx_place_picture *list = OTX_NEW(run->scratch, otx_place_picture, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
    {
        list[k].from = l->about.pictures[k].from;
        OTX_TRY(find_named(
            l, "placed picture", l->about.pictures[k].path, &list[k].path));
    }
    return otx_place_call_pictures(
        l->call, list, count, l->mapping->exemplars,
        l->options.without_figures != 0, decals);
}

/* What is asked for, else what was saved. */
static otx_status
place(const loader *l)
{
    otx_run *run = &l->call->run;
    otx_decals *decals;
    const char *what;

    if (l->options.place)
        return otx_place_call(l->call, l->options.place, l->mapping);
    OTX_TRY(otx_saved_decals_join(
        run, l->tensors, otx_surface_leaf(&l->surface->surface),
        l->about.picture_count, &decals, &what));
    if (what)
        return damaged(l, what);
    l->mapping->mapping.decals = decals;
    return decals ? read_pictures(l, decals) : OSDTEX_OK;
}

static otx_status
join(const loader *l)
{
    otx_run *run = &l->call->run;
    osdtex_mapping *m = l->mapping;

    m->method = otx_method_find(l->about.method);
    if (!m->method)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, STAGE, otx_where_file(l->path),
            "the mapping was made by the method '%.60s', which this version "
            "does not have",
            l->about.method);
    m->arena = run->arena;
    m->surface = l->surface;
    m->seed = l->about.seed;
    m->request.scale = l->about.scale;
    m->request.first_face = -1;
    if (l->about.constraints)
        OTX_TRY(otx_map_input_parse(
            run, l->path, l->about.constraints, &m->request.constraints));
    m->saved_path = otx_arena_strdup(run->arena, l->path);
    OTX_TRY(otx_call_hold(run, l->surface->arena));
    OTX_TRY(list_exemplars(l));
    OTX_TRY(otx_scale_check(
        run, &l->surface->surface, 1.0, &m->exemplars[0], l->about.scale));
    OTX_TRY(otx_method_settings_read(
        run, m->method, l->about.settings, l->about.setting_count,
        &m->exemplar->exemplar, &l->cage->cage, &m->settings));
    OTX_TRY(join_arrays(l, &m->mapping));
    OTX_TRY(otx_mapping_check_file(
        run, &m->mapping, &l->surface->surface, m->exemplars, m->source_count,
        l->path));
    run->seed = m->seed;
    OTX_TRY(otx_heal_call(run, l->options.heal, m));
    OTX_TRY(place(l));
    m->info = otx_mapping_info_of(m);
    return OSDTEX_OK;
}

static otx_status
load(loader *l)
{
    otx_run *run = &l->call->run;

    l->tensors = OTX_ZNEW(run->arena, otx_tensors, 1);
    l->mapping = OTX_ZNEW(run->arena, osdtex_mapping, 1);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_tensors_read(run, l->path, l->tensors));
    OTX_TRY(otx_saved_about_parse(run, l->path, l->tensors->about, &l->about));
    OTX_TRY(read_cage(l));
    for (int32_t k = 0; k < l->about.exemplar_count; ++k)
        OTX_TRY(read_exemplar(l, k));
    return join(l);
}

static otx_status
read_mapping(
    otx_call *call, const char *path,
    const osdtex_mapping_read_options *options, osdtex_mapping **out)
{
    loader *l = OTX_ZNEW(call->run.scratch, loader, 1);
    otx_status status;

    OTX_TRY(otx_run_ok(&call->run));
    if (!path)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no path of a saved mapping is given");
    l->call = call;
    l->path = path;
    l->options = osdtex_mapping_read_options_default();
    OTX_TRY(
        otx_call_options(&call->run, &l->options, sizeof l->options, options));
    status = load(l);
    for (int32_t k = 0; k < OTX_EXEMPLARS_MAX; ++k)
        osdtex_exemplar_destroy(l->exemplars[k]);
    osdtex_surface_destroy(l->surface);
    osdtex_cage_destroy(l->cage);
    if (status == OSDTEX_OK)
        *out = l->mapping;
    return status;
}

osdtex_status
osdtex_mapping_read(
    osdtex_context *context, const char *path,
    const osdtex_mapping_read_options *options, osdtex_mapping **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, read_mapping(&call, path, options, out), out);
}

/* What a saved mapping says of itself, as text and taken apart; both live in
 * the scratch arena. */
static otx_status
read_about(
    otx_run *run, const char *path, const char **text, otx_saved_about **out)
{
    otx_tensors *tensors = OTX_ZNEW(run->scratch, otx_tensors, 1);

    *out = OTX_ZNEW(run->scratch, otx_saved_about, 1);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_tensors_read(run, path, tensors));
    *text = tensors->about;
    return otx_saved_about_parse(run, path, tensors->about, *out);
}

static otx_status
check_visit(otx_run *run, bool given)
{
    return given ? OSDTEX_OK
                 : otx_fail(
                       run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                       "no path or nobody to tell is given");
}

static otx_status
inspect(
    otx_run *run, const char *path,
    void (*visit)(void *user, const char *about), void *user)
{
    otx_saved_about *about;
    const char *text;

    OTX_TRY(check_visit(run, path && visit));
    OTX_TRY(read_about(run, path, &text, &about));
    visit(user, text);
    return OSDTEX_OK;
}

osdtex_status
osdtex_mapping_inspect(
    osdtex_context *context, const char *path,
    void (*visit)(void *user, const char *about), void *user)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, inspect(&call.run, path, visit, user));
}

static otx_status
list_files(
    otx_run *run, const char *path,
    void (*visit)(void *user, osdtex_saved_file file, const char *path),
    void *user)
{
    otx_saved_about *about;
    const char *text, *found;

    OTX_TRY(check_visit(run, path && visit));
    OTX_TRY(read_about(run, path, &text, &about));
    OTX_TRY(find_file(run, path, about->cage_path, &found));
    visit(user, OSDTEX_SAVED_CAGE, found);
    for (int32_t k = 0; k < about->exemplar_count; ++k)
    {
        OTX_TRY(find_file(run, path, about->exemplars[k].path, &found));
        visit(user, OSDTEX_SAVED_EXEMPLAR, found);
    }
    for (int32_t k = 0; k < about->picture_count; ++k)
    {
        OTX_TRY(find_file(run, path, about->pictures[k].path, &found));
        visit(user, OSDTEX_SAVED_PICTURE, found);
    }
    for (int32_t k = 0; k < about->exemplar_count; ++k)
        for (int32_t i = 0; i < about->exemplars[k].options.map_count; ++i)
        {
            OTX_TRY(
                find_file(run, path, about->exemplars[k].maps[i].path, &found));
            visit(user, OSDTEX_SAVED_MAP, found);
        }
    return OSDTEX_OK;
}

osdtex_status
osdtex_mapping_files(
    osdtex_context *context, const char *path,
    void (*visit)(void *user, osdtex_saved_file file, const char *path),
    void *user)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, list_files(&call.run, path, visit, user));
}

/* cage.c -- from a reader's arrays to a validated cage.
 *
 * Temporaries of all checks lie in the run's scratch arena; the cage copies
 * what it keeps, so that the file's bytes can be dropped. */
#include "surface/cage.h"

#include "math/vec.h"
#include "surface/cage_check.h"
#include "surface/cage_mend.h"
#include "surface/cage_tags.h"
#include "surface/topology.h"

#include <math.h>
#include <string.h>

#define STAGE "cage"

/* A smaller cage has no size to speak of in float. */
static const double diagonal_min = 1e-15;

/* One of the rules that both the user and the file may choose. */
typedef struct rule
{
    const char *name;
    int32_t user, file, count, fallback;
} rule;

static otx_status
choose(otx_run *run, const otx_cage_input *in, rule r, int32_t *out)
{
    otx_where where = OTX_NOWHERE;

    where.file = in->path;
    if (r.user < OTX_CAGE_UNSET || r.user >= r.count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "%s %d does not exist; it goes from 0 to %d", r.name, r.user,
            r.count - 1);
    *out = r.user != OTX_CAGE_UNSET ? r.user : r.file;
    if (*out >= OTX_CAGE_UNSET && *out < r.count)
    {
        *out = *out == OTX_CAGE_UNSET ? r.fallback : *out;
        return OSDTEX_OK;
    }
    otx_note(
        run, OSDTEX_SEVERITY_WARNING, STAGE, where,
        "the file's %s %d does not exist, so %d is used", r.name, r.file,
        r.fallback);
    *out = r.fallback;
    return OSDTEX_OK;
}

/* The user's choice, else the file's tag, else USD's default. */
static otx_status
choose_rules(
    otx_run *run, const otx_cage_input *in, const otx_cage_options *options,
    otx_cage *cage)
{
    int32_t boundary = 0, fvar = 0, chaikin = 0, smooth = 0;

    OTX_TRY(choose(
        run, in,
        (rule){
            "boundary rule", options->boundary, in->boundary,
            OTX_BOUNDARY_EDGE_AND_CORNER + 1, OTX_BOUNDARY_EDGE_AND_CORNER},
        &boundary));
    OTX_TRY(choose(
        run, in,
        (rule){
            "face-varying rule", options->fvar, in->fvar, OTX_FVAR_ALL + 1,
            OTX_FVAR_CORNERS_PLUS1},
        &fvar));
    OTX_TRY(choose(
        run, in,
        (rule){
            "crease method", options->crease_chaikin, in->crease_chaikin, 2, 0},
        &chaikin));
    OTX_TRY(choose(
        run, in,
        (rule){
            "triangle rule", options->triangles_smooth, in->triangles_smooth, 2,
            0},
        &smooth));
    cage->scheme = options->scheme;
    cage->boundary = (otx_boundary)boundary;
    cage->fvar = (otx_fvar)fvar;
    cage->crease_chaikin = chaikin != 0;
    cage->triangles_smooth = smooth != 0;
    return OSDTEX_OK;
}

/* NULL when memory is out. */
static void *
copy(otx_arena *arena, const void *from, size_t count, size_t size)
{
    void *to = otx_arena_alloc(arena, count, size);

    if (to && count > 0)
        memcpy(to, from, count * size);
    return to;
}

static bool
finite_floats(const float *values, size_t count)
{
    for (size_t i = 0; i < count; ++i)
    {
        if (!isfinite(values[i]))
            return false;
    }
    return true;
}

static otx_status
copy_colors(otx_run *run, const otx_cage_input *in, otx_cage *cage)
{
    const size_t count = 3 * (size_t)in->vert_count;
    otx_where where = OTX_NOWHERE;

    where.file = in->path;
    if (!in->colors)
        return OSDTEX_OK;
    if (!finite_floats(in->colors, count))
    {
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "a vertex colour is not a finite number, so the colours are left "
            "out");
        return OSDTEX_OK;
    }
    cage->colors = copy(run->arena, in->colors, count, sizeof *in->colors);
    return otx_run_ok(run);
}

static otx_status
copy_point_lines(otx_run *run, const otx_cage_input *in, otx_cage *cage)
{
    if (!in->point_lines)
        return OSDTEX_OK;
    cage->point_line_bytes = in->point_line_bytes;
    cage->point_lines =
        copy(run->arena, in->point_lines, in->point_line_bytes, 1);
    return otx_run_ok(run);
}

static otx_status
copy_mesh(otx_run *run, const otx_cage_input *in, bool uvs, otx_cage *cage)
{
    const size_t faces = (size_t)in->face_count;
    const size_t corners = (size_t)in->face_first[faces];
    otx_arena *arena = run->arena;

    cage->vert_count = in->vert_count;
    memcpy(cage->origin, in->origin, sizeof cage->origin);
    cage->face_count = in->face_count;
    cage->corner_count = (int32_t)corners;
    cage->points =
        copy(arena, in->points, 3 * (size_t)in->vert_count, sizeof *in->points);
    cage->face_first =
        copy(arena, in->face_first, faces + 1, sizeof *in->face_first);
    cage->face_verts =
        copy(arena, in->face_verts, corners, sizeof *in->face_verts);
    OTX_TRY(otx_run_ok(run));
    if (uvs)
    {
        cage->uv_count = in->uv_count;
        cage->uvs =
            copy(arena, in->uvs, 2 * (size_t)in->uv_count, sizeof *in->uvs);
        cage->face_uvs =
            copy(arena, in->face_uvs, corners, sizeof *in->face_uvs);
        OTX_TRY(otx_run_ok(run));
    }
    if (in->face_line)
    {
        cage->face_line =
            copy(arena, in->face_line, faces, sizeof *in->face_line);
        OTX_TRY(otx_run_ok(run));
    }
    return copy_colors(run, in, cage);
}

/* NULL when memory is out. */
static const char *const *
copy_names(otx_arena *arena, const char *const *names, int32_t count)
{
    const char **to = OTX_NEW(arena, const char *, count);

    for (int32_t i = 0; to && i < count; ++i)
    {
        to[i] = otx_arena_strdup(arena, names[i]);
        if (!to[i])
            return NULL;
    }
    return to;
}

/* Indices into a table of `count` names; what lies outside becomes -1. */
static const int32_t *
copy_labels(
    otx_arena *arena, const int32_t *labels, int32_t face_count, int32_t count)
{
    int32_t *to = OTX_NEW(arena, int32_t, face_count);

    for (int32_t f = 0; to && f < face_count; ++f)
    {
        const int32_t label = labels ? labels[f] : -1;

        to[f] = label >= 0 && label < count ? label : -1;
    }
    return to;
}

static otx_status
copy_carried(otx_run *run, const otx_cage_input *in, otx_cage *c)
{
    otx_arena *arena = run->arena;
    const int32_t faces = in->face_count;

    c->group_count = in->group_count;
    c->object_count = in->object_count;
    c->material_count = in->material_count;
    c->smooth_count = in->smooth_count;
    c->library_count = in->library_count;
    c->group_names = copy_names(arena, in->group_names, in->group_count);
    c->object_names = copy_names(arena, in->object_names, in->object_count);
    c->material_names =
        copy_names(arena, in->material_names, in->material_count);
    c->smooth_names = copy_names(arena, in->smooth_names, in->smooth_count);
    c->library_names = copy_names(arena, in->library_names, in->library_count);
    c->face_group = copy_labels(arena, in->face_group, faces, c->group_count);
    c->face_object =
        copy_labels(arena, in->face_object, faces, c->object_count);
    c->face_material =
        copy_labels(arena, in->face_material, faces, c->material_count);
    c->face_smooth =
        copy_labels(arena, in->face_smooth, faces, c->smooth_count);
    c->path = in->path ? otx_arena_strdup(arena, in->path) : NULL;
    OTX_TRY(otx_run_ok(run));
    return OSDTEX_OK;
}

/* Diagonal of the box around the vertices that faces use. */
static double
box_diagonal(const otx_cage *cage)
{
    float low[3] = {INFINITY, INFINITY, INFINITY};
    float high[3] = {-INFINITY, -INFINITY, -INFINITY};

    for (int32_t i = 0; i < cage->corner_count; ++i)
    {
        const float *p = cage->points + 3 * (size_t)cage->face_verts[i];

        for (int32_t k = 0; k < 3; ++k)
        {
            low[k] = fminf(low[k], p[k]);
            high[k] = fmaxf(high[k], p[k]);
        }
    }
    return otx_vec3_length((otx_vec3){
        (double)high[0] - low[0], (double)high[1] - low[1],
        (double)high[2] - low[2]});
}

static otx_status
measure(otx_run *run, const otx_topology *t, otx_cage *cage)
{
    otx_where where = OTX_NOWHERE;
    double length = 0.0;

    where.file = cage->path;
    cage->diagonal = box_diagonal(cage);
    if (!(cage->diagonal > diagonal_min))
        return otx_fail(
            run, OSDTEX_ERROR_NUMERIC, STAGE, where,
            "all vertices lie at one point, so there is no surface; check the "
            "export's scale");
    for (int32_t e = 0; e < t->edge_count; ++e)
        length += otx_vec3_length(otx_vec3_sub(
            otx_vec3_load(cage->points, t->edge_verts[2 * (size_t)e]),
            otx_vec3_load(cage->points, t->edge_verts[2 * (size_t)e + 1])));
    cage->edge_count = t->edge_count;
    cage->mean_edge_length = length / t->edge_count;
    return OSDTEX_OK;
}

static void
advise_scheme(otx_run *run, const otx_cage *cage)
{
    otx_where where = OTX_NOWHERE;

    where.file = cage->path;
    if (cage->scheme != OTX_SCHEME_CATMARK)
        return;
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        if (cage->face_first[f + 1] - cage->face_first[f] != 3)
            return;
    }
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, where,
        "all faces are triangles; {scheme} loop would give a smoother surface, "
        "{scheme} none leave them as they are");
}

static otx_status
build(
    otx_run *run, const otx_cage_input *given, const otx_cage_options *options,
    otx_cage *cage)
{
    otx_cage_input mended = *given;
    const otx_cage_input *in = &mended;
    otx_topology topology;
    bool uvs;

    OTX_TRY(choose_rules(run, in, options, cage));
    OTX_TRY(otx_cage_check_faces(run, in, options->scheme));
    OTX_TRY(otx_cage_check_points(run, in));
    OTX_TRY(otx_cage_check_uvs(run, in, &uvs));
    if (options->weld >= 0.0)
    {
        OTX_TRY(otx_cage_weld(run, options->weld, &mended));
        OTX_TRY(otx_cage_check_faces(run, in, options->scheme));
    }
    if (!otx_topology_build(
            run->scratch, in->vert_count, in->face_count, in->face_first,
            in->face_verts, &topology))
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_cage_check_manifold(
        run, in, &topology, options->scheme, &cage->split_count));
    if (options->weld < 0.0)
        OTX_TRY(otx_cage_note_gaps(run, in, &topology));
    if (uvs && options->scheme != OTX_SCHEME_NONE)
        OTX_TRY(otx_cage_split_folds(run, &topology, &mended));
    OTX_TRY(copy_mesh(run, in, uvs, cage));
    OTX_TRY(copy_point_lines(run, in, cage));
    OTX_TRY(copy_carried(run, in, cage));
    OTX_TRY(otx_cage_tags_read(run, in, &topology, cage));
    OTX_TRY(measure(run, &topology, cage));
    otx_cage_check_areas(run, in);
    advise_scheme(run, cage);
    return OSDTEX_OK;
}

otx_status
otx_cage_build(
    otx_run *run, const otx_cage_input *input, const otx_cage_options *options,
    otx_cage *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_cage cage = {0};
    otx_status status;

    status = build(run, input, options, &cage);
    otx_arena_release(run->scratch, mark);
    *out = status == OSDTEX_OK ? cage : (otx_cage){0};
    return status;
}

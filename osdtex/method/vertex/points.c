/* points.c -- the hierarchy of points, and operators on it [Turk01, sec. 3].
 */
#include "method/vertex/turk.h"

#include "base/csr.h"

#include <string.h>

#define VERTICES_MOST 8e6 /* of the finest mesh */

static const char STAGE[] = "map";

/* ---- meshes ---- */

static otx_status
list_faces(otx_run *run, otx_turk_mesh *mesh)
{
    const otx_level *level = mesh->level;

    mesh->face_first =
        OTX_ZNEW(run->scratch, int32_t, (int64_t)mesh->count + 2);
    mesh->faces = OTX_NEW(run->scratch, int32_t, level->corner_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t i = level->face_first[f]; i < level->face_first[f + 1];
             ++i)
            if (!level->face_hole[f])
                otx_csr_count(mesh->face_first, level->face_verts[i], 1);
    otx_csr_sum(mesh->face_first, mesh->count);
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t i = level->face_first[f]; i < level->face_first[f + 1];
             ++i)
            if (!level->face_hole[f])
                mesh->faces[otx_csr_place(
                    mesh->face_first, level->face_verts[i])] = f;
    return OSDTEX_OK;
}

static double
edge_length(const float *points, const int32_t *verts)
{
    return otx_vec3_length(otx_vec3_sub(
        otx_vec3_load(points, verts[0]), otx_vec3_load(points, verts[1])));
}

static void
normalise(otx_turk_mesh *mesh)
{
    for (int32_t v = 0; v < mesh->count; ++v)
    {
        float sum = 0.0f;

        for (int32_t i = mesh->near_first[v]; i < mesh->near_first[v + 1]; ++i)
            sum += mesh->near_weights[i];
        for (int32_t i = mesh->near_first[v]; i < mesh->near_first[v + 1]; ++i)
            mesh->near_weights[i] /= sum;
    }
}

static otx_status
list_neighbours(otx_run *run, const float *points, otx_turk_mesh *mesh)
{
    const otx_level *level = mesh->level;
    const int64_t ends = 2 * (int64_t)level->edge_count;

    mesh->near_first =
        OTX_ZNEW(run->scratch, int32_t, (int64_t)mesh->count + 2);
    mesh->near = OTX_NEW(run->scratch, int32_t, ends);
    mesh->near_weights = OTX_NEW(run->scratch, float, ends);
    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < ends; ++i)
        otx_csr_count(mesh->near_first, level->edge_verts[i], 1);
    otx_csr_sum(mesh->near_first, mesh->count);
    for (int64_t i = 0; i < ends; ++i)
    {
        const double length =
            edge_length(points, level->edge_verts + (i & ~(int64_t)1));
        const int32_t at =
            otx_csr_place(mesh->near_first, level->edge_verts[i]);

        mesh->near[at] = level->edge_verts[i ^ 1];
        mesh->near_weights[at] = (float)(1.0 / fmax(length, 1e-30));
    }
    normalise(mesh);
    return OSDTEX_OK;
}

static otx_status
build_meshes(otx_turk *t)
{
    otx_arena *arena = t->run->scratch;

    for (int32_t k = 0; k < t->mesh_count; ++k)
    {
        otx_turk_mesh *mesh = &t->meshes[k];

        mesh->level = &t->surface->levels[t->surface->level_count - 1 - k];
        mesh->count = mesh->level->vert_count;
        OTX_TRY(list_faces(t->run, mesh));
        OTX_TRY(list_neighbours(t->run, t->surface->points, mesh));
        mesh->colors = OTX_ZNEW(arena, otx_quad, mesh->count);
        mesh->pixels = OTX_ZNEW(arena, int32_t, mesh->count);
        OTX_TRY(otx_run_ok(t->run));
    }
    return OSDTEX_OK;
}

/* ---- operators ---- */

void
otx_turk_smooth(
    const otx_turk_mesh *mesh, double t, const otx_quad *values, otx_quad *to)
{
    for (int32_t v = 0; v < mesh->count; ++v)
    {
        const int32_t end = mesh->near_first[v + 1];
        otx_quad sum = values[v];

        for (int32_t i = mesh->near_first[v]; i < end; ++i)
            sum += (values[mesh->near[i]] - values[v]) *
                   (mesh->near_weights[i] * (float)t);
        to[v] = sum;
    }
}

static otx_quad
mean_of(const otx_quad *values, const int32_t *verts, int32_t count)
{
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    for (int32_t i = 0; i < count; ++i)
        sum += values[verts[i]];
    return sum / (float)count;
}

void
otx_turk_interpolate(
    const otx_turk_mesh *coarser, int32_t count, otx_quad *values)
{
    const otx_level *level = coarser->level;

    for (int32_t e = 0; e < level->edge_count; ++e)
        if (level->edge_child_vert[e] >= 0 && level->edge_child_vert[e] < count)
            values[level->edge_child_vert[e]] =
                mean_of(values, level->edge_verts + 2 * (size_t)e, 2);
    for (int32_t f = 0; f < level->face_count; ++f)
        if (level->face_child_vert && level->face_child_vert[f] >= 0)
            values[level->face_child_vert[f]] = mean_of(
                values, level->face_verts + level->face_first[f],
                otx_level_face_size(level, f));
}

/* ---- directions ---- */

/* The face of the textured surface that a finest face lies in. */
static int32_t
ancestor(const otx_turk *t, int32_t face)
{
    for (int32_t l = t->surface->level_count - 1; l >= t->coarse->level_count;
         --l)
        face = t->surface->levels[l].face_parent[face];
    return face;
}

static otx_vec3
normal_of(const otx_turk *t, int32_t v)
{
    return otx_vec3_load(t->surface->normals, v);
}

/* O at each vertex: the directions of the faces around, turned to where the
 * picture falls. */
static otx_status
point_down(otx_turk *t)
{
    const otx_turk_mesh *mesh = &t->meshes[0];
    /* From the guide to -v: the exemplar's direction is at `angle`. */
    const otx_vec2 turn = otx_vec2_polar(-0.5 * OTX_PI - t->guide->angle);

    t->down = OTX_NEW(t->run->scratch, otx_vec3, mesh->count);
    OTX_TRY(otx_run_ok(t->run));
    for (int32_t v = 0; v < mesh->count; ++v)
    {
        const otx_vec3 n = normal_of(t, v);
        otx_vec3 sum = {0, 0, 0}, d;

        for (int32_t i = mesh->face_first[v]; i < mesh->face_first[v + 1]; ++i)
        {
            d = t->guide->directions[ancestor(t, mesh->faces[i])];
            sum = otx_vec3_add(
                sum, otx_vec3_dot(sum, d) < 0.0 ? otx_vec3_scale(-1.0, d) : d);
        }
        d = otx_vec3_sub(sum, otx_vec3_scale(otx_vec3_dot(sum, n), n));
        d = otx_vec3_unit(d);
        t->down[v] = otx_vec3_add(
            otx_vec3_scale(turn.x, d),
            otx_vec3_scale(turn.y, otx_vec3_cross(n, d)));
    }
    return OSDTEX_OK;
}

/* ---- refinement ---- */

/* A plain mesh is parted as it is. */
static otx_status
refine(const otx_vertex *v, otx_turk *t)
{
    otx_cage *cage = OTX_NEW(t->run->scratch, otx_cage, 1);
    otx_surface *surface = OTX_NEW(t->run->scratch, otx_surface, 1);
    int32_t level;

    OTX_TRY(otx_run_ok(t->run));
    *cage = *v->job->surface->cage;
    if (cage->scheme == OTX_SCHEME_NONE)
        cage->scheme = OTX_SCHEME_BILINEAR;
    level = otx_surface_level_for(cage, 1.0 / t->texels);
    if (level < t->coarse->level_count - 1)
        level = t->coarse->level_count - 1;
    if (otx_surface_face_count(cage, level) > VERTICES_MOST)
        return otx_fail(
            t->run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "mode=paper has a vertex for every texel, and the surface would "
            "take %.2g; raise {scale}, or take mode=charts",
            otx_surface_face_count(cage, level));
    OTX_TRY(otx_surface_refine(t->run, cage, level, 0, surface));
    t->surface = surface;
    return OSDTEX_OK;
}

otx_status
otx_turk_build(const otx_vertex *v, otx_turk *out)
{
    *out = (otx_turk){
        .run = v->run,
        .guide = &v->guide,
        .coarse = v->mapping.surface,
        .texels = v->set.texels};
    OTX_TRY(refine(v, out));
    OTX_TRY(otx_pattern_build(
        v->run, v->run->scratch,
        &(otx_pattern_input){
            .lab = &v->job->exemplars->lab,
            .wrap_x = v->job->exemplars->wrap_x,
            .wrap_y = v->job->exemplars->wrap_y,
            .levels = v->settings.levels < OTX_TURK_LEVELS ? v->settings.levels
                                                           : OTX_TURK_LEVELS},
        &out->pattern));
    out->mesh_count = out->pattern.level_count < out->surface->level_count
                          ? out->pattern.level_count
                          : out->surface->level_count;
    OTX_TRY(build_meshes(out));
    out->above = OTX_ZNEW(v->run->scratch, otx_quad, out->meshes[0].count);
    OTX_TRY(otx_run_ok(v->run));
    return point_down(out);
}

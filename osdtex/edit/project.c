/* project.c -- a mapping carried to a surface of other faces. */
#include "edit/project.h"

#include "field/direction.h"

#include <string.h>

static const char STAGE[] = "keep";

/* How far a surface may lie from the old one to show what that does, in
 * diagonals of the cage: what an added edge loop moves is within it. */
static const double REACH = 0.02;

/* Leaf edges by which a corner may lie beyond the patch of its face. */
static const double BEYOND = 4.0;

/* And from which on it counts as beyond. */
static const double LOOSE = 0.02;

/* Barycentric coordinates this near to a corner are the corner: leaf vertices
 * that lie where old ones did have their UVs to the bit. */
static const double SNAP = 1e-4;

/* A coordinate outside of a picture that ends, texels. */
static const double OUTSIDE = 0.5;

/* Faces whose middle is looked for between two looks at the clock. */
enum
{
    LOOK = 256
};

typedef struct carrying
{
    const otx_project *ask;
    otx_run *run;
    const otx_level *old, *leaf; /* leaf levels */
    otx_closest tree;
    double reach;             /* scene units */
    otx_closest_place *verts; /* [leaf vert_count] */
    otx_closest_place *faces; /* [leaf face_count] of their middles */
    otx_mapping *out;
    uint8_t *loose;
} carrying;

/* ---- places on the old surface ---- */

static void
snap(otx_closest_place *place)
{
    for (int k = 0; k < 3; ++k)
        if (place->at[k] > 1.0 - SNAP)
            for (int i = 0; i < 3; ++i)
                place->at[i] = i == k;
}

static otx_closest_ask
ask_vertex(const carrying *c, int32_t vert)
{
    const otx_surface *to = c->ask->to;

    return (otx_closest_ask){
        .point = otx_vec3_load(to->points, vert),
        .normal = otx_vec3_load(to->normals, vert),
        .reach = c->reach};
}

static otx_status
find_vertex(void *context, int64_t index, otx_worker *worker)
{
    const carrying *c = context;
    const otx_closest_ask ask = ask_vertex(c, (int32_t)index);

    (void)worker;
    c->verts[index] = otx_closest_find(&c->tree, &ask);
    snap(&c->verts[index]);
    return OSDTEX_OK;
}

/* Middle and normal of a face of the new surface. */
static otx_closest_ask
ask_face(const carrying *c, int32_t face)
{
    const otx_surface *to = c->ask->to;
    const int32_t first = c->leaf->face_first[face];
    const int32_t size = otx_level_face_size(c->leaf, face);
    otx_closest_ask ask = {.reach = c->reach};
    const otx_vec3 origin =
        otx_vec3_load(to->points, c->leaf->face_verts[first]);

    for (int32_t i = 0; i < size; ++i)
    {
        const otx_vec3 a =
            otx_vec3_load(to->points, c->leaf->face_verts[first + i]);
        const otx_vec3 b = otx_vec3_load(
            to->points, c->leaf->face_verts[first + (i + 1) % size]);

        ask.point = otx_vec3_add(ask.point, a);
        ask.normal = otx_vec3_add(
            ask.normal,
            otx_vec3_cross(otx_vec3_sub(a, origin), otx_vec3_sub(b, origin)));
    }
    ask.point = otx_vec3_scale(1.0 / size, ask.point);
    return ask;
}

static otx_status
find_face(void *context, int64_t index, otx_worker *worker)
{
    const carrying *c = context;
    const otx_closest_ask ask = ask_face(c, (int32_t)index);

    (void)worker;
    c->faces[index] = otx_closest_find(&c->tree, &ask);
    return OSDTEX_OK;
}

static otx_status
find_places(carrying *c)
{
    otx_run *run = c->run;

    c->verts = OTX_NEW(run->arena, otx_closest_place, c->leaf->vert_count);
    c->faces = OTX_NEW(run->arena, otx_closest_place, c->leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_closest_build(run, c->ask->made_for, &c->tree));
    OTX_TRY(otx_loop_result(
        run, STAGE,
        otx_pool_for(run->pool, c->leaf->vert_count, find_vertex, c)));
    return otx_loop_result(
        run, STAGE, otx_pool_for(run->pool, c->leaf->face_count, find_face, c));
}

/* ---- UVs ---- */

static otx_vec2
uv_at(const carrying *c, const otx_closest_place *place)
{
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = c->ask->from->uvs + 2 * (size_t)place->corners[k];

        sum.x += place->at[k] * (double)uv[0];
        sum.y += place->at[k] * (double)uv[1];
    }
    return sum;
}

static int32_t
patch_at(const carrying *c, const otx_closest_place *place)
{
    return place->face >= 0 ? c->ask->from->face_patch[place->face] : -1;
}

/* The UV that a patch has at a vertex, continued where the vertex lies beyond
 * it, which is counted; false where it is too far. The same for all faces of
 * the patch. */
static bool
find_uv(
    const carrying *c, int32_t vert, int32_t patch, otx_vec2 *uv,
    uint8_t *beyond)
{
    const otx_closest_place *there = &c->verts[vert];
    const double edge = c->ask->to->mean_edge_length;
    otx_closest_ask ask = ask_vertex(c, vert);
    otx_closest_place place;
    otx_vec3 triangle[3];

    *uv = uv_at(c, there);
    if (patch_at(c, there) == patch)
        return true;
    ask.labels = c->ask->from->face_patch;
    ask.label = patch;
    ask.reach = there->distance + BEYOND * edge;
    place = otx_closest_find(&c->tree, &ask);
    if (place.face < 0)
        return false;
    if (place.distance > there->distance + LOOSE * edge)
    {
        *beyond += *beyond < UINT8_MAX;
        otx_closest_corners(c->ask->made_for, place.corners, triangle);
        otx_closest_below(ask.point, triangle, place.at);
    }
    else
        snap(&place);
    *uv = uv_at(c, &place);
    return true;
}

/* Whether a picture has something there. */
static bool
is_inside(const carrying *c, int32_t patch, otx_vec2 uv)
{
    const otx_mapping *m = c->ask->from;
    const otx_exemplar *e =
        &c->ask->exemplars[m->patch_exemplar ? m->patch_exemplar[patch] : 0];
    const double x = uv.x * e->match.width, y = uv.y * e->match.height;

    /* Written so that NaN is outside. */
    return (e->wrap_x || (x >= -OUTSIDE && x <= e->match.width + OUTSIDE)) &&
           (e->wrap_y || (y >= -OUTSIDE && y <= e->match.height + OUTSIDE)) &&
           isfinite(uv.x) && isfinite(uv.y);
}

/* Whether a face can be of a patch; its UVs are then set. */
static bool
lay_face(carrying *c, int32_t face, int32_t patch)
{
    uint8_t beyond = 0;

    for (int32_t i = c->leaf->face_first[face];
         i < c->leaf->face_first[face + 1]; ++i)
    {
        otx_vec2 uv;

        if (!find_uv(c, c->leaf->face_verts[i], patch, &uv, &beyond) ||
            !is_inside(c, patch, uv))
            return false;
        c->out->uvs[2 * (size_t)i] = (float)uv.x;
        c->out->uvs[2 * (size_t)i + 1] = (float)uv.y;
    }
    c->out->face_patch[face] = patch;
    c->loose[face] = beyond;
    return true;
}

/* The patch of a face's middle, or else of the first corner that has one which
 * fits. */
static void
carry_face(carrying *c, int32_t face)
{
    const int32_t first = c->leaf->face_first[face];
    const int32_t end = c->leaf->face_first[face + 1];

    c->out->face_patch[face] = -1;
    if (c->leaf->face_hole[face] || c->faces[face].face < 0)
        return;
    for (int32_t i = first; i < end; ++i)
        if (c->verts[c->leaf->face_verts[i]].face < 0)
            return;
    for (int32_t i = first - 1; i < end; ++i)
    {
        const otx_closest_place *place =
            i < first ? &c->faces[face] : &c->verts[c->leaf->face_verts[i]];
        const int32_t patch = patch_at(c, place);

        if (patch >= 0 && lay_face(c, face, patch))
            return;
    }
}

static otx_status
carry_faces(carrying *c)
{
    c->out->uvs =
        OTX_ZNEW(c->run->arena, float, 2 * (size_t)c->leaf->corner_count);
    c->out->face_patch = OTX_NEW(c->run->arena, int32_t, c->leaf->face_count);
    c->loose = OTX_ZNEW(c->run->arena, uint8_t, c->leaf->face_count);
    OTX_TRY(otx_run_ok(c->run));
    for (int32_t f = 0; f < c->leaf->face_count; ++f)
    {
        if (f % LOOK == 0)
            OTX_TRY(otx_pulse(c->run));
        carry_face(c, f);
    }
    return OSDTEX_OK;
}

/* ---- fields ---- */

/* Directions of the old surface, continued where it has none. */
static otx_status
carry_guide(carrying *c)
{
    const otx_guide *from = c->ask->from->guide;
    otx_connection connection;
    otx_vec3 *directions;
    otx_direction field;
    otx_guide *guide;

    if (!from)
        return OSDTEX_OK;
    directions = OTX_ZNEW(c->run->arena, otx_vec3, c->leaf->face_count);
    guide = OTX_NEW(c->run->arena, otx_guide, 1);
    OTX_TRY(otx_run_ok(c->run));
    for (int32_t f = 0; f < c->leaf->face_count; ++f)
        if (c->faces[f].face >= 0)
            directions[f] = from->directions[c->faces[f].face];
    OTX_TRY(otx_connection_build(
        c->run, c->ask->to, c->ask->to->level_count - 1, &connection));
    OTX_TRY(otx_direction_from_vectors(
        c->run, &connection, from->symmetry, directions, &field));
    for (int32_t f = 0; f < c->leaf->face_count; ++f)
    {
        const otx_vec3 along = otx_connection_lift(
            &connection, f,
            otx_connection_project(&connection, f, directions[f]));

        directions[f] = otx_vec3_length(along) > 0.0
                            ? otx_vec3_unit(along)
                            : otx_direction_vector(&field, f);
    }
    *guide = *from;
    guide->directions = directions;
    c->out->guide = guide;
    return OSDTEX_OK;
}

/* Of a vertex that the old surface is far from, the nearest place at all. */
static otx_closest_place
place_of(const carrying *c, int32_t vert)
{
    otx_closest_ask ask = {.reach = (double)INFINITY};

    if (c->verts[vert].face >= 0)
        return c->verts[vert];
    ask.point = otx_vec3_load(c->ask->to->points, vert);
    return otx_closest_find(&c->tree, &ask);
}

/* Values at vertices; NULL stays NULL. */
static otx_status
carry_values(carrying *c, const float *from, const float **out)
{
    float *made;

    *out = NULL;
    if (!from)
        return OSDTEX_OK;
    made = OTX_NEW(c->run->arena, float, c->leaf->vert_count);
    OTX_TRY(otx_run_ok(c->run));
    for (int32_t v = 0; v < c->leaf->vert_count; ++v)
    {
        const otx_closest_place place = place_of(c, v);
        double sum = 0.0;

        for (int k = 0; k < 3; ++k)
            sum += place.at[k] *
                   (double)from[c->old->face_verts[place.corners[k]]];
        made[v] = (float)sum;
    }
    *out = made;
    return OSDTEX_OK;
}

static otx_status
carry_density(carrying *c)
{
    otx_surface *surface;

    c->out->surface = c->ask->to;
    if (!c->ask->from->surface->density)
        return OSDTEX_OK;
    surface = OTX_NEW(c->run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(c->run));
    *surface = *c->ask->to;
    OTX_TRY(carry_values(c, c->ask->from->surface->density, &surface->density));
    c->out->surface = surface;
    return OSDTEX_OK;
}

static otx_status
carry_points(const carrying *c, const float **out)
{
    const otx_surface *to = c->ask->to;
    const size_t count = 3 * (size_t)c->leaf->vert_count;
    float *points = OTX_NEW(c->run->arena, float, count);

    OTX_TRY(otx_run_ok(c->run));
    memcpy(points, to->points, count * sizeof *points);
    for (int32_t v = 0; v < c->leaf->vert_count; ++v)
    {
        const otx_closest_place *place = &c->verts[v];
        otx_vec3 sum = {0.0, 0.0, 0.0}, t[3];

        if (place->face < 0)
            continue;
        otx_closest_corners(c->ask->made_for, place->corners, t);
        for (int k = 0; k < 3; ++k)
            sum = otx_vec3_mix(1.0, sum, place->at[k], t[k]);
        points[3 * (size_t)v] = (float)sum.x;
        points[3 * (size_t)v + 1] = (float)sum.y;
        points[3 * (size_t)v + 2] = (float)sum.z;
    }
    *out = points;
    return OSDTEX_OK;
}

otx_status
otx_project_run(otx_run *run, const otx_project *project, otx_projected *out)
{
    const otx_mapping *from = project->from;
    carrying c = {
        .ask = project,
        .run = run,
        .old = otx_surface_leaf(project->made_for),
        .leaf = otx_surface_leaf(project->to),
        .reach = REACH * project->to->cage->diagonal,
        .out = &out->mapping};

    *out = (otx_projected){
        .mapping = {
            .scale = from->scale,
            .patch_count = from->patch_count,
            .exemplar_count = from->exemplar_count,
            .patch_exemplar = from->patch_exemplar}};
    OTX_TRY(find_places(&c));
    OTX_TRY(carry_faces(&c));
    OTX_TRY(carry_density(&c));
    OTX_TRY(carry_values(&c, from->along, &out->mapping.along));
    OTX_TRY(carry_guide(&c));
    OTX_TRY(carry_points(&c, &out->points));
    out->loose = c.loose;
    out->verts = c.verts;
    out->faces = c.faces;
    return OSDTEX_OK;
}

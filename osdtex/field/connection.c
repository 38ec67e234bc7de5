/* connection.c -- tangent planes of faces, and how they turn into each other.
 *
 * Directions of edges are those of the edges projected into the plane of the
 * face, which matters for quads that are not plane: the corner angles of a
 * projected polygon sum to (n - 2) pi, and so the defects sum exactly. */
#include "field/connection.h"

/* Faces without area have any frame; weights keep the systems definite. */
static const double WEIGHT_MIN = 1e-3;
static const double WEIGHT_MAX = 1e3;

static void
measure_face(otx_connection *c, int32_t face)
{
    const otx_level *level = c->level;
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const otx_vec3 origin =
        otx_vec3_load(c->surface->points, level->face_verts[first]);
    otx_vec3 centre = {0, 0, 0}, twice = {0, 0, 0};

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec3 a = otx_vec3_sub(
            otx_vec3_load(c->surface->points, level->face_verts[first + k]),
            origin);
        const otx_vec3 b = otx_vec3_sub(
            otx_vec3_load(
                c->surface->points, level->face_verts[first + (k + 1) % size]),
            origin);

        centre = otx_vec3_add(centre, a);
        twice = otx_vec3_add(twice, otx_vec3_cross(a, b));
    }
    c->centres[face] = otx_vec3_add(origin, otx_vec3_scale(1.0 / size, centre));
    c->areas[face] =
        level->face_hole[face] ? 0.0 : 0.5 * otx_vec3_length(twice);
    c->normals[face] = otx_vec3_unit(twice);
}

/* A frame whose real axis is the first edge that has a direction. */
static void
choose_frame(otx_connection *c, int32_t face)
{
    const otx_level *level = c->level;
    otx_vec3 n = c->normals[face];
    otx_vec3 axis = {0, 0, 0};

    if (!(otx_vec3_dot(n, n) > 0.5))
        n = c->normals[face] = (otx_vec3){0, 0, 1};
    for (int32_t i = level->face_first[face];
         i < level->face_first[face + 1] && !(otx_vec3_dot(axis, axis) > 0.5);
         ++i)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(c->surface->points, level->face_verts[i]),
            c->centres[face]);

        axis = otx_vec3_unit(otx_vec3_mix(1.0, d, -otx_vec3_dot(d, n), n));
    }
    if (!(otx_vec3_dot(axis, axis) > 0.5))
        axis = otx_vec3_unit(otx_vec3_cross(
            n, fabs(n.x) < 0.5 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0}));
    c->axes[face] = axis;
}

otx_vec3
otx_connection_lift(const otx_connection *c, int32_t face, otx_vec2 flat)
{
    return otx_vec3_mix(
        flat.x, c->axes[face], flat.y,
        otx_vec3_cross(c->normals[face], c->axes[face]));
}

otx_vec2
otx_connection_project(const otx_connection *c, int32_t face, otx_vec3 vector)
{
    return (otx_vec2){
        otx_vec3_dot(vector, c->axes[face]),
        otx_vec3_dot(vector, otx_vec3_cross(c->normals[face], c->axes[face]))};
}

static otx_status
do_face(void *context, int64_t face, otx_worker *worker)
{
    otx_connection *c = context;
    const otx_level *level = c->level;
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, (int32_t)face);

    (void)worker;
    measure_face(c, (int32_t)face);
    choose_frame(c, (int32_t)face);
    for (int32_t k = 0; k < size; ++k)
        c->sides[first + k] = otx_connection_project(
            c, (int32_t)face,
            otx_vec3_sub(
                otx_vec3_load(
                    c->surface->points,
                    level->face_verts[first + (k + 1) % size]),
                otx_vec3_load(
                    c->surface->points, level->face_verts[first + k])));
    return OSDTEX_OK;
}

int32_t
otx_connection_corner(const otx_connection *c, int32_t edge, int32_t face)
{
    int32_t i = c->level->face_first[face];

    while (c->level->face_edges[i] != edge)
        ++i;
    return i;
}

static otx_status
do_edge(void *context, int64_t edge, otx_worker *worker)
{
    otx_connection *c = context;
    const otx_level *level = c->level;
    const int32_t *faces = level->edge_faces + 2 * edge;
    const int32_t *verts = level->edge_verts + 2 * edge;
    otx_vec3 a, b, middle;
    otx_vec2 s, t, turn;
    double across;

    (void)worker;
    if (faces[1] < 0 || level->face_hole[faces[0]] ||
        level->face_hole[faces[1]])
        return OSDTEX_OK;
    s = c->sides[otx_connection_corner(c, (int32_t)edge, faces[0])];
    t = c->sides[otx_connection_corner(c, (int32_t)edge, faces[1])];
    /* The half-edges run against each other: -t / s. */
    turn = otx_vec2_mul((otx_vec2){s.x, -s.y}, (otx_vec2){-t.x, -t.y});
    c->inner[edge] = 1;
    c->turns[edge] = atan2(turn.y, turn.x);
    a = otx_vec3_load(c->surface->points, verts[0]);
    b = otx_vec3_load(c->surface->points, verts[1]);
    middle = otx_vec3_mix(0.5, a, 0.5, b);
    across = otx_vec3_length(otx_vec3_sub(c->centres[faces[0]], middle)) +
             otx_vec3_length(otx_vec3_sub(c->centres[faces[1]], middle));
    c->weights[edge] = fmin(
        fmax(
            otx_vec3_length(otx_vec3_sub(a, b)) / fmax(across, 1e-300),
            WEIGHT_MIN),
        WEIGHT_MAX);
    return OSDTEX_OK;
}

otx_status
otx_connection_build(
    otx_run *run, const otx_surface *surface, int32_t level,
    otx_connection *out)
{
    const otx_level *l = &surface->levels[level];

    *out = (otx_connection){
        .surface = surface,
        .level = l,
        .level_index = level,
        .centres = OTX_NEW(run->arena, otx_vec3, l->face_count),
        .normals = OTX_NEW(run->arena, otx_vec3, l->face_count),
        .axes = OTX_NEW(run->arena, otx_vec3, l->face_count),
        .areas = OTX_NEW(run->arena, double, l->face_count),
        .sides = OTX_NEW(run->arena, otx_vec2, l->corner_count),
        .turns = OTX_ZNEW(run->arena, double, l->edge_count),
        .weights = OTX_ZNEW(run->arena, double, l->edge_count),
        .inner = OTX_ZNEW(run->arena, uint8_t, l->edge_count),
    };
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_pool_for(run->pool, l->face_count, do_face, out));
    OTX_TRY(otx_pool_for(run->pool, l->edge_count, do_edge, out));
    for (int32_t f = 0; f < l->face_count; ++f)
        out->area += out->areas[f];
    return OSDTEX_OK;
}

/* Marks the vertices whose faces all around are no holes: 1 inside. In
 * run->arena; NULL when memory is out. */
static uint8_t *
mark_inside(otx_run *run, const otx_connection *c)
{
    const otx_level *level = c->level;
    uint8_t *inside = OTX_ZNEW(run->arena, uint8_t, level->vert_count);

    if (!inside)
        return NULL;
    for (int32_t i = 0; i < level->corner_count; ++i)
        inside[level->face_verts[i]] = 1;
    for (int32_t e = 0; e < level->edge_count; ++e)
        if (!c->inner[e])
            inside[level->edge_verts[2 * (size_t)e]] =
                inside[level->edge_verts[2 * (size_t)e + 1]] = 0;
    return inside;
}

/* Angle at corner k of a projected polygon, in (0, 2 pi). */
static double
corner_angle(const otx_vec2 *sides, int32_t size, int32_t k)
{
    const otx_vec2 in = sides[(k + size - 1) % size], out = sides[k];
    const double turn = atan2(otx_vec2_cross(in, out), otx_vec2_dot(in, out));

    return OTX_PI - turn;
}

otx_status
otx_connection_defects(otx_run *run, const otx_connection *c, double **out)
{
    const otx_level *level = c->level;
    double *defects = OTX_NEW(run->arena, double, level->vert_count);
    const uint8_t *inside = mark_inside(run, c);

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < level->vert_count; ++v)
        defects[v] = inside[v] ? 2.0 * OTX_PI : NAN;
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t first = level->face_first[f];
        const int32_t size = otx_level_face_size(level, f);

        for (int32_t k = 0; k < size; ++k)
            defects[level->face_verts[first + k]] -=
                corner_angle(c->sides + first, size, k);
    }
    *out = defects;
    return OSDTEX_OK;
}

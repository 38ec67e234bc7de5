/* footprint.c -- the part of a surface that a picture covers, laid out flat. */
#include "place/footprint.h"

#include "flatten/rigid.h"
#include "place/ground.h"
#include "place/worth.h"

enum
{
    PASSES = 4,
    RIGID_ROUNDS = 24,
    CG_ROUNDS = 200
};

static const double CG_TOLERANCE = 1e-6;
/* How far beyond the picture faces are unfolded at first, and at last, in
 * widths. */
static const double REACH_FIRST = 0.25, REACH_LAST = 0.02;

static void
apply(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    otx_rigid_apply(context, x, first, end, out);
}

/* Local and global rounds from where the vertices are. */
static otx_status
relax(otx_arena *arena, const otx_footprint_ask *ask, otx_footprint *f)
{
    const otx_rigid_mesh mesh = {
        f->face_count, f->vert_count,        f->first,         f->corners,
        f->verts,      ask->surface->points, 1.0 / ask->width, NULL};
    otx_rigid rigid;
    otx_vec2 *b = OTX_NEW(arena, otx_vec2, f->vert_count);
    otx_vec2 *diagonal = OTX_NEW(arena, otx_vec2, f->vert_count);
    const otx_rigid_system system = {
        .count = f->vert_count,
        .apply = apply,
        .context = &rigid,
        .diagonal = diagonal,
        .rounds = CG_ROUNDS,
        .tolerance = CG_TOLERANCE,
        .worker = ask->worker};

    if (!b || !diagonal)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_rigid_build(arena, &mesh, &rigid));
    for (int32_t v = 0; v < f->vert_count; ++v)
    {
        const double d = fmax(rigid.diagonal[v], 1e-12);

        diagonal[v] = (otx_vec2){d, d};
    }
    for (int32_t round = 0; round < RIGID_ROUNDS; ++round)
    {
        otx_rigid_pull(&rigid, f->flat, b);
        OTX_TRY(otx_rigid_solve(arena, &system, b, f->flat));
    }
    return OSDTEX_OK;
}

/* The picture's up as it lies in the plane now: the image of a vector of the
 * spot's triangle. */
static otx_vec2
up_in_plane(const otx_footprint_ask *ask, const otx_vec2 u[3])
{
    const otx_level *leaf = otx_surface_leaf(ask->surface);
    otx_vec3 p[3], a, b, n;
    double area, s, t;

    for (int k = 0; k < 3; ++k)
        p[k] = otx_vec3_load(
            ask->surface->points, leaf->face_verts[ask->spot.corners[k]]);
    a = otx_vec3_sub(p[1], p[0]);
    b = otx_vec3_sub(p[2], p[0]);
    n = otx_vec3_cross(a, b);
    area = fmax(otx_vec3_dot(n, n), 1e-300);
    s = otx_vec3_dot(otx_vec3_cross(ask->up, b), n) / area;
    t = otx_vec3_dot(otx_vec3_cross(a, ask->up), n) / area;
    return otx_vec2_add(
        otx_vec2_scale(s, otx_vec2_sub(u[1], u[0])),
        otx_vec2_scale(t, otx_vec2_sub(u[2], u[0])));
}

/* Moves the spot to the origin, and turns the chart until up is +y. */
static void
settle(
    const otx_footprint_ask *ask, const otx_footprint_space *space,
    otx_footprint *f)
{
    const otx_level *leaf = otx_surface_leaf(ask->surface);
    otx_vec2 origin = {0, 0}, u[3], up, turn;
    double length;

    for (int k = 0; k < 3; ++k)
    {
        u[k] =
            f->flat[space->vert_slot[leaf->face_verts[ask->spot.corners[k]]]];
        origin = otx_vec2_add(origin, otx_vec2_scale(ask->spot.at[k], u[k]));
    }
    up = up_in_plane(ask, u);
    length = otx_vec2_length(up);
    /* i / up */
    turn = length > 0.0 ? (otx_vec2){up.y / length, up.x / length}
                        : (otx_vec2){1, 0};
    for (int32_t v = 0; v < f->vert_count; ++v)
        f->flat[v] = otx_vec2_mul(turn, otx_vec2_sub(f->flat[v], origin));
}

otx_status
otx_footprint_lay(
    otx_arena *arena, const otx_footprint_ask *ask,
    const otx_footprint_space *space, otx_footprint *out)
{
    otx_ground unfolding = {
        .ask = ask, .space = space, .arena = arena, .chart = out};
    otx_status status = otx_ground_begin(&unfolding);

    if (status == OSDTEX_OK)
        settle(ask, space, out);
    for (int pass = 0; pass < PASSES && status == OSDTEX_OK; ++pass)
    {
        status =
            otx_ground_grow(&unfolding, pass == 0 ? REACH_FIRST : REACH_LAST);
        if (status == OSDTEX_OK)
            status = relax(arena, ask, out);
        if (status == OSDTEX_OK)
            settle(ask, space, out);
        if (status == OSDTEX_OK && pass + 1 < PASSES)
            status = otx_ground_trim(&unfolding, REACH_LAST);
    }
    if (status == OSDTEX_OK)
        status = otx_worth_judge(arena, ask, space, out);
    otx_ground_end(&unfolding);
    return status;
}

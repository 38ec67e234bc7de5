/* aligned.c -- coordinates whose axes lie along a field [Praun00, sec. 3.4]. */
#include "flatten/aligned.h"

#include "flatten/stretch.h"

enum
{
    CG_ROUNDS = 200
};

static const double CG_TOLERANCE = 1e-5;

/* S in the plane that a triangle is laid out in by otx_stretch_layout. */
static otx_vec2
right_in_layout(const otx_rigid_mesh *mesh, const int32_t v[3], otx_vec3 right)
{
    const otx_vec3 a = otx_vec3_load(mesh->points, mesh->verts[v[0]]);
    const otx_vec3 b = otx_vec3_load(mesh->points, mesh->verts[v[1]]);
    const otx_vec3 c = otx_vec3_load(mesh->points, mesh->verts[v[2]]);
    const otx_vec3 x = otx_vec3_unit(otx_vec3_sub(b, a));
    const otx_vec3 n =
        otx_vec3_unit(otx_vec3_cross(otx_vec3_sub(b, a), otx_vec3_sub(c, a)));
    const otx_vec3 y = otx_vec3_cross(n, x);
    const otx_vec2 s = {otx_vec3_dot(right, x), otx_vec3_dot(right, y)};
    const double length = otx_vec2_length(s);

    return length > 0.0 ? otx_vec2_scale(1.0 / length, s) : (otx_vec2){1, 0};
}

/* The rotation of each triangle takes S to (1, 0). */
static void
turn_triangles(
    const otx_rigid_mesh *mesh, const otx_rigid *rigid, const otx_vec3 *rights,
    otx_vec2 *turns)
{
    int32_t t = 0;

    for (int32_t f = 0; f < mesh->face_count; ++f)
        for (int32_t c = mesh->first[f] + 1; c + 1 < mesh->first[f + 1];
             ++c, ++t)
        {
            const otx_vec2 s =
                right_in_layout(mesh, rigid->triangles[t].v, rights[f]);

            turns[t] = (otx_vec2){s.x, -s.y};
        }
}

static otx_vec2
mean_of(const otx_vec2 *flat, int32_t count)
{
    otx_vec2 sum = {0, 0};

    for (int32_t i = 0; i < count; ++i)
        sum = otx_vec2_add(sum, flat[i]);
    return otx_vec2_scale(1.0 / (count > 0 ? count : 1), sum);
}

static void
apply(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    otx_rigid_apply(context, x, first, end, out);
}

static otx_status
solve(
    otx_arena *scratch, const otx_rigid *rigid, const otx_vec2 *b,
    const otx_worker *worker, otx_vec2 *flat)
{
    otx_vec2 *diagonal = OTX_NEW(scratch, otx_vec2, rigid->vert_count);
    const otx_vec2 before = mean_of(flat, rigid->vert_count);
    const otx_rigid_system system = {
        .count = rigid->vert_count,
        .apply = apply,
        .context = rigid,
        .diagonal = diagonal,
        .rounds = CG_ROUNDS,
        .tolerance = CG_TOLERANCE,
        .worker = worker,
    };
    otx_vec2 moved;

    if (!diagonal)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < rigid->vert_count; ++v)
        diagonal[v] = (otx_vec2){
            fmax(rigid->diagonal[v], 1e-12), fmax(rigid->diagonal[v], 1e-12)};
    OTX_TRY(otx_rigid_solve(scratch, &system, b, flat));
    moved = otx_vec2_sub(before, mean_of(flat, rigid->vert_count));
    for (int32_t v = 0; v < rigid->vert_count; ++v)
        flat[v] = otx_vec2_add(flat[v], moved);
    return OSDTEX_OK;
}

otx_status
otx_aligned_solve(
    otx_arena *scratch, const otx_rigid_mesh *mesh, const otx_vec3 *rights,
    const otx_worker *worker, otx_vec2 *flat)
{
    otx_rigid_fans fans;
    otx_rigid rigid;
    otx_vec2 *b = OTX_NEW(scratch, otx_vec2, mesh->vert_count);

    if (!b)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_rigid_build(scratch, mesh, &rigid));
    OTX_TRY(otx_rigid_fans_build(scratch, &rigid, &fans));
    turn_triangles(mesh, &rigid, rights, fans.turns);
    otx_rigid_fans_pull(&rigid, &fans, 0, mesh->vert_count, b);
    return solve(scratch, &rigid, b, worker, flat);
}

/* The map from a triangle's layout q to its place u, applied to a vector. */
static otx_vec2
image_of(const otx_vec2 q[3], const otx_vec2 u[3], otx_vec2 vector)
{
    const otx_vec2 q1 = otx_vec2_sub(q[1], q[0]), q2 = otx_vec2_sub(q[2], q[0]);
    const double area2 = otx_vec2_cross(q1, q2);
    const double a = otx_vec2_cross(vector, q2) / area2;
    const double b = otx_vec2_cross(q1, vector) / area2;

    return otx_vec2_add(
        otx_vec2_scale(a, otx_vec2_sub(u[1], u[0])),
        otx_vec2_scale(b, otx_vec2_sub(u[2], u[0])));
}

static double
distance_sq(otx_vec2 a, otx_vec2 b)
{
    const otx_vec2 d = otx_vec2_sub(a, b);

    return otx_vec2_dot(d, d);
}

void
otx_aligned_error(
    const otx_rigid_mesh *mesh, int32_t face, otx_vec3 right,
    const otx_vec2 *flat, double sums[3])
{
    const int32_t first = mesh->first[face];

    for (int32_t c = first + 1; c + 1 < mesh->first[face + 1]; ++c)
    {
        const int32_t v[3] = {
            mesh->corners[first], mesh->corners[c], mesh->corners[c + 1]};
        double texels = mesh->density ? 0.0 : mesh->texels;
        otx_vec2 q[3], u[3], s;
        otx_vec3 p[3];
        double area;

        for (int i = 0; mesh->density && i < 3; ++i)
            texels +=
                mesh->texels / 3.0 * (double)mesh->density[mesh->verts[v[i]]];
        for (int i = 0; i < 3; ++i)
        {
            p[i] = otx_vec3_scale(
                texels, otx_vec3_load(mesh->points, mesh->verts[v[i]]));
            u[i] = flat[v[i]];
        }
        otx_stretch_layout(p, q);
        area = 0.5 * q[1].x * q[2].y;
        if (!(area > 0.0))
            continue;
        s = right_in_layout(mesh, v, right);
        sums[0] += area * distance_sq(image_of(q, u, s), (otx_vec2){1, 0});
        sums[1] +=
            area * distance_sq(
                       image_of(q, u, (otx_vec2){-s.y, s.x}), (otx_vec2){0, 1});
        sums[2] += area;
    }
}

/* extent.c -- means of the two derivatives over a face. */
#include "bake/extent.h"

#include "bake/fvar_linear.h"

/* Blocks are no longer than this times their width. */
static const double LONGEST = 16.0;

otx_vec2
otx_extent_corner(int32_t n, int32_t k)
{
    static const otx_vec2 square[4] = {
        {0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

    if (n == 4)
        return square[k];
    if (n == 3)
        return square[k == 2 ? 3 : k];

    const otx_vec2 ray = otx_vec2_polar(2.0 * OTX_PI * k / n);

    return (otx_vec2){0.5 + 0.5 * ray.x, 0.5 + 0.5 * ray.y};
}

/* Sums over the triangles of a face. */
typedef struct sums
{
    double area;       /* on the surface */
    double share;      /* of the unit square */
    double squares[2]; /* of the derivatives by x and y, times the share */
    double eighths[2]; /* their eighth powers, likewise */
} sums;

static void
add_triangle(
    const otx_surface *surface, const float *uvs, const int32_t corners[3],
    sums *s)
{
    const int32_t *verts = otx_surface_leaf(surface)->face_verts;
    otx_vec2 q[3];
    otx_vec3 p[3];

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = uvs + 2 * (size_t)corners[k];

        q[k] = (otx_vec2){uv[0], uv[1]};
        p[k] = otx_vec3_load(surface->points, verts[corners[k]]);
    }

    const otx_vec2 q1 = otx_vec2_sub(q[1], q[0]), q2 = otx_vec2_sub(q[2], q[0]);
    const otx_vec3 p1 = otx_vec3_sub(p[1], p[0]), p2 = otx_vec3_sub(p[2], p[0]);
    const double area2 = otx_vec2_cross(q1, q2);

    s->area += 0.5 * otx_vec3_length(otx_vec3_cross(p1, p2));
    if (!(fabs(area2) > 0.0))
        return;

    const otx_vec3 dx = otx_vec3_mix(q2.y / area2, p1, -q1.y / area2, p2);
    const otx_vec3 dy = otx_vec3_mix(-q2.x / area2, p1, q1.x / area2, p2);
    const double sq[2] = {otx_vec3_dot(dx, dx), otx_vec3_dot(dy, dy)};
    const double share = 0.5 * fabs(area2);

    s->share += share;
    for (int i = 0; i < 2; ++i)
    {
        s->squares[i] += share * sq[i];
        s->eighths[i] += share * sq[i] * sq[i] * sq[i] * sq[i];
    }
}

/* The eighth-power means, shrunk where the axes are not at right angles and the
 * area is less than their product. The eighth power is near the largest: beside
 * a vertex of high valence some leaves are several times as large as the
 * others, and they are to get their texels, too. */
static void
set_extent(const sums *s, double out[2])
{
    const double product = sqrt(s->squares[0]) * sqrt(s->squares[1]);
    /* Written so that NaN, of a face without extent, shrinks nothing. */
    const double shrink = product > 0.0 ? sqrt(s->area / product) : 1.0;

    for (int i = 0; i < 2; ++i)
        out[i] = s->share > 0.0
                     ? shrink * sqrt(sqrt(sqrt(s->eighths[i] / s->share)))
                     : 0.0;
    out[0] = fmax(out[0], out[1] / LONGEST);
    out[1] = fmax(out[1], out[0] / LONGEST);
}

static void
measure_face(
    const otx_surface *surface, const float *uvs, int32_t face, double out[2])
{
    const otx_level *leaf = otx_surface_leaf(surface);
    sums s = {0};
    int32_t f, end;

    otx_surface_leaves(surface, 0, face, &f, &end);
    for (; f < end; ++f)
        for (int32_t c = leaf->face_first[f] + 2; c < leaf->face_first[f + 1];
             ++c)
            add_triangle(
                surface, uvs, (const int32_t[]){leaf->face_first[f], c - 1, c},
                &s);

    set_extent(&s, out);
}

static otx_status
measure(
    otx_run *run, const otx_surface *surface, float *cage_uvs, float *leaf_uvs,
    double *extents)
{
    const otx_cage *cage = surface->cage;

    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        const int32_t first = cage->face_first[f];
        const int32_t n = cage->face_first[f + 1] - first;

        for (int32_t k = 0; k < n; ++k)
        {
            const otx_vec2 at = otx_extent_corner(n, k);

            cage_uvs[2 * (size_t)(first + k)] = (float)at.x;
            cage_uvs[2 * (size_t)(first + k) + 1] = (float)at.y;
        }
    }
    OTX_TRY(otx_fvar_linear(run, surface, cage_uvs, leaf_uvs));
    for (int32_t f = 0; f < cage->face_count; ++f)
        measure_face(surface, leaf_uvs, f, extents + 2 * (size_t)f);
    return OSDTEX_OK;
}

otx_status
otx_extent_measure(otx_run *run, const otx_surface *surface, double *extents)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const size_t leaf_corners = (size_t)otx_surface_leaf(surface)->corner_count;
    float *cage_uvs =
        OTX_NEW(run->scratch, float, 2 * (size_t)surface->cage->corner_count);
    float *leaf_uvs = OTX_NEW(run->scratch, float, 2 * leaf_corners);
    const otx_status status =
        cage_uvs && leaf_uvs
            ? measure(run, surface, cage_uvs, leaf_uvs, extents)
            : otx_fail_memory(run, "bake");

    otx_arena_release(run->scratch, mark);
    return status;
}

/* stroll.c -- straight ways over a mesh, from a vertex on [Turk01, sec. 5.1].
 */
#include "method/vertex/stroll.h"

enum
{
    CROSSINGS = 256 /* of edges by one way; what takes more goes in circles */
};

static otx_vec3
corner(const otx_stroll *s, int k)
{
    return otx_vec3_load(
        s->points, s->mesh->level->face_verts[s->facet.corners[k]]);
}

static otx_vec3
normal_of(const otx_stroll *s)
{
    const otx_vec3 a = corner(s, 0);

    return otx_vec3_cross(
        otx_vec3_sub(corner(s, 1), a), otx_vec3_sub(corner(s, 2), a));
}

/* How far inside of the corner at k of the facet a direction is: the smaller of
 * the sines to both sides; the direction's part in the plane. */
static double
inside(const otx_stroll *s, int k, otx_vec3 direction, otx_vec3 *flat)
{
    const otx_vec3 n = otx_vec3_unit(normal_of(s));
    const otx_vec3 v = corner(s, k);
    const otx_vec3 u = otx_vec3_unit(otx_vec3_sub(corner(s, (k + 1) % 3), v));
    const otx_vec3 w = otx_vec3_unit(otx_vec3_sub(corner(s, (k + 2) % 3), v));

    *flat = otx_vec3_unit(
        otx_vec3_sub(direction, otx_vec3_scale(otx_vec3_dot(direction, n), n)));
    return fmin(
        otx_vec3_dot(otx_vec3_cross(u, *flat), n),
        otx_vec3_dot(otx_vec3_cross(*flat, w), n));
}

bool
otx_stroll_begin(
    const otx_turk_mesh *mesh, const float *points, int32_t vertex,
    otx_vec3 heading, otx_stroll *out)
{
    const otx_level *level = mesh->level;
    otx_stroll s = {
        .mesh = mesh, .points = points, .at = otx_vec3_load(points, vertex)};
    double best = -INFINITY;

    for (int32_t i = mesh->face_first[vertex]; i < mesh->face_first[vertex + 1];
         ++i)
        for (int32_t f = 0; f < otx_facet_count(level, mesh->faces[i]); ++f)
        {
            s.facet = otx_facet_at(level, mesh->faces[i], f);
            for (int k = 0; k < 3; ++k)
            {
                double depth;

                if (level->face_verts[s.facet.corners[k]] != vertex)
                    continue;
                depth = inside(&s, k, heading, &s.heading);
                if (!(depth > best))
                    continue;
                best = depth;
                *out = s;
            }
        }
    return best > -INFINITY;
}

void
otx_stroll_turn(otx_stroll *s, double c, double sine)
{
    const otx_vec3 left =
        otx_vec3_cross(otx_vec3_unit(normal_of(s)), s->heading);

    s->heading =
        otx_vec3_add(otx_vec3_scale(c, s->heading), otx_vec3_scale(sine, left));
}

/* The side that the way leaves the facet by, and how far that is. */
static int
exit_side(const otx_stroll *s, otx_vec3 n, double *length)
{
    int side = -1;

    *length = INFINITY;
    for (int k = 0; k < 3; ++k)
    {
        const otx_vec3 a = corner(s, k);
        const otx_vec3 in =
            otx_vec3_cross(n, otx_vec3_sub(corner(s, (k + 1) % 3), a));
        const double rate = -otx_vec3_dot(s->heading, in);
        const double left = fmax(0.0, otx_vec3_dot(otx_vec3_sub(s->at, a), in));

        if (!(rate > 0.0) || !(left < *length * rate))
            continue;
        *length = left / rate;
        side = k;
    }
    return side;
}

/* Into the facet beyond a side; false where there is none. */
static bool
cross(otx_stroll *s, int side, otx_vec3 n)
{
    const otx_level *level = s->mesh->level;
    const otx_vec3 e =
        otx_vec3_unit(otx_vec3_sub(corner(s, (side + 1) % 3), corner(s, side)));
    const otx_vec3 out = otx_vec3_unit(otx_vec3_cross(e, n));
    const double along = otx_vec3_dot(s->heading, e);
    const double away = otx_vec3_dot(s->heading, out);
    const int32_t across = s->facet.across[side], face = s->facet.face;

    if (across < 0)
        s->facet = otx_facet_at(level, face, ~across);
    else
    {
        const int32_t other = otx_level_neighbour(level, face, across);
        const int32_t edge =
            level->face_edges[level->face_first[face] + across];
        int32_t k = 0;

        if (other < 0 || level->face_hole[other])
            return false;
        while (level->face_edges[level->face_first[other] + k] != edge)
            ++k;
        s->facet = otx_facet_at_edge(level, other, k, &k);
    }
    s->heading = otx_vec3_unit(otx_vec3_add(
        otx_vec3_scale(along, e),
        otx_vec3_scale(away, otx_vec3_unit(otx_vec3_cross(e, normal_of(s))))));
    return true;
}

void
otx_stroll_go(otx_stroll *s, double length)
{
    for (int32_t i = 0; i < CROSSINGS && length > 0.0 && !s->ended; ++i)
    {
        const otx_vec3 n = normal_of(s);
        double until;
        const int side = exit_side(s, n, &until);

        if (side < 0 || until >= length)
        {
            s->at = otx_vec3_add(s->at, otx_vec3_scale(length, s->heading));
            return;
        }
        s->at = otx_vec3_add(s->at, otx_vec3_scale(until, s->heading));
        length -= until;
        s->ended = !cross(s, side, n);
    }
}

otx_quad
otx_stroll_look(const otx_stroll *s, const otx_quad *values)
{
    const int32_t *verts = s->mesh->level->face_verts;
    const otx_vec3 n = normal_of(s);
    const double area = otx_vec3_dot(n, n);
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    if (!(area > 0.0))
        return values[verts[s->facet.corners[0]]];
    for (int k = 0; k < 3; ++k)
    {
        const otx_vec3 a = corner(s, (k + 1) % 3), b = corner(s, (k + 2) % 3);
        const double share =
            otx_vec3_dot(
                otx_vec3_cross(otx_vec3_sub(b, a), otx_vec3_sub(s->at, a)), n) /
            area;

        sum += values[verts[s->facet.corners[k]]] * (float)share;
    }
    return sum;
}

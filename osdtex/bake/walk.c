/* walk.c -- unfolding, one edge at a time. */
#include "bake/walk.h"

#include <string.h>

/* Rounding that is taken for inside: a point on an edge stays where it is. */
static const double EDGE = -1e-9;

/* An edge of a facet as x axis: its length, and where the third corner is. */
typedef struct hinge
{
    double length, x, y;
} hinge;

static hinge
hinge_at(const otx_surface *surface, const otx_facet *facet, int32_t side)
{
    const int32_t *verts = otx_surface_leaf(surface)->face_verts;
    const otx_vec3 a =
        otx_vec3_load(surface->points, verts[facet->corners[side]]);
    const otx_vec3 b =
        otx_vec3_load(surface->points, verts[facet->corners[(side + 1) % 3]]);
    const otx_vec3 c =
        otx_vec3_load(surface->points, verts[facet->corners[(side + 2) % 3]]);
    const otx_vec3 edge = otx_vec3_sub(b, a), arm = otx_vec3_sub(c, a);
    const double length = otx_vec3_length(edge);
    const double x = length > 0.0 ? otx_vec3_dot(arm, edge) / length : 0.0;
    const double y = length > 0.0
                         ? otx_vec3_length(otx_vec3_cross(edge, arm)) / length
                         : 0.0;

    return (hinge){length, x, y};
}

/* Barycentric coordinates (or their changes, whose sum is 0) from one side of
 * an edge to the other. The edge runs backwards over there. */
static void
turn_over(
    hinge from, int32_t side, hinge to, int32_t to_side, double sum,
    double values[3])
{
    const double b = values[(side + 1) % 3], c = values[(side + 2) % 3];
    const double x = b * from.length + c * from.x;
    const double apex = -c * from.y / to.y;
    /* The third corner over there, from the same end of the edge. */
    const double along = from.length - to.x;
    const double far = (x - apex * along) / from.length;

    values[to_side] = far;
    values[(to_side + 1) % 3] = sum - far - apex;
    values[(to_side + 2) % 3] = apex;
}

/* The facet across a side, and which of its sides that is. */
static bool
neighbour_of(
    const otx_level *leaf, const uint8_t *covered, const otx_facet *facet,
    int32_t side, otx_facet *out, int32_t *out_side)
{
    const int32_t across = facet->across[side];

    if (across < 0)
    {
        *out = otx_facet_at(leaf, facet->face, ~across);
        *out_side = otx_facet_side(out, ~facet->index);
        return true;
    }

    const int32_t edge =
        leaf->face_edges[leaf->face_first[facet->face] + across];
    const int32_t face = otx_level_neighbour(leaf, facet->face, across);

    if (face < 0 || !covered[face])
        return false;
    for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
        if (leaf->face_edges[leaf->face_first[face] + k] == edge)
        {
            *out = otx_facet_at_edge(leaf, face, k, out_side);
            return true;
        }
    return false;
}

bool
otx_walk_cross(
    const otx_surface *surface, const uint8_t *covered, int32_t side,
    otx_walk *walk)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_facet next;
    int32_t to_side;

    if (!neighbour_of(leaf, covered, &walk->facet, side, &next, &to_side))
        return false;

    const hinge from = hinge_at(surface, &walk->facet, side);
    const hinge to = hinge_at(surface, &next, to_side);

    /* A facet without area cannot be unfolded. */
    if (!(from.length > 0.0) || !(to.y > 1e-6 * to.length))
        return false;
    turn_over(from, side, to, to_side, 1.0, walk->at);
    turn_over(from, side, to, to_side, 0.0, walk->dx);
    turn_over(from, side, to, to_side, 0.0, walk->dy);
    walk->facet = next;
    return true;
}

/* Moves the place to the nearest point on the line of a side. */
static void
hold(const otx_surface *surface, int32_t side, otx_walk *walk)
{
    const hinge h = hinge_at(surface, &walk->facet, side);
    const int32_t b = (side + 1) % 3, c = (side + 2) % 3;

    if (h.length > 0.0)
        walk->at[b] += walk->at[c] * h.x / h.length;
    walk->at[c] = 0.0;
    walk->at[side] = 1.0 - walk->at[b];
}

int32_t
otx_walk_side_beyond(const double at[3])
{
    const int32_t low =
        at[0] <= at[1] ? (at[0] <= at[2] ? 0 : 2) : (at[1] <= at[2] ? 1 : 2);

    /* Written so that NaN is inside. */
    return at[low] < EDGE ? (low + 1) % 3 : -1;
}

static void
clamp(double at[3])
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        at[k] = at[k] > 0.0 ? at[k] : 0.0;
        sum += at[k];
    }
    for (int k = 0; k < 3; ++k)
        at[k] = sum > 0.0 ? at[k] / sum : 1.0 / 3.0;
}

bool
otx_walk_on(
    const otx_surface *surface, const uint8_t *covered, int32_t steps,
    otx_walk *walk)
{
    for (int32_t i = 0; i < steps; ++i)
    {
        const int32_t side = otx_walk_side_beyond(walk->at);

        if (side < 0)
            return true;
        if (!otx_walk_cross(surface, covered, side, walk))
            hold(surface, side, walk);
    }
    if (otx_walk_side_beyond(walk->at) < 0)
        return true;
    clamp(walk->at);
    return false;
}

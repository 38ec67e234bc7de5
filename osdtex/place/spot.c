/* spot.c -- a point on the surface, as those who place something name it. */
#include "place/spot.h"

#include "surface/closest.h"

static otx_vec3
mix(const otx_vec3 t[3], const double at[3])
{
    const otx_vec3 ab = otx_vec3_mix(at[0], t[0], at[1], t[1]);

    return otx_vec3_mix(1.0, ab, at[2], t[2]);
}

/* Takes the point of a facet that is nearest to p where it is nearer than the
 * spot. */
static void
look_at(
    const otx_surface *surface, const otx_facet *facet, otx_vec3 p,
    otx_spot *spot)
{
    otx_vec3 t[3];
    double at[3], distance;

    otx_closest_corners(surface, facet->corners, t);
    distance = otx_closest_on(p, t, at);
    if (distance < spot->distance)
        *spot = (otx_spot){
            facet->face,
            {facet->corners[0], facet->corners[1], facet->corners[2]},
            {at[0], at[1], at[2]},
            mix(t, at),
            distance};
}

static otx_spot
nearest_within(
    const otx_surface *surface, int32_t first, int32_t end, otx_vec3 point)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_spot spot = {.face = -1, .distance = (double)INFINITY};

    for (int32_t f = first; f < end; ++f)
        for (int32_t i = 0; !leaf->face_hole[f] && i < otx_facet_count(leaf, f);
             ++i)
        {
            const otx_facet facet = otx_facet_at(leaf, f, i);

            look_at(surface, &facet, point, &spot);
        }
    return spot;
}

otx_spot
otx_spot_nearest(const otx_surface *surface, otx_vec3 point)
{
    return nearest_within(
        surface, 0, otx_surface_leaf(surface)->face_count, point);
}

/* Mean of the corners of all leaves, weighted by how often they are there. */
static otx_vec3
middle_of(const otx_surface *surface, int32_t first, int32_t end)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t begin = leaf->face_first[first];
    const int32_t count = leaf->face_first[end] - begin;
    otx_vec3 sum = {0, 0, 0};

    for (int32_t i = 0; i < count; ++i)
        sum = otx_vec3_add(
            sum, otx_vec3_load(surface->points, leaf->face_verts[begin + i]));
    return otx_vec3_scale(1.0 / (count > 0 ? count : 1), sum);
}

otx_spot
otx_spot_of_face(const otx_surface *surface, int32_t cage_face)
{
    otx_spot spot;
    int32_t first, end;

    otx_surface_leaves(surface, 0, cage_face, &first, &end);
    spot = nearest_within(surface, first, end, middle_of(surface, first, end));
    spot.distance = 0.0;
    return spot;
}

otx_spot
otx_spot_within(const otx_surface *surface, int32_t face, const double by[2])
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t count = otx_facet_count(leaf, face);
    const double which = by[0] * count;
    const int32_t index = (int32_t)fmin(floor(which), count - 1);
    const otx_facet facet = otx_facet_at(leaf, face, index);
    const double s = sqrt(which - index);
    otx_spot spot = {
        .face = face,
        .corners = {facet.corners[0], facet.corners[1], facet.corners[2]},
        .at = {1.0 - s, s * (1.0 - by[1]), s * by[1]}};
    otx_vec3 t[3];

    otx_closest_corners(surface, spot.corners, t);
    spot.point = mix(t, spot.at);
    return spot;
}

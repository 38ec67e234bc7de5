/* framing.c -- the nearest camera that sees everything.
 *
 * With right r, up u, forward f and the tangents kx, ky of the half-angles, a
 * point p is in the picture of an eye e where
 *
 *     +-(p - e) . r <= kx (p - e) . f        and the same of u and ky.
 *
 * Each of the four is a half-space of directions n = +-r - kx f, and only the
 * point that is farthest along n counts: four maxima over the points give the
 * eye in closed form. For every turn about an axis, a point is its circle,
 * whose farthest along n is its distance from the axis times the length of n
 * across it, plus its height times that of n along it. */
#include "render/framing.h"

#include <float.h>

/* Of the half-angles, what the model may fill. */
static const double FILLED = 0.94;
/* Of the radius, the least from the eye to the nearest point. */
static const double NEAREST = 0.1;

/* The farthest of what is drawn along each of a few directions. */
typedef struct extent
{
    otx_vec3 along[5];
    double most[5];
} extent;

static double
reach_of(otx_vec3 p, otx_vec3 n, const otx_vec3 *axis)
{
    double height, slope;

    if (!axis)
        return otx_vec3_dot(p, n);
    height = otx_vec3_dot(p, *axis);
    slope = otx_vec3_dot(n, *axis);
    return height * slope +
           otx_vec3_length(otx_vec3_mix(1.0, p, -height, *axis)) *
               otx_vec3_length(otx_vec3_mix(1.0, n, -slope, *axis));
}

/* Points are taken from `centre`; `axis` NULL where nothing turns. */
static void
measure(
    const otx_scene *scene, otx_vec3 centre, const otx_vec3 *axis, extent *out)
{
    for (int k = 0; k < 5; ++k)
        out->most[k] = -DBL_MAX;
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        if (otx_scene_is_hole(scene, f))
            continue;
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
        {
            const otx_vec3 p = otx_vec3_sub(
                otx_vec3_load(scene->points, scene->face_verts[c]), centre);

            for (int k = 0; k < 5; ++k)
                out->most[k] =
                    fmax(out->most[k], reach_of(p, out->along[k], axis));
        }
    }
}

otx_camera
otx_framing_camera(const otx_scene *scene, const otx_framing *framing)
{
    const otx_vec3 from =
        otx_camera_from(framing->view, framing->up, framing->turn);
    const otx_vec3 axis = otx_camera_up(framing->up);
    otx_camera camera = {
        from, {0.0, 0.0, 0.0}, OTX_CAMERA_FOV, 0.0, framing->up};
    const otx_camera_frame frame = otx_camera_aim(&camera, 1, 1);
    const otx_vec3 r = otx_vec3_unit(frame.right), u = otx_vec3_unit(frame.up);
    const double ky = FILLED * tan(0.5 * OTX_CAMERA_FOV);
    const double kx = ky * framing->aspect;
    extent e = {
        .along = {
            otx_vec3_mix(1.0, r, kx, from), otx_vec3_mix(-1.0, r, kx, from),
            otx_vec3_mix(1.0, u, ky, from), otx_vec3_mix(-1.0, u, ky, from),
            from}};
    otx_vec3 centre;
    double radius, back;

    otx_scene_bounds(scene, &centre, &radius);
    radius = radius > 0.0 ? radius : 1.0;
    measure(scene, centre, framing->orbit ? &axis : NULL, &e);
    /* As far back as the wider of the two needs, and clear of the nearest. */
    back = fmax(
        (e.most[0] + e.most[1]) / (2.0 * kx),
        (e.most[2] + e.most[3]) / (2.0 * ky));
    back = fmax(back, e.most[4] + NEAREST * radius);
    camera.target = otx_vec3_add(
        centre, otx_vec3_mix(
                    0.5 * (e.most[0] - e.most[1]), r,
                    0.5 * (e.most[2] - e.most[3]), u));
    camera.eye = otx_vec3_mix(1.0, camera.target, back, from);
    return camera;
}

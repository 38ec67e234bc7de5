/* stretch.c -- singular values of a triangle's map to the plane.
 *
 * With the triangle laid out isometrically in its own plane (q) the map is a
 * 2 x 2 matrix J; its singular values come from the closed form for 2 x 2
 * matrices by splitting J into a similarity and an anti-similarity part. */
#include "flatten/stretch.h"

void
otx_stretch_layout(const otx_vec3 p[3], otx_vec2 q[3])
{
    const otx_vec3 a = otx_vec3_sub(p[1], p[0]);
    const otx_vec3 b = otx_vec3_sub(p[2], p[0]);
    const double length = otx_vec3_length(a);
    const otx_vec3 x = otx_vec3_unit(a);

    q[0] = (otx_vec2){0.0, 0.0};
    q[1] = (otx_vec2){length, 0.0};
    q[2] =
        (otx_vec2){otx_vec3_dot(b, x), otx_vec3_length(otx_vec3_cross(x, b))};
}

void
otx_stretch_singular(const otx_vec3 p[3], const otx_vec2 uv[3], double sigma[2])
{
    const otx_vec2 u = otx_vec2_sub(uv[1], uv[0]);
    const otx_vec2 v = otx_vec2_sub(uv[2], uv[0]);
    otx_vec2 q[3], x, y;
    double similar, opposite;

    otx_stretch_layout(p, q);
    if (!(q[1].x > 0.0) || !(q[2].y > 0.0))
    {
        sigma[0] = sigma[1] = 1.0;
        return;
    }
    /* Columns of J: images of the unit vectors. */
    x = otx_vec2_scale(1.0 / q[1].x, u);
    y = otx_vec2_scale(
        1.0 / q[2].y, otx_vec2_sub(v, otx_vec2_scale(q[2].x, x)));
    similar = 0.5 * hypot(x.x + y.y, x.y - y.x);
    opposite = 0.5 * hypot(x.x - y.y, x.y + y.x);
    sigma[0] = similar + opposite;
    sigma[1] = similar - opposite;
}

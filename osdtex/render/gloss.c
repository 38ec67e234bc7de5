/* gloss.c -- how much a rough surface mirrors of a light. */
#include "render/gloss.h"

static const double ROUGHNESS_MIN = 0.05;

static double
alpha_of(double roughness)
{
    const double r = fmin(fmax(roughness, ROUGHNESS_MIN), 1.0);

    return r * r;
}

otx_gloss
otx_gloss_light(otx_vec3 normal, otx_vec3 to, otx_vec3 eye, double roughness)
{
    const double a_sq = alpha_of(roughness) * alpha_of(roughness);
    const double nl = otx_vec3_dot(normal, to);
    const double nv = fmax(otx_vec3_dot(normal, eye), 1e-3);
    const otx_vec3 half = otx_vec3_unit(otx_vec3_add(to, eye));
    const double nh = otx_vec3_dot(normal, half);
    const double b = nh * nh * (a_sq - 1.0) + 1.0;

    if (!(nl > 0.0))
        return (otx_gloss){0.0, 0.0};

    /* Both without the pi that a matte surface divides by. */
    const double masked = nl * sqrt(nv * nv * (1.0 - a_sq) + a_sq) +
                          nv * sqrt(nl * nl * (1.0 - a_sq) + a_sq);
    const double all = 0.5 * a_sq / (b * b) / masked * nl;
    const double fresnel = pow(1.0 - fmax(otx_vec3_dot(eye, half), 0.0), 5.0);

    return (otx_gloss){all * (1.0 - fresnel), all * fresnel};
}

/* Polynomials in the roughness r and the cosine v, fitted to the integral over
 * all lights: what is mirrored of F0 1, and the part of it that is grazing. */
otx_gloss
otx_gloss_sky(otx_vec3 normal, otx_vec3 eye, double roughness)
{
    const double r = fmin(fmax(roughness, ROUGHNESS_MIN), 1.0), r_sq = r * r;
    const double v = fmin(fmax(otx_vec3_dot(normal, eye), 0.0), 1.0);
    const double q = 1.0 - v, q_3 = q * q * q;
    const double lost =
        r_sq * (1.915 - 3.976 * r + 2.178 * r_sq +
                v * (-2.689 + 9.029 * r - 5.077 * r_sq) - 0.735 * v * v);
    const double all = fmin(fmax(1.0 - lost, 0.0), 1.0);
    const double grazing = q_3 * q * q * (1.129 - 4.041 * r + 3.197 * r_sq) +
                           q_3 * r * (1.468 - 1.683 * r) +
                           q * r_sq * (0.2588 * r - 0.2185);
    const double part = fmin(fmax(grazing, 0.0), all);

    return (otx_gloss){all - part, part};
}

otx_vec3
otx_gloss_direction(otx_vec3 normal, otx_vec3 eye, double roughness)
{
    const otx_vec3 mirrored =
        otx_vec3_mix(2.0 * otx_vec3_dot(normal, eye), normal, -1.0, eye);
    const double a = alpha_of(roughness);

    return otx_vec3_mix(1.0 - a, mirrored, a * 2.0 / 3.0, normal);
}

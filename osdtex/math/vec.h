/* vec.h -- two and three doubles.
 *
 * Arrays of positions are stored as float, three to a point; arithmetic is in
 * double: `otx_vec3_load` is the gate between the two. */
#ifndef OTX_MATH_VEC_H
#define OTX_MATH_VEC_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef struct otx_vec2
{
    double x, y;
} otx_vec2;

typedef struct otx_vec3
{
    double x, y, z;
} otx_vec3;

static inline otx_vec2
otx_vec2_add(otx_vec2 a, otx_vec2 b)
{
    return (otx_vec2){a.x + b.x, a.y + b.y};
}

static inline otx_vec2
otx_vec2_sub(otx_vec2 a, otx_vec2 b)
{
    return (otx_vec2){a.x - b.x, a.y - b.y};
}

static inline otx_vec2
otx_vec2_scale(double s, otx_vec2 a)
{
    return (otx_vec2){s * a.x, s * a.y};
}

static inline double
otx_vec2_dot(otx_vec2 a, otx_vec2 b)
{
    return a.x * b.x + a.y * b.y;
}

/* z of the cross product: twice the signed area of (0, a, b). */
static inline double
otx_vec2_cross(otx_vec2 a, otx_vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

static inline double
otx_vec2_length(otx_vec2 a)
{
    return sqrt(otx_vec2_dot(a, a));
}

/* a + t (b - a) */
static inline otx_vec2
otx_vec2_lerp(otx_vec2 a, otx_vec2 b, double t)
{
    return (otx_vec2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* Complex product: rotates and scales b by a. */
static inline otx_vec2
otx_vec2_mul(otx_vec2 a, otx_vec2 b)
{
    return (otx_vec2){a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

static inline otx_vec2
otx_vec2_polar(double angle)
{
    return (otx_vec2){cos(angle), sin(angle)};
}

/* Position `index` of an array of three floats each. */
static inline otx_vec3
otx_vec3_load(const float *positions, int32_t index)
{
    const float *p = positions + 3 * (size_t)index;

    return (otx_vec3){p[0], p[1], p[2]};
}

static inline otx_vec3
otx_vec3_add(otx_vec3 a, otx_vec3 b)
{
    return (otx_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline otx_vec3
otx_vec3_sub(otx_vec3 a, otx_vec3 b)
{
    return (otx_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline otx_vec3
otx_vec3_scale(double s, otx_vec3 a)
{
    return (otx_vec3){s * a.x, s * a.y, s * a.z};
}

/* s a + t b */
static inline otx_vec3
otx_vec3_mix(double s, otx_vec3 a, double t, otx_vec3 b)
{
    return (otx_vec3){s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

static inline double
otx_vec3_dot(otx_vec3 a, otx_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline otx_vec3
otx_vec3_cross(otx_vec3 a, otx_vec3 b)
{
    return (otx_vec3){
        a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double
otx_vec3_length(otx_vec3 a)
{
    return sqrt(otx_vec3_dot(a, a));
}

/* a / |a|; zero stays zero. */
static inline otx_vec3
otx_vec3_unit(otx_vec3 a)
{
    const double length = otx_vec3_length(a);

    return length > 0.0 ? otx_vec3_scale(1.0 / length, a) : a;
}

#endif

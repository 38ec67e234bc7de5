/* attract.c -- what pulls a whole field: an axis, edge loops, curvature. */
#include "field/attract.h"

static otx_status
make(otx_run *run, const otx_connection *c, otx_vec2 **out)
{
    *out = OTX_ZNEW(run->arena, otx_vec2, c->level->face_count);
    return otx_run_ok(run);
}

otx_status
otx_attract_axis(
    otx_run *run, const otx_connection *c, int32_t symmetry, otx_vec3 axis,
    otx_vec2 **out)
{
    OTX_TRY(make(run, c, out));
    for (int32_t f = 0; f < c->level->face_count; ++f)
        (*out)[f] = otx_direction_power(
            otx_connection_project(c, f, otx_vec3_unit(axis)), symmetry);
    return OSDTEX_OK;
}

/* -- edges --------------------------------------------------------------- */

/* Of four ways, a quarter turn or so apart, the one nearest to `d`. */
static otx_vec2
nearest_way(const otx_vec2 ways[4], otx_vec2 d)
{
    int best = 0;

    for (int k = 1; k < 4; ++k)
        if (otx_vec2_dot(ways[k], d) > otx_vec2_dot(ways[best], d))
            best = k;
    return ways[best];
}

static otx_vec2
unit(otx_vec2 v)
{
    const double length = otx_vec2_length(v);

    return length > 0.0 ? otx_vec2_scale(1.0 / length, v) : v;
}

/* The pull of the edges of a quad: opposite ones are averaged. */
static otx_vec2
quad_pull(
    const otx_connection *c, int32_t face, int32_t symmetry,
    const otx_direction *near)
{
    const otx_vec2 *sides = c->sides + c->level->face_first[face];
    const otx_vec2 a = unit(otx_vec2_sub(sides[0], sides[2]));
    const otx_vec2 b = unit(otx_vec2_sub(sides[1], sides[3]));
    const otx_vec2 ways[4] = {
        a, b, otx_vec2_scale(-1.0, a), otx_vec2_scale(-1.0, b)};

    if (symmetry == 4)
        return otx_vec2_scale(
            0.5,
            otx_vec2_add(otx_direction_power(a, 4), otx_direction_power(b, 4)));
    return otx_direction_power(
        nearest_way(ways, otx_vec2_polar(otx_direction_angle(near, face))),
        symmetry);
}

otx_status
otx_attract_edges(
    otx_run *run, const otx_connection *c, int32_t symmetry,
    const otx_direction *near, otx_vec2 **out)
{
    OTX_TRY(make(run, c, out));
    for (int32_t f = 0; f < c->level->face_count; ++f)
        if (otx_level_face_size(c->level, f) == 4 && !c->level->face_hole[f])
            (*out)[f] = quad_pull(c, f, symmetry, near);
    return OSDTEX_OK;
}

/* -- curvature ----------------------------------------------------------- */

/* A symmetric matrix [a b; b d]. */
typedef struct shape
{
    double a, b, d;
} shape;

/* How the normal changes along the face's sides: S e = dn in the least squares
 * sense. The normal equations of (a, b, d) are solved by elimination. */
static bool
fit_shape(const otx_connection *c, int32_t face, shape *out)
{
    const otx_level *level = c->level;
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    double xx = 0, xy = 0, yy = 0, xu = 0, yv = 0, cross = 0;

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec2 e = c->sides[first + k];
        const otx_vec3 n0 =
            otx_vec3_load(c->surface->normals, level->face_verts[first + k]);
        const otx_vec3 n1 = otx_vec3_load(
            c->surface->normals, level->face_verts[first + (k + 1) % size]);
        const otx_vec2 dn =
            otx_connection_project(c, face, otx_vec3_sub(n1, n0));

        xx += e.x * e.x;
        xy += e.x * e.y;
        yy += e.y * e.y;
        xu += e.x * dn.x;
        yv += e.y * dn.y;
        cross += e.y * dn.x + e.x * dn.y;
    }

    /* [xx xy 0; xy xx+yy xy; 0 xy yy] (a, b, d) = (xu, cross, yv) */
    const double scale = xx + yy;

    if (!(xx * yy - xy * xy > 1e-6 * scale * scale))
        return false;
    out->b = (cross - xy * xu / xx - xy * yv / yy) /
             (scale - xy * xy / xx - xy * xy / yy);
    out->a = (xu - xy * out->b) / xx;
    out->d = (yv - xy * out->b) / yy;
    return isfinite(out->a) && isfinite(out->b) && isfinite(out->d);
}

/* The square of the direction of least bending, as long as it is sure. */
static otx_vec2
least_bending(const otx_connection *c, int32_t face)
{
    const double flat = 1.0 / c->surface->cage->diagonal;
    double mean, half, length;
    otx_vec2 square;
    shape s;

    if (!fit_shape(c, face, &s))
        return (otx_vec2){0, 0};
    mean = 0.5 * (s.a + s.d);
    square = (otx_vec2){0.5 * (s.a - s.d), s.b};
    half = otx_vec2_length(square);
    length = half + fabs(mean);
    if (!(half > 0.0))
        return (otx_vec2){0, 0};
    /* `square` points to the larger of mean + half and mean - half; bending
     * is their size, whatever the sign. */
    return otx_vec2_scale(
        (mean > 0.0 ? -1.0 : 1.0) / (length + flat) *
            fmin(1.0, 2.0 * fabs(mean) / half),
        square);
}

otx_status
otx_attract_curvature(
    otx_run *run, const otx_connection *c, int32_t symmetry,
    const otx_direction *near, otx_vec2 **out)
{
    OTX_TRY(make(run, c, out));
    for (int32_t f = 0; f < c->level->face_count; ++f)
    {
        const otx_vec2 square = least_bending(c, f);
        const double length = otx_vec2_length(square);
        const otx_vec2 line = otx_vec2_polar(0.5 * atan2(square.y, square.x));
        const otx_vec2 ways[4] = {line, otx_vec2_scale(-1.0, line), line, line};

        if (c->level->face_hole[f] || !(length > 0.0))
            continue;
        (*out)[f] = otx_vec2_scale(
            length,
            symmetry == 1
                ? nearest_way(
                      ways, otx_vec2_polar(otx_direction_angle(near, f)))
                : otx_direction_power(line, symmetry));
    }
    return OSDTEX_OK;
}

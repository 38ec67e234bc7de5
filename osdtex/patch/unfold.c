/* unfold.c -- no face of a finished mapping is turned inside out.
 *
 * Cut and relaxation never reverse a triangle, but a quad has four corners and
 * two triangles, and where the surface is creased to nothing one corner may
 * still be reversed. Such a face becomes a patch of its own: it takes its own
 * shape, flat, turned and scaled to fit best where it was. */
#include "patch/unfold.h"
#include "cluster/dual.h"
#include "patch/given_patches.h"
#include "surface/limit.h"

enum
{
    SIZE_MAX_HERE = 16 /* corners; larger faces are left as they are */
};

/* Largest factor by which the face may be smaller or larger than asked for. */
static const double SCALE_MAX = 2.0;

typedef struct sheet
{
    int32_t size;
    otx_vec2 p[SIZE_MAX_HERE]; /* in the plane of the face, texels */
    otx_vec2 q[SIZE_MAX_HERE]; /* UV, texels */
} sheet;

static double
corner_cross(const otx_vec2 *at, int32_t size, int32_t k)
{
    const otx_vec2 here = at[k];

    return otx_vec2_cross(
        otx_vec2_sub(at[(k + 1) % size], here),
        otx_vec2_sub(at[(k + size - 1) % size], here));
}

/* Both sheets about their middles; that of the UVs is given. */
static void
read_sheet(
    const otx_mosaic_job *job, const otx_cover *cover, int32_t face, sheet *s,
    otx_vec2 *middle)
{
    const otx_level *leaf = job->leaves.level;
    const int32_t first = leaf->face_first[face];
    otx_vec3 centre, x, y, n;
    otx_vec2 mean = {0, 0};

    s->size = otx_level_face_size(leaf, face);
    n = otx_vec3_unit(otx_dual_leaf_area(job->surface, face, &centre));
    x = fabs(n.x) < 0.6 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0};
    x = otx_vec3_unit(otx_vec3_mix(1.0, x, -otx_vec3_dot(x, n), n));
    y = otx_vec3_cross(n, x);
    *middle = (otx_vec2){0, 0};
    for (int32_t k = 0; k < s->size; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(job->surface->points, leaf->face_verts[first + k]),
            centre);

        s->p[k] = otx_vec2_scale(
            job->texels, (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)});
        s->q[k] = cover->uvs[first + k];
        mean = otx_vec2_add(mean, otx_vec2_scale(1.0 / s->size, s->p[k]));
        *middle = otx_vec2_add(*middle, otx_vec2_scale(1.0 / s->size, s->q[k]));
    }
    for (int32_t k = 0; k < s->size; ++k)
    {
        s->p[k] = otx_vec2_sub(s->p[k], mean);
        s->q[k] = otx_vec2_sub(s->q[k], *middle);
    }
}

/* Whether a corner that the surface has convex, or all of it, is reversed. */
static bool
is_folded(const sheet *s)
{
    double area = 0.0;

    for (int32_t k = 0; k < s->size; ++k)
    {
        if (corner_cross(s->p, s->size, k) > 0.0 &&
            corner_cross(s->q, s->size, k) < 0.0)
            return true;
        area += otx_vec2_cross(s->q[k], s->q[(k + 1) % s->size]);
    }
    return !(area > 0.0);
}

/* Turns and scales the flat face onto its UVs. */
static void
fit_sheet(sheet *s)
{
    otx_vec2 turn = {0, 0};
    double square = 0.0, scale;

    for (int32_t k = 0; k < s->size; ++k)
    {
        turn.x += otx_vec2_dot(s->p[k], s->q[k]);
        turn.y += otx_vec2_cross(s->p[k], s->q[k]);
        square += otx_vec2_dot(s->p[k], s->p[k]);
    }
    scale = otx_vec2_length(turn) / fmax(square, 1e-30);
    turn = scale > 0.0 ? otx_vec2_scale(1.0 / otx_vec2_length(turn), turn)
                       : (otx_vec2){1, 0};
    scale = fmin(fmax(scale, 1.0 / SCALE_MAX), SCALE_MAX);
    for (int32_t k = 0; k < s->size; ++k)
        s->q[k] = otx_vec2_mul(otx_vec2_scale(scale, turn), s->p[k]);
}

/* Moves the middle so that no corner leaves a picture that ends. */
static double
kept_inside(double middle, double low, double high, double side)
{
    return fmin(fmax(middle, -low), side - high);
}

static otx_vec2
place_sheet(const otx_exemplar *e, const sheet *s, otx_vec2 middle)
{
    otx_vec2 low = {0, 0}, high = {0, 0};

    for (int32_t k = 0; k < s->size; ++k)
    {
        low = (otx_vec2){fmin(low.x, s->q[k].x), fmin(low.y, s->q[k].y)};
        high = (otx_vec2){fmax(high.x, s->q[k].x), fmax(high.y, s->q[k].y)};
    }
    if (!e->wrap_x)
        middle.x = kept_inside(middle.x, low.x, high.x, e->match.width);
    if (!e->wrap_y)
        middle.y = kept_inside(middle.y, low.y, high.y, e->match.height);
    return middle;
}

void
otx_unfold(const otx_mosaic_job *job, otx_cover *cover)
{
    const otx_level *leaf = job->leaves.level;

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        otx_vec2 middle;
        int32_t supply;
        sheet s;

        if (cover->face_patch[f] < 0 || otx_given_holds(job, f) ||
            otx_level_face_size(leaf, f) > SIZE_MAX_HERE ||
            otx_limit_face_is_flat(leaf, job->surface->points, f))
            continue;
        read_sheet(job, cover, f, &s, &middle);
        if (!is_folded(&s))
            continue;
        fit_sheet(&s);
        supply = otx_cover_exemplar(cover, cover->face_patch[f]);
        middle = place_sheet(&job->exemplars[supply], &s, middle);
        for (int32_t k = 0; k < s.size; ++k)
            cover->uvs[leaf->face_first[f] + k] = otx_vec2_add(middle, s.q[k]);
        if (cover->patch_exemplar)
            cover->patch_exemplar[cover->patch_count] = (uint8_t)supply;
        cover->face_patch[f] = cover->patch_count++;
    }
}

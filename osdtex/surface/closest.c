/* closest.c -- the point of a surface that is nearest to another one. */
#include "surface/closest.h"

#include <stdlib.h>

static const char STAGE[] = "closest";

enum
{
    BUCKET = 4,     /* faces */
    AXIS_BITS = 21, /* of a place on the curve */
    DEPTH = 32      /* of the tree, at most */
};

/* Of the angle up to which a facet counts as turned the same way. */
static const double COSINE = 0.5;

/* ---- points and triangles ---- */

static otx_vec3
mix(const otx_vec3 t[3], const double at[3])
{
    const otx_vec3 ab = otx_vec3_mix(at[0], t[0], at[1], t[1]);

    return otx_vec3_mix(1.0, ab, at[2], t[2]);
}

/* The nearest point of a side, as the share of its end. */
static double
along_side(otx_vec3 p, otx_vec3 a, otx_vec3 b)
{
    const otx_vec3 d = otx_vec3_sub(b, a);
    const double t =
        otx_vec3_dot(otx_vec3_sub(p, a), d) / fmax(otx_vec3_dot(d, d), 1e-300);

    return fmin(fmax(t, 0.0), 1.0);
}

bool
otx_closest_below(otx_vec3 p, const otx_vec3 t[3], double at[3])
{
    const otx_vec3 a = otx_vec3_sub(t[1], t[0]), b = otx_vec3_sub(t[2], t[0]);
    const otx_vec3 n = otx_vec3_cross(a, b), d = otx_vec3_sub(p, t[0]);
    const double area = otx_vec3_dot(n, n);

    if (!(area > 0.0))
        return false;
    at[1] = otx_vec3_dot(otx_vec3_cross(d, b), n) / area;
    at[2] = otx_vec3_dot(otx_vec3_cross(a, d), n) / area;
    at[0] = 1.0 - at[1] - at[2];
    return true;
}

double
otx_closest_on(otx_vec3 p, const otx_vec3 t[3], double at[3])
{
    double best = (double)INFINITY;

    if (otx_closest_below(p, t, at) && at[0] >= 0.0 && at[1] >= 0.0 &&
        at[2] >= 0.0)
        return otx_vec3_length(otx_vec3_sub(mix(t, at), p));
    for (int side = 0; side < 3; ++side)
    {
        const double share = along_side(p, t[side], t[(side + 1) % 3]);
        double there[3] = {0.0, 0.0, 0.0};
        double distance;

        there[side] = 1.0 - share;
        there[(side + 1) % 3] = share;
        distance = otx_vec3_length(otx_vec3_sub(mix(t, there), p));
        if (distance < best)
        {
            best = distance;
            for (int k = 0; k < 3; ++k)
                at[k] = there[k];
        }
    }
    return best;
}

/* ---- the tree ---- */

typedef struct curve_place
{
    uint64_t key;
    int32_t face;
    int32_t reserved;
} curve_place;

static int
by_place(const void *a, const void *b)
{
    const curve_place *x = a, *y = b;

    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

/* Spreads the low bits of a number to every third. */
static uint64_t
spread(uint64_t x)
{
    uint64_t out = 0;

    for (int bit = 0; bit < AXIS_BITS; ++bit)
        out |= (x >> bit & 1u) << 3 * bit;
    return out;
}

static void
grow(float box[6], const float *point)
{
    for (int k = 0; k < 3; ++k)
    {
        box[k] = fminf(box[k], point[k]);
        box[3 + k] = fmaxf(box[3 + k], point[k]);
    }
}

static void
empty(float box[6])
{
    for (int k = 0; k < 3; ++k)
    {
        box[k] = HUGE_VALF;
        box[3 + k] = -HUGE_VALF;
    }
}

static void
grow_by_face(const otx_surface *surface, int32_t face, float box[6])
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        grow(box, surface->points + 3 * (size_t)leaf->face_verts[c]);
}

static uint64_t
key_of(const otx_surface *surface, int32_t face, const float all[6])
{
    float box[6];
    uint64_t key = 0;

    empty(box);
    grow_by_face(surface, face, box);
    for (int k = 0; k < 3; ++k)
    {
        const double middle = 0.5 * ((double)box[k] + (double)box[3 + k]);
        const double size = (double)all[3 + k] - (double)all[k];
        const double share = size > 0.0 ? (middle - (double)all[k]) / size : 0;

        key |= spread((uint64_t)(share * ((1 << AXIS_BITS) - 1))) << k;
    }
    return key;
}

static otx_status
sort_faces(otx_run *run, const otx_surface *surface, otx_closest *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    curve_place *places = OTX_NEW(run->scratch, curve_place, leaf->face_count);
    int32_t *faces = OTX_NEW(run->arena, int32_t, leaf->face_count);
    float all[6];

    OTX_TRY(otx_run_ok(run));
    empty(all);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        grow_by_face(surface, f, all);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f])
            places[out->face_count++] =
                (curve_place){key_of(surface, f, all), f, 0};
    qsort(places, (size_t)out->face_count, sizeof *places, by_place);
    for (int32_t i = 0; i < out->face_count; ++i)
        faces[i] = places[i].face;
    out->faces = faces;
    return OSDTEX_OK;
}

static void
fill_boxes(const otx_closest *tree, float *boxes)
{
    for (int32_t n = 0; n < 2 * tree->bucket_count; ++n)
        empty(boxes + 6 * (size_t)n);
    for (int32_t i = 0; i < tree->face_count; ++i)
        grow_by_face(
            tree->surface, tree->faces[i],
            boxes + 6 * (size_t)(tree->bucket_count + i / BUCKET));
    for (int32_t n = tree->bucket_count - 1; n > 0; --n)
        for (int32_t child = 2 * n; child < 2 * n + 2; ++child)
        {
            const float *from = boxes + 6 * (size_t)child;

            grow(boxes + 6 * (size_t)n, from);
            grow(boxes + 6 * (size_t)n, from + 3);
        }
}

otx_status
otx_closest_build(otx_run *run, const otx_surface *surface, otx_closest *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    float *boxes;

    *out = (otx_closest){.surface = surface, .bucket_count = 1};
    OTX_TRY(sort_faces(run, surface, out));
    while ((int64_t)out->bucket_count * BUCKET < out->face_count)
        out->bucket_count *= 2;
    boxes = OTX_NEW(run->arena, float, 12 * (size_t)out->bucket_count);
    if (!boxes)
        return otx_fail_memory(run, STAGE);
    fill_boxes(out, boxes);
    out->boxes = boxes;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* ---- asking ---- */

/* Distance of a point from a box; infinite where that is empty. */
static double
away(const otx_closest *tree, int32_t node, otx_vec3 p)
{
    const float *box = tree->boxes + 6 * (size_t)node;
    const double at[3] = {p.x, p.y, p.z};
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        const double d =
            fmax(fmax((double)box[k] - at[k], at[k] - (double)box[3 + k]), 0.0);

        sum += d * d;
    }
    return sqrt(sum);
}

static bool
is_turned_away(const otx_vec3 t[3], otx_vec3 normal)
{
    const otx_vec3 n =
        otx_vec3_cross(otx_vec3_sub(t[1], t[0]), otx_vec3_sub(t[2], t[0]));

    return otx_vec3_dot(n, normal) <
           COSINE * otx_vec3_length(n) * otx_vec3_length(normal);
}

static void
look_at_face(
    const otx_closest *tree, const otx_closest_ask *ask, int32_t face,
    otx_closest_place *best)
{
    const otx_level *leaf = otx_surface_leaf(tree->surface);

    for (int32_t i = 0; i < otx_facet_count(leaf, face); ++i)
    {
        const otx_facet facet = otx_facet_at(leaf, face, i);
        otx_vec3 t[3];
        double at[3], distance;

        otx_closest_corners(tree->surface, facet.corners, t);
        if (is_turned_away(t, ask->normal))
            continue;
        distance = otx_closest_on(ask->point, t, at);
        if (distance < best->distance ||
            (best->face < 0 && distance <= best->distance))
            *best = (otx_closest_place){
                face,
                {facet.corners[0], facet.corners[1], facet.corners[2]},
                {at[0], at[1], at[2]},
                distance};
    }
}

static void
look_into_bucket(
    const otx_closest *tree, const otx_closest_ask *ask, int32_t bucket,
    otx_closest_place *best)
{
    const int32_t first = bucket * BUCKET;

    for (int32_t i = first; i < first + BUCKET && i < tree->face_count; ++i)
        if (!ask->labels || ask->labels[tree->faces[i]] == ask->label)
            look_at_face(tree, ask, tree->faces[i], best);
}

otx_closest_place
otx_closest_find(const otx_closest *tree, const otx_closest_ask *ask)
{
    otx_closest_place best = {.face = -1, .distance = ask->reach};
    int32_t stack[DEPTH + 1], count = 0;

    stack[count++] = 1;
    while (count > 0)
    {
        const int32_t node = stack[--count];
        const int32_t child = 2 * node;
        double d[2];

        if (away(tree, node, ask->point) > best.distance)
            continue;
        if (node >= tree->bucket_count)
        {
            look_into_bucket(tree, ask, node - tree->bucket_count, &best);
            continue;
        }
        for (int i = 0; i < 2; ++i)
            d[i] = away(tree, child + i, ask->point);
        stack[count++] = d[0] <= d[1] ? child + 1 : child;
        stack[count++] = d[0] <= d[1] ? child : child + 1;
    }
    return best;
}

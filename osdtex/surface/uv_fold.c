/* uv_fold.c -- charts that fold back on themselves, cut at the fold.
 *
 * Corners that use one texture vertex around a vertex hang together through
 * edges at which their faces go on in UV. Two forests are kept: one over all
 * such edges, one over those that are no folds. Where they differ, the first
 * part of a set keeps its texture vertex and the others get copies. So nothing
 * is cut but what hangs together through a fold. */
#include "surface/uv_fold.h"

#include "base/union_find.h"

#include <string.h>

typedef struct folder
{
    const otx_topology *t;
    const float *uvs;
    const int32_t *face_uvs;
    int8_t *sign;   /* [face_count], of the area in UV */
    int32_t *whole; /* [corner_count], forest over all edges */
    int32_t *part;  /* [corner_count], without folds */
} folder;

static int8_t
sign_of(const folder *f, int32_t face)
{
    const int32_t first = f->t->face_first[face];
    const int32_t end = f->t->face_first[face + 1];
    const float *o = f->uvs + 2 * (size_t)f->face_uvs[first];
    double area = 0.0;

    for (int32_t c = first + 1; c + 1 < end; ++c)
    {
        const float *a = f->uvs + 2 * (size_t)f->face_uvs[c];
        const float *b = f->uvs + 2 * (size_t)f->face_uvs[c + 1];

        area += ((double)a[0] - o[0]) * ((double)b[1] - o[1]) -
                ((double)a[1] - o[1]) * ((double)b[0] - o[0]);
    }
    return (int8_t)((area > 0.0) - (area < 0.0));
}

/* Joins the corners at both ends of an edge that is no seam; whether it is a
 * fold. */
static bool
join_across(folder *f, int32_t edge)
{
    const otx_topology *t = f->t;
    const int32_t *corners = t->edge_corners + t->edge_corner_first[edge];
    const int32_t a[2] = {corners[0], otx_topology_next(t, corners[0])};
    const int32_t b[2] = {otx_topology_next(t, corners[1]), corners[1]};
    bool is_fold;

    if (f->face_uvs[a[0]] != f->face_uvs[b[0]] ||
        f->face_uvs[a[1]] != f->face_uvs[b[1]])
        return false;
    is_fold = f->sign[t->corner_face[a[0]]] * f->sign[t->corner_face[b[1]]] < 0;
    for (int k = 0; k < 2; ++k)
    {
        otx_union_find_join(f->whole, a[k], b[k]);
        if (!is_fold)
            otx_union_find_join(f->part, a[k], b[k]);
    }
    return is_fold;
}

static void
find_folds(folder *f, otx_uv_fold *out)
{
    const otx_topology *t = f->t;

    for (int32_t face = 0; face < t->face_count; ++face)
        f->sign[face] = sign_of(f, face);
    for (int32_t c = 0; c < t->corner_count; ++c)
        f->whole[c] = f->part[c] = c;
    for (int32_t e = 0; e < t->edge_count; ++e)
    {
        const int32_t corner = t->edge_corners[t->edge_corner_first[e]];

        if (otx_topology_edge_size(t, e) != 2 || !join_across(f, e))
            continue;
        if (out->edge_count++ == 0)
            out->face = t->corner_face[corner];
    }
}

/* Texture vertices of the corners, and what the new ones are copies of.
 *
 *   source  [uv_count + corner_count]
 *   index   [corner_count], of the part that a corner is the root of */
static void
number_parts(
    folder *f, int32_t uv_count, int32_t *index, int32_t *source,
    otx_uv_fold *out, int32_t *face_uvs)
{
    for (int32_t i = 0; i < uv_count; ++i)
        source[i] = i;
    out->uv_count = uv_count;
    for (int32_t c = 0; c < f->t->corner_count; ++c)
    {
        const int32_t part = otx_union_find_root(f->part, c);

        /* The root is the smallest corner of its set. */
        if (part != c)
            index[c] = index[part];
        else if (otx_union_find_root(f->whole, c) == c)
            index[c] = f->face_uvs[c];
        else
        {
            source[out->uv_count] = f->face_uvs[c];
            index[c] = out->uv_count++;
        }
        face_uvs[c] = index[c];
    }
}

/* Writes the texture vertices out; NULL when memory is out. */
static const float *
copy_uvs(
    otx_arena *arena, const float *uvs, const int32_t *source, int32_t count)
{
    float *to = OTX_NEW(arena, float, 2 * (size_t)count);

    for (int32_t i = 0; to && i < count; ++i)
        memcpy(to + 2 * (size_t)i, uvs + 2 * (size_t)source[i], 2 * sizeof *to);
    return to;
}

bool
otx_uv_fold_split(
    otx_arena *arena, const otx_topology *t, int32_t uv_count, const float *uvs,
    const int32_t *face_uvs, otx_uv_fold *out)
{
    const size_t corners = (size_t)t->corner_count;
    folder f = {
        t,
        uvs,
        face_uvs,
        OTX_NEW(arena, int8_t, t->face_count),
        OTX_NEW(arena, int32_t, corners),
        OTX_NEW(arena, int32_t, corners)};
    int32_t *index, *source, *split;

    *out = (otx_uv_fold){uv_count, uvs, face_uvs, 0, -1};
    if (!f.sign || !f.whole || !f.part)
        return false;
    find_folds(&f, out);
    if (out->edge_count == 0)
        return true;
    index = OTX_NEW(arena, int32_t, corners);
    source = OTX_NEW(arena, int32_t, (size_t)uv_count + corners);
    split = OTX_NEW(arena, int32_t, corners);
    if (!index || !source || !split)
        return false;
    number_parts(&f, uv_count, index, source, out, split);
    out->face_uvs = split;
    out->uvs = copy_uvs(arena, uvs, source, out->uv_count);
    return out->uvs != NULL;
}

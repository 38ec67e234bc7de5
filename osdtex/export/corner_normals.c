/* corner_normals.c -- normals at the corners of leaf faces, as files store
 * them.
 *
 * Sharp edges are found in the cage and followed down the levels: the children
 * of an edge join its ends to the vertex that was born on it. At their vertices
 * the corners fall into sets that hang together across other edges; where there
 * is more than one, each has the mean normal of its faces, by area. */
#include "export/corner_normals.h"

#include "base/union_find.h"
#include "math/vec.h"
#include "surface/topology.h"

#include <string.h>

static const char STAGE[] = "export";

typedef struct builder
{
    otx_run *run;
    const otx_surface *surface;
    const otx_level *leaf;
    uint8_t *sharp;      /* [leaf edge_count] */
    uint8_t *at_sharp;   /* [leaf vert_count], touches a sharp edge */
    int32_t *parent;     /* [leaf corner_count], forest of corners */
    int32_t *side_count; /* [leaf vert_count], sets of its corners */
} builder;

/* ---- sharp edges --------------------------------------------------------- */

/* The cage's vertex that each vertex of level 0 is: a pinch vertex is several.
 * NULL when memory is out. */
static int32_t *
cage_verts(otx_arena *arena, const otx_surface *surface)
{
    const otx_level *level = &surface->levels[0];
    int32_t *verts = OTX_NEW(arena, int32_t, level->vert_count);

    for (int32_t v = 0; verts && v < level->vert_count; ++v)
        verts[v] = v;
    for (int32_t c = 0; verts && c < level->corner_count; ++c)
        verts[level->face_verts[c]] = surface->cage->face_verts[c];
    return verts;
}

/* [edge_count] of the cage's topology: 1 where a crease is infinitely sharp;
 * the last crease of an edge holds. */
static uint8_t *
sharp_creases(otx_arena *arena, const otx_cage *cage, const otx_topology *t)
{
    uint8_t *sharp = OTX_ZNEW(arena, uint8_t, t->edge_count);

    for (int32_t i = 0; sharp && i < cage->crease_count; ++i)
    {
        const int32_t *ends = cage->crease_verts + 2 * (size_t)i;
        const int32_t edge = otx_topology_find_edge(t, ends[0], ends[1]);

        if (edge >= 0)
            sharp[edge] = cage->crease_sharpness[i] >= OTX_CAGE_SHARPNESS_MAX;
    }
    return sharp;
}

/* Marks the sharp edges of level 0; false when memory is out. */
static bool
mark_cage(builder *b, uint8_t *sharp)
{
    const otx_cage *cage = b->surface->cage;
    const otx_level *level = &b->surface->levels[0];
    otx_arena *arena = b->run->scratch;
    const int32_t *verts = cage_verts(arena, b->surface);
    const uint8_t *creases;
    otx_topology t;

    if (!verts || !otx_topology_build(
                      arena, cage->vert_count, cage->face_count,
                      cage->face_first, cage->face_verts, &t))
        return false;
    creases = sharp_creases(arena, cage, &t);
    for (int32_t e = 0; creases && e < level->edge_count; ++e)
    {
        const int32_t *ends = level->edge_verts + 2 * (size_t)e;
        const int32_t edge =
            otx_topology_find_edge(&t, verts[ends[0]], verts[ends[1]]);

        sharp[e] =
            cage->scheme == OTX_SCHEME_BILINEAR || (edge >= 0 && creases[edge]);
    }
    return creases != NULL;
}

/* The sharp edges of the next level. False when memory is out.
 *
 *   born  [next vert_count], edge that the vertex lies on, -1 none */
static bool
mark_next(
    otx_arena *arena, const otx_level *level, const uint8_t *sharp,
    const otx_level *next, uint8_t *out)
{
    int32_t *born = OTX_NEW(arena, int32_t, next->vert_count);

    if (!born)
        return false;
    for (int32_t v = 0; v < next->vert_count; ++v)
        born[v] = -1;
    for (int32_t e = 0; e < level->edge_count; ++e)
        if (sharp[e])
            born[level->edge_child_vert[e]] = e;
    for (int32_t e = 0; e < next->edge_count; ++e)
    {
        const int32_t *ends = next->edge_verts + 2 * (size_t)e;

        out[e] = 0;
        for (int k = 0; k < 2; ++k)
        {
            const int32_t edge = born[ends[k]];
            const int32_t *old =
                edge >= 0 ? level->edge_verts + 2 * (size_t)edge : NULL;

            out[e] |= old && (old[0] == ends[1 - k] || old[1] == ends[1 - k]);
        }
    }
    return true;
}

static bool
mark_sharp(builder *b)
{
    const otx_surface *s = b->surface;
    uint8_t *sharp =
        OTX_ZNEW(b->run->scratch, uint8_t, s->levels[0].edge_count);

    if (!sharp || !mark_cage(b, sharp))
        return false;
    for (int32_t l = 0; l + 1 < s->level_count; ++l)
    {
        uint8_t *next =
            OTX_ZNEW(b->run->scratch, uint8_t, s->levels[l + 1].edge_count);

        if (!next ||
            !mark_next(
                b->run->scratch, &s->levels[l], sharp, &s->levels[l + 1], next))
            return false;
        sharp = next;
    }
    b->sharp = sharp;
    for (int32_t e = 0; e < b->leaf->edge_count; ++e)
        if (sharp[e])
            b->at_sharp[b->leaf->edge_verts[2 * (size_t)e]] =
                b->at_sharp[b->leaf->edge_verts[2 * (size_t)e + 1]] = 1;
    return true;
}

/* ---- sides --------------------------------------------------------------- */

/* The corner of a face at a vertex, -1 none. */
static int32_t
corner_at(const otx_level *level, int32_t face, int32_t vertex)
{
    for (int32_t c = level->face_first[face]; c < level->face_first[face + 1];
         ++c)
        if (level->face_verts[c] == vertex)
            return c;
    return -1;
}

/* Joins the corners at both ends of edge k of a face with those across it. */
static void
join_across(builder *b, int32_t face, int32_t k)
{
    const otx_level *leaf = b->leaf;
    const int32_t first = leaf->face_first[face];
    const int32_t size = leaf->face_first[face + 1] - first;
    const int32_t other = otx_level_neighbour(leaf, face, k);

    if (other < face || b->sharp[leaf->face_edges[first + k]])
        return;
    for (int i = 0; i < 2; ++i)
    {
        const int32_t corner = first + (k + i) % size;
        const int32_t across = corner_at(leaf, other, leaf->face_verts[corner]);

        if (across >= 0 && b->at_sharp[leaf->face_verts[corner]])
            otx_union_find_join(b->parent, corner, across);
    }
}

static void
find_sides(builder *b)
{
    const otx_level *leaf = b->leaf;

    for (int32_t c = 0; c < leaf->corner_count; ++c)
        b->parent[c] = c;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
            join_across(b, f, k);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        b->side_count[leaf->face_verts[c]] += b->parent[c] == c;
}

/* ---- normals ------------------------------------------------------------- */

/* Twice the area vector of a leaf face. */
static otx_vec3
area_of(const builder *b, int32_t face)
{
    const int32_t *verts = b->leaf->face_verts + b->leaf->face_first[face];
    const otx_vec3 origin = otx_vec3_load(b->surface->points, verts[0]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t k = 1; k + 1 < otx_level_face_size(b->leaf, face); ++k)
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(
                    otx_vec3_load(b->surface->points, verts[k]), origin),
                otx_vec3_sub(
                    otx_vec3_load(b->surface->points, verts[k + 1]), origin)));
    return sum;
}

static bool
has_sides(const builder *b, int32_t vertex)
{
    return b->at_sharp[vertex] && b->side_count[vertex] > 1;
}

/* Sums of the faces of each side, at its root; NULL when memory is out. */
static otx_vec3 *
side_sums(builder *b)
{
    const otx_level *leaf = b->leaf;
    otx_vec3 *sums = OTX_ZNEW(b->run->scratch, otx_vec3, leaf->corner_count);

    for (int32_t f = 0; sums && f < leaf->face_count; ++f)
    {
        const otx_vec3 area = area_of(b, f);

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
            if (has_sides(b, leaf->face_verts[c]))
            {
                const int32_t root = otx_union_find_root(b->parent, c);

                sums[root] = otx_vec3_add(sums[root], area);
            }
    }
    return sums;
}

static void
store(float *to, otx_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

/* Normals by vertex, then by side. */
static otx_status
list_normals(builder *b, otx_corner_normals *out)
{
    const otx_level *leaf = b->leaf;
    const size_t most = (size_t)leaf->vert_count + (size_t)leaf->corner_count;
    float *normals = OTX_NEW(b->run->scratch, float, 3 * most);
    int32_t *indices = OTX_NEW(b->run->scratch, int32_t, leaf->corner_count);
    int32_t *of_vert = OTX_NEW(b->run->scratch, int32_t, leaf->vert_count);
    const otx_vec3 *sums = side_sums(b);

    OTX_TRY(otx_run_ok(b->run));
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        of_vert[v] = -1;
    out->count = 0;
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const int32_t v = leaf->face_verts[c];
        const int32_t root =
            has_sides(b, v) ? otx_union_find_root(b->parent, c) : c;
        const otx_vec3 vertex = otx_vec3_load(b->surface->normals, v);
        const otx_vec3 side = sums[root];

        if (root != c || (!has_sides(b, v) && of_vert[v] >= 0))
        {
            indices[c] = root != c ? indices[root] : of_vert[v];
            continue;
        }
        store(
            normals + 3 * (size_t)out->count,
            has_sides(b, v) && otx_vec3_length(side) > 0.0 ? otx_vec3_unit(side)
                                                           : vertex);
        indices[c] = out->count++;
        if (!has_sides(b, v))
            of_vert[v] = indices[c];
    }
    out->normals = normals;
    out->indices = indices;
    return OSDTEX_OK;
}

otx_status
otx_corner_normals_build(
    otx_run *run, const otx_surface *surface, otx_corner_normals *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    builder b = {
        .run = run,
        .surface = surface,
        .leaf = leaf,
        .at_sharp = OTX_ZNEW(run->scratch, uint8_t, leaf->vert_count),
        .parent = OTX_NEW(run->scratch, int32_t, leaf->corner_count),
        .side_count = OTX_ZNEW(run->scratch, int32_t, leaf->vert_count)};

    if (!b.at_sharp || !b.parent || !b.side_count || !mark_sharp(&b))
        return otx_fail_memory(run, STAGE);
    find_sides(&b);
    return list_normals(&b, out);
}

otx_status
otx_corner_normals_of_cage(
    otx_run *run, const otx_surface *surface, otx_corner_normals *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_level *cage = &surface->levels[0];
    int32_t *indices = OTX_ZNEW(run->scratch, int32_t, cage->corner_count);
    int32_t *number;
    otx_corner_normals all;
    float *normals;

    OTX_TRY(otx_corner_normals_build(run, surface, &all));
    normals = OTX_NEW(run->scratch, float, 3 * (size_t)cage->corner_count);
    number = OTX_NEW(run->scratch, int32_t, all.count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < all.count; ++i)
        number[i] = -1;
    *out = (otx_corner_normals){0, normals, indices};
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            const int32_t corner =
                leaf->face_verts[c] < cage->vert_count
                    ? corner_at(cage, leaf->face_cage[f], leaf->face_verts[c])
                    : -1;
            const int32_t normal = all.indices[c];

            if (corner < 0)
                continue;
            if (number[normal] < 0)
            {
                memcpy(
                    normals + 3 * (size_t)out->count,
                    all.normals + 3 * (size_t)normal, 3 * sizeof *normals);
                number[normal] = out->count++;
            }
            indices[corner] = number[normal];
        }
    return OSDTEX_OK;
}

/* island.c -- edges by hashing, islands by union and find. */
#include "render/island.h"

#include "base/hash.h"
#include "base/random.h"
#include "base/union_find.h"

#include <string.h>

static const char STAGE[] = "render";

/* UVs closer than this are the same; a hundredth of a texel at 1k. */
static const double SAME_UV = 1e-5;

/* Each corner's successor in its face: the two are the ends of its edge. -1
 * in holes, which have no edges to anyone. */
static int32_t *
list_next(otx_arena *arena, const otx_scene *scene)
{
    int32_t *next = OTX_NEW(arena, int32_t, scene->corner_count);

    for (int32_t f = 0; next && f < scene->face_count; ++f)
    {
        const int32_t first = scene->face_first[f];
        const int32_t end = scene->face_first[f + 1];

        for (int32_t c = first; c < end; ++c)
        {
            next[c] = c + 1 < end ? c + 1 : first;
            if (otx_scene_is_hole(scene, f))
                next[c] = -1;
        }
    }
    return next;
}

static uint64_t
edge_key(const otx_scene *scene, const int32_t *next, int32_t corner)
{
    const uint64_t a = (uint64_t)scene->face_verts[corner];
    const uint64_t b = (uint64_t)scene->face_verts[next[corner]];

    return a < b ? a << 32 | b : b << 32 | a;
}

/* Walks the corners in order; the first of an edge waits in the table for the
 * second, which takes it and leaves the slot to whoever comes third. */
static void
pair_corners(
    const otx_scene *scene, const int32_t *next, int32_t *table, size_t size,
    int32_t *twin)
{
    for (int32_t c = 0; c < scene->corner_count; ++c)
    {
        uint64_t key;
        size_t slot;

        if (next[c] < 0)
            continue;
        key = edge_key(scene, next, c);
        slot = otx_random_mix(key) & (size - 1);

        while (table[slot] >= 0 && edge_key(scene, next, table[slot]) != key)
            slot = (slot + 1) & (size - 1);
        if (table[slot] >= 0 && twin[table[slot]] < 0)
        {
            twin[c] = table[slot];
            twin[table[slot]] = c;
        }
        else
            table[slot] = c;
    }
}

otx_status
otx_island_pair(
    otx_run *run, otx_arena *arena, const otx_scene *scene,
    const int32_t **twin)
{
    const size_t count = (size_t)scene->corner_count;
    const size_t size = otx_hash_table_size((size_t)scene->corner_count);
    int32_t *pairs = OTX_NEW(arena, int32_t, count);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *next = list_next(run->scratch, scene);
    int32_t *table = OTX_NEW(run->scratch, int32_t, size);

    *twin = NULL;
    if (!pairs || !next || !table)
        return otx_fail_memory(run, STAGE);
    memset(pairs, -1, count * sizeof *pairs);
    memset(table, -1, size * sizeof *table);
    pair_corners(scene, next, table, size, pairs);
    otx_arena_release(run->scratch, mark);
    *twin = pairs;
    return OSDTEX_OK;
}

static bool
uv_apart(const otx_scene *scene, int32_t face, int32_t a, int32_t b)
{
    const int32_t t = scene->face_texture ? scene->face_texture[face] : 0;
    const otx_scene_texture *texture =
        t >= 0 && t < scene->texture_count ? &scene->textures[t] : NULL;
    double du = (double)scene->uvs[2 * (size_t)a] - scene->uvs[2 * (size_t)b];
    double dv =
        (double)scene->uvs[2 * (size_t)a + 1] - scene->uvs[2 * (size_t)b + 1];

    if (texture && texture->wrap_x)
        du -= round(du);
    if (texture && texture->wrap_y)
        dv -= round(dv);
    return fabs(du) > SAME_UV || fabs(dv) > SAME_UV;
}

/* Whether the UVs differ at either end of the edge of corners c and d. */
static bool
edge_is_cut(
    const otx_scene *scene, const int32_t *next, int32_t face, int32_t c,
    int32_t d)
{
    const bool opposed = scene->face_verts[c] != scene->face_verts[d];
    const int32_t d0 = opposed ? next[d] : d;
    const int32_t d1 = opposed ? d : next[d];

    return uv_apart(scene, face, c, d0) || uv_apart(scene, face, next[c], d1);
}

/* The face of each corner. */
static int32_t *
list_faces(otx_arena *arena, const otx_scene *scene)
{
    int32_t *face = OTX_NEW(arena, int32_t, scene->corner_count);

    for (int32_t f = 0; face && f < scene->face_count; ++f)
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
            face[c] = f;
    return face;
}

otx_status
otx_island_seams(
    otx_run *run, otx_arena *arena, const otx_scene *scene, const int32_t *twin,
    const uint8_t **seam)
{
    uint8_t *flags = OTX_ZNEW(arena, uint8_t, scene->corner_count);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *next = list_next(run->scratch, scene);
    int32_t *face = list_faces(run->scratch, scene);

    *seam = NULL;
    if (!flags || !next || !face)
        return otx_fail_memory(run, STAGE);
    for (int32_t c = 0; c < scene->corner_count; ++c)
    {
        const int32_t d = twin[c];

        if (d < 0)
            continue;
        if (scene->face_patch)
            flags[c] = scene->face_patch[face[c]] != scene->face_patch[face[d]];
        else if (scene->uvs)
            flags[c] = edge_is_cut(scene, next, face[c], c, d);
    }
    otx_arena_release(run->scratch, mark);
    *seam = flags;
    return OSDTEX_OK;
}

otx_status
otx_island_label(
    otx_run *run, otx_arena *arena, const otx_scene *scene, const int32_t *twin,
    const uint8_t *seam, const int32_t **label)
{
    int32_t *labels = OTX_NEW(arena, int32_t, scene->face_count);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *parent = OTX_NEW(run->scratch, int32_t, scene->face_count);
    int32_t *face = list_faces(run->scratch, scene);
    int32_t count = 0;

    *label = NULL;
    if (!labels || !parent || !face)
        return otx_fail_memory(run, STAGE);
    for (int32_t f = 0; f < scene->face_count; ++f)
        parent[f] = f;
    for (int32_t c = 0; c < scene->corner_count; ++c)
        if (twin[c] >= 0 && !seam[c])
            otx_union_find_join(parent, face[c], face[twin[c]]);
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const int32_t root = otx_union_find_root(parent, f);

        labels[f] = root == f ? count++ : labels[root];
    }
    otx_arena_release(run->scratch, mark);
    *label = labels;
    return OSDTEX_OK;
}

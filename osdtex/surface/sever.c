/* sever.c -- a mesh that is no manifold, cut until it is one.
 *
 * Corners of a vertex stay together where a sound edge joins their faces; each
 * set of them becomes a vertex. Around a vertex a corner has two edges, so a
 * set is a fan by construction. What may remain are edges that are unsound
 * although both ends hold together elsewhere, as the slit in a Moebius strip:
 * there the faces at the edge let go of everything, and the search goes on
 * until nothing is left to part. */
#include "surface/sever.h"

#include "base/union_find.h"
#include "surface/topology.h"

#include <string.h>

typedef struct sever
{
    otx_arena *arena;
    int32_t vert_count, face_count;
    const int32_t *face_first;
    const int32_t *face_verts; /* as given */
    uint8_t *loose;            /* [corner_count], joined to no other */
    int32_t *parent;           /* [corner_count], forest of joined corners */
    int32_t *verts;            /* [corner_count], the result */
    int32_t *source;           /* [vert_count + corner_count] */
    int32_t count;             /* of vertices of the result */
} sever;

static bool
holds(const otx_topology *t, int32_t edge)
{
    const int32_t *corners = t->edge_corners + t->edge_corner_first[edge];

    return otx_topology_edge_size(t, edge) == 2 &&
           t->face_verts[corners[0]] != t->face_verts[corners[1]];
}

static bool
is_sound(const otx_topology *t, int32_t edge)
{
    return otx_topology_edge_size(t, edge) == 1 || holds(t, edge);
}

/* Whether edges and vertices are those of a manifold; *out false too when
 * memory is out, which the return value says. */
static bool
is_manifold(otx_arena *arena, const otx_topology *t, bool *out)
{
    const otx_topology_fan *fans;

    *out = false;
    for (int32_t e = 0; e < t->edge_count; ++e)
        if (!is_sound(t, e))
            return true;
    fans = otx_topology_fans(arena, t);
    if (!fans)
        return false;
    for (int32_t v = 0; v < t->vert_count; ++v)
        if (fans[v].start >= 0 &&
            otx_topology_fan_size(t, fans[v].start) != fans[v].faces)
            return true;
    *out = true;
    return true;
}

static void
join(sever *s, int32_t a, int32_t b)
{
    if (s->loose[a] || s->loose[b])
        return;
    otx_union_find_join(s->parent, a, b);
}

static void
join_across_edges(sever *s, const otx_topology *t)
{
    for (int32_t c = 0; c < t->corner_count; ++c)
        s->parent[c] = c;
    for (int32_t e = 0; e < t->edge_count; ++e)
    {
        const int32_t *corners = t->edge_corners + t->edge_corner_first[e];

        if (!holds(t, e))
            continue;
        join(s, corners[0], otx_topology_next(t, corners[1]));
        join(s, otx_topology_next(t, corners[0]), corners[1]);
    }
}

/* The first set of a vertex keeps its number, others get new ones.
 *
 *   taken  [vert_count] */
static void
number_sets(sever *s, uint8_t *taken)
{
    const int32_t corners = s->face_first[s->face_count];

    memset(taken, 0, (size_t)s->vert_count);
    s->count = s->vert_count;
    for (int32_t v = 0; v < s->vert_count; ++v)
        s->source[v] = v;
    for (int32_t c = 0; c < corners; ++c)
    {
        const int32_t root = otx_union_find_root(s->parent, c),
                      v = s->face_verts[c];

        if (root != c)
            s->verts[c] = s->verts[root];
        else if (!taken[v])
            s->verts[c] = v;
        else
        {
            s->source[s->count] = v;
            s->verts[c] = s->count++;
        }
        taken[v] = 1;
    }
}

/* Marks the corners at edges that are still unsound; how many are new. */
static int32_t
loosen(sever *s, const otx_topology *now)
{
    int32_t count = 0;

    for (int32_t e = 0; e < now->edge_count; ++e)
    {
        if (is_sound(now, e))
            continue;
        for (int32_t i = now->edge_corner_first[e];
             i < now->edge_corner_first[e + 1]; ++i)
        {
            const int32_t ends[2] = {
                now->edge_corners[i],
                otx_topology_next(now, now->edge_corners[i])};

            for (int k = 0; k < 2; ++k)
            {
                count += !s->loose[ends[k]];
                s->loose[ends[k]] = 1;
            }
        }
    }
    return count;
}

static bool
part(sever *s, const otx_topology *t, uint8_t *taken)
{
    for (;;)
    {
        const otx_arena_mark mark = otx_arena_here(s->arena);
        otx_topology now;
        int32_t found;

        join_across_edges(s, t);
        number_sets(s, taken);
        if (!otx_topology_build(
                s->arena, s->count, s->face_count, s->face_first, s->verts,
                &now))
            return false;
        found = loosen(s, &now);
        otx_arena_release(s->arena, mark);
        if (found == 0)
            return true;
    }
}

bool
otx_sever_build(
    otx_arena *arena, int32_t vert_count, int32_t face_count,
    const int32_t *face_first, const int32_t *face_verts, otx_sever *out)
{
    const int32_t corners = face_first[face_count];
    const otx_arena_mark mark = otx_arena_here(arena);
    sever s = {arena, vert_count, face_count, face_first, face_verts,
               NULL,  NULL,       NULL,       NULL,       0};
    uint8_t *taken;
    otx_topology t;
    bool manifold;

    *out = (otx_sever){vert_count, face_verts, NULL};
    if (!otx_topology_build(
            arena, vert_count, face_count, face_first, face_verts, &t) ||
        !is_manifold(arena, &t, &manifold))
        return false;
    if (manifold)
    {
        otx_arena_release(arena, mark);
        return true;
    }
    s.loose = OTX_ZNEW(arena, uint8_t, corners);
    s.parent = OTX_NEW(arena, int32_t, corners);
    s.verts = OTX_NEW(arena, int32_t, corners);
    s.source = OTX_NEW(arena, int32_t, (int64_t)vert_count + corners);
    taken = OTX_NEW(arena, uint8_t, vert_count);
    if (!s.loose || !s.parent || !s.verts || !s.source || !taken ||
        !part(&s, &t, taken))
        return false;
    *out = (otx_sever){s.count, s.verts, s.source};
    return true;
}

const float *
otx_sever_points(otx_arena *arena, const otx_sever *mesh, const float *points)
{
    float *out;

    if (!mesh->source)
        return points;
    out = OTX_NEW(arena, float, 3 * (size_t)mesh->vert_count);
    for (int32_t v = 0; out && v < mesh->vert_count; ++v)
        memcpy(
            out + 3 * (size_t)v, points + 3 * (size_t)mesh->source[v],
            3 * sizeof *out);
    return out;
}

/* subset.c -- some of the leaf faces of a surface, as a surface of its own. */
#include "surface/subset.h"

#include "base/pqueue.h"
#include "math/vec.h"

static const char STAGE[] = "surface";

/* Where what is taken comes from, and where it goes. */
typedef struct taking
{
    otx_run *run;
    const otx_surface *whole;
    const otx_level *from;
    const uint8_t *taken;
    int32_t *vert_to, *edge_to; /* of the whole level; -1 not taken */
    otx_level to;
    otx_subset *out;
} taking;

static void
count_parts(taking *t)
{
    const otx_level *l = t->from;

    for (int32_t v = 0; v < l->vert_count; ++v)
        t->vert_to[v] = -1;
    for (int32_t e = 0; e < l->edge_count; ++e)
        t->edge_to[e] = -1;
    for (int32_t f = 0; f < l->face_count; ++f)
    {
        if (!t->taken[f])
            continue;
        ++t->to.face_count;
        for (int32_t c = l->face_first[f]; c < l->face_first[f + 1]; ++c)
        {
            ++t->to.corner_count;
            t->vert_to[l->face_verts[c]] = 0;
            t->edge_to[l->face_edges[c]] = 0;
        }
    }
    for (int32_t v = 0; v < l->vert_count; ++v)
        if (t->vert_to[v] == 0)
            t->vert_to[v] = t->to.vert_count++;
    for (int32_t e = 0; e < l->edge_count; ++e)
        if (t->edge_to[e] == 0)
            t->edge_to[e] = t->to.edge_count++;
}

static otx_status
take_faces(taking *t)
{
    otx_arena *arena = t->run->arena;
    const otx_level *l = t->from;
    int32_t *faces = OTX_NEW(arena, int32_t, t->to.face_count);
    int32_t *corners = OTX_NEW(arena, int32_t, t->to.corner_count);
    int32_t *first = OTX_NEW(arena, int32_t, t->to.face_count + 1);
    int32_t *verts = OTX_NEW(arena, int32_t, t->to.corner_count);
    int32_t *edges = OTX_NEW(arena, int32_t, t->to.corner_count);
    int32_t *cage = OTX_NEW(arena, int32_t, t->to.face_count);
    uint8_t *hole = OTX_NEW(arena, uint8_t, t->to.face_count);
    int32_t n = 0, k = 0;

    OTX_TRY(otx_run_ok(t->run));
    for (int32_t f = 0; f < l->face_count; ++f)
    {
        if (!t->taken[f])
            continue;
        faces[n] = f;
        first[n] = k;
        cage[n] = l->face_cage[f];
        hole[n++] = l->face_hole[f];
        for (int32_t c = l->face_first[f]; c < l->face_first[f + 1]; ++c, ++k)
        {
            corners[k] = c;
            verts[k] = t->vert_to[l->face_verts[c]];
            edges[k] = t->edge_to[l->face_edges[c]];
        }
    }
    first[n] = k;
    t->out->faces = faces;
    t->out->corners = corners;
    t->to.face_first = first;
    t->to.face_verts = verts;
    t->to.face_edges = edges;
    t->to.face_cage = cage;
    t->to.face_hole = hole;
    return OSDTEX_OK;
}

/* The taken faces of an edge first; no face beyond is -1. */
static otx_status
take_edges(taking *t)
{
    const otx_level *l = t->from;
    int32_t *verts = OTX_NEW(t->run->arena, int32_t, 2 * t->to.edge_count);
    int32_t *faces = OTX_NEW(t->run->arena, int32_t, 2 * t->to.edge_count);
    int32_t *face_to = OTX_NEW(t->run->scratch, int32_t, l->face_count);

    OTX_TRY(otx_run_ok(t->run));
    for (int32_t i = 0; i < t->to.face_count; ++i)
        face_to[t->out->faces[i]] = i;
    for (int32_t e = 0; e < l->edge_count; ++e)
    {
        const int32_t to = 2 * t->edge_to[e];
        int32_t n = 0;

        if (t->edge_to[e] < 0)
            continue;
        for (int32_t k = 0; k < 2; ++k)
        {
            const int32_t f = l->edge_faces[2 * (size_t)e + (size_t)k];

            verts[to + k] =
                t->vert_to[l->edge_verts[2 * (size_t)e + (size_t)k]];
            if (f >= 0 && t->taken[f])
                faces[to + n++] = face_to[f];
        }
        if (n == 1)
            faces[to + 1] = -1;
    }
    t->to.edge_verts = verts;
    t->to.edge_faces = faces;
    return OSDTEX_OK;
}

/* `size` floats of each vertex; NULL of NULL. */
static const float *
take_values(taking *t, const float *from, size_t size)
{
    float *to =
        from ? OTX_NEW(t->run->arena, float, size *(size_t)t->to.vert_count)
             : NULL;

    for (int32_t v = 0; to && v < t->to.vert_count; ++v)
        for (size_t k = 0; k < size; ++k)
            to[size * (size_t)v + k] =
                from[size * (size_t)t->out->verts[v] + k];
    return to;
}

static otx_status
take_verts(taking *t)
{
    int32_t *verts = OTX_NEW(t->run->arena, int32_t, t->to.vert_count);
    otx_surface *s = &t->out->surface;

    OTX_TRY(otx_run_ok(t->run));
    for (int32_t v = 0; v < t->from->vert_count; ++v)
        if (t->vert_to[v] >= 0)
            verts[t->vert_to[v]] = v;
    t->out->verts = verts;
    s->points = take_values(t, t->whole->points, 3);
    s->normals = take_values(t, t->whole->normals, 3);
    s->tangents = take_values(t, t->whole->tangents, 6);
    s->density = take_values(t, t->whole->density, 1);
    return otx_run_ok(t->run);
}

static double
face_area(const otx_surface *s, const otx_level *level, int32_t face)
{
    const int32_t *v = level->face_verts + level->face_first[face];
    const otx_vec3 origin = otx_vec3_load(s->points, v[0]);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t k = 1; k + 1 < otx_level_face_size(level, face); ++k)
        sum = otx_vec3_add(
            sum, otx_vec3_cross(
                     otx_vec3_sub(otx_vec3_load(s->points, v[k]), origin),
                     otx_vec3_sub(otx_vec3_load(s->points, v[k + 1]), origin)));
    return 0.5 * otx_vec3_length(sum);
}

static void
measure(otx_surface *s)
{
    const otx_level *level = &s->levels[0];

    for (int32_t f = 0; f < level->face_count; ++f)
        if (!level->face_hole[f])
            s->area += face_area(s, level, f);
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *v = level->edge_verts + 2 * (size_t)e;

        s->mean_edge_length += otx_vec3_length(otx_vec3_sub(
            otx_vec3_load(s->points, v[1]), otx_vec3_load(s->points, v[0])));
    }
    if (level->edge_count > 0)
        s->mean_edge_length /= level->edge_count;
}

otx_status
otx_subset_take(
    otx_run *run, const otx_surface *surface, const uint8_t *taken,
    otx_subset *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_level *level = OTX_ZNEW(run->arena, otx_level, 1);
    taking t = {
        .run = run,
        .whole = surface,
        .from = leaf,
        .taken = taken,
        .vert_to = OTX_NEW(run->scratch, int32_t, leaf->vert_count),
        .edge_to = OTX_NEW(run->scratch, int32_t, leaf->edge_count),
        .out = out,
    };

    *out = (otx_subset){0};
    if (!level || !t.vert_to || !t.edge_to)
        return otx_fail_memory(run, STAGE);
    count_parts(&t);
    OTX_TRY(take_faces(&t));
    OTX_TRY(take_edges(&t));
    OTX_TRY(take_verts(&t));
    *level = t.to;
    out->surface.cage = surface->cage;
    out->surface.level_count = 1;
    out->surface.levels = level;
    measure(&out->surface);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static otx_vec3
centre(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t size = otx_level_face_size(leaf, face);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        sum = otx_vec3_add(
            sum, otx_vec3_load(surface->points, leaf->face_verts[c]));
    return otx_vec3_scale(1.0 / size, sum);
}

/* Offers the neighbours of a face that lie within reach. */
static void
push_around(
    const otx_surface *surface, const uint8_t *marked, otx_pqueue_entry from,
    double reach, otx_pqueue *queue)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t k = 0; k < otx_level_face_size(leaf, from.item); ++k)
    {
        const int32_t other = otx_level_neighbour(leaf, from.item, k);
        double d;

        if (other < 0 || marked[other] || leaf->face_hole[other])
            continue;
        d = from.key + otx_vec3_length(otx_vec3_sub(
                           centre(surface, other), centre(surface, from.item)));
        if (d <= reach)
            otx_pqueue_push(queue, d, other);
    }
}

otx_status
otx_subset_widen(
    otx_run *run, const otx_surface *surface, double reach, uint8_t mark,
    uint8_t *marked)
{
    const otx_arena_mark here = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_pqueue_entry entry;
    otx_status status;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (marked[f])
            push_around(
                surface, marked, (otx_pqueue_entry){0.0, f}, reach, &queue);
    for (int64_t i = 0; otx_pqueue_pop(&queue, &entry); ++i)
    {
        if (i % 4096 == 0)
            OTX_TRY(otx_pulse(run));
        if (marked[entry.item])
            continue;
        marked[entry.item] = mark;
        push_around(surface, marked, entry, reach, &queue);
    }
    status = otx_run_ok(run);
    otx_arena_release(run->scratch, here);
    return status;
}

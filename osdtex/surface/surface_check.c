/* surface_check.c -- checks every invariant that surface/level.h states.
 *
 * Slow and plain on purpose: this is the reference that the fast paths are
 * held against. The first violation ends it, with the level and the element.
 */
#include "math/vec.h"
#include "surface/surface.h"
#include "surface/topology.h"

#include <math.h>

#define STAGE "surface"

/* Frames are stored as float. */
static const double frame_error = 1e-4;

typedef struct checker
{
    otx_run *run;
    const otx_surface *surface;
    const otx_level *level;
    int32_t index; /* of the level */
} checker;

static otx_status
fail(const checker *c, int32_t face, const char *what)
{
    otx_where where = OTX_NOWHERE;

    where.file = c->surface->cage->path;
    where.face = face;
    return otx_fail(
        c->run, OSDTEX_ERROR_NUMERIC, STAGE, where,
        "level %d is inconsistent at element %d: %s; please report this cage",
        c->index, face, what);
}

static bool
in_range(int32_t index, int32_t count)
{
    return index >= 0 && index < count;
}

static otx_status
check_corners(const checker *c)
{
    const otx_level *l = c->level;

    if (l->face_first[0] != 0 ||
        l->face_first[l->face_count] != l->corner_count)
        return fail(c, 0, "the corners do not add up");
    for (int32_t f = 0; f < l->face_count; ++f)
    {
        if (otx_level_face_size(l, f) < 3)
            return fail(c, f, "a face has fewer than 3 corners");
    }
    for (int32_t i = 0; i < l->corner_count; ++i)
    {
        if (!in_range(l->face_verts[i], l->vert_count) ||
            !in_range(l->face_edges[i], l->edge_count))
            return fail(c, i, "a corner's vertex or edge is out of range");
    }
    return OSDTEX_OK;
}

/* Edge k of a face joins corners k and k + 1, and knows the face. */
static otx_status
check_face_edges(const checker *c, int32_t face)
{
    const otx_level *l = c->level;
    const int32_t size = otx_level_face_size(l, face);
    const int32_t *verts = l->face_verts + l->face_first[face];
    const int32_t *edges = l->face_edges + l->face_first[face];

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t a = verts[k];
        const int32_t b = verts[(k + 1) % size];
        const int32_t *ends = l->edge_verts + 2 * (size_t)edges[k];
        const int32_t *faces = l->edge_faces + 2 * (size_t)edges[k];

        if (!((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)))
            return fail(c, face, "an edge does not join its corners");
        if (faces[0] != face && faces[1] != face)
            return fail(c, face, "an edge does not know its face");
    }
    return OSDTEX_OK;
}

/* As many faces at the edges as edges at the faces: with check_face_edges the
 * relation is then its own inverse. */
static otx_status
check_edge_faces(const checker *c)
{
    const otx_level *l = c->level;
    int64_t incidences = 0;

    for (int32_t e = 0; e < l->edge_count; ++e)
    {
        const int32_t *faces = l->edge_faces + 2 * (size_t)e;

        if (!in_range(faces[0], l->face_count) || faces[0] == faces[1] ||
            (faces[1] != -1 && !in_range(faces[1], l->face_count)))
            return fail(c, e, "an edge's faces are out of range or equal");
        incidences += faces[1] < 0 ? 1 : 2;
    }
    if (incidences != l->corner_count)
        return fail(c, 0, "edges and faces do not know each other");
    return OSDTEX_OK;
}

static otx_status
check_fans(const checker *c, const otx_topology *t)
{
    const otx_topology_fan *fans = otx_topology_fans(c->run->scratch, t);

    OTX_TRY(otx_run_ok(c->run));
    for (int32_t v = 0; v < t->vert_count; ++v)
    {
        if (fans[v].start >= 0 &&
            otx_topology_fan_size(t, fans[v].start) != fans[v].faces)
            return fail(c, v, "a vertex has more than one fan of faces");
    }
    return OSDTEX_OK;
}

/* The surface is a manifold with one winding. */
static otx_status
check_manifold(const checker *c)
{
    const otx_level *l = c->level;
    otx_topology t;

    if (!otx_topology_build(
            c->run->scratch, l->vert_count, l->face_count, l->face_first,
            l->face_verts, &t))
        return otx_fail_memory(c->run, STAGE);
    if (t.edge_count != l->edge_count)
        return fail(c, 0, "edges are missing or doubled");
    for (int32_t e = 0; e < t.edge_count; ++e)
    {
        const int32_t *corners = t.edge_corners + t.edge_corner_first[e];
        const int32_t size = otx_topology_edge_size(&t, e);

        if (size > 2 || (size == 2 && l->face_verts[corners[0]] ==
                                          l->face_verts[corners[1]]))
            return fail(
                c, t.corner_face[corners[0]],
                "an edge is not manifold or its faces are wound against each "
                "other");
    }
    return check_fans(c, &t);
}

static bool
child_has_vertex(const otx_level *next, int32_t first, int32_t end, int32_t v)
{
    for (int32_t i = next->face_first[first]; i < next->face_first[end]; ++i)
    {
        if (next->face_verts[i] == v)
            return true;
    }
    return false;
}

/* Children are one range that names the parent, and hold the parent's corners
 * under the same numbers and the vertices born from its edges and itself. */
static otx_status
check_children(const checker *c, int32_t face)
{
    const otx_level *l = c->level;
    const otx_level *next = l + 1;
    const int32_t first = l->face_child_first[face];
    const int32_t end = l->face_child_first[face + 1];
    const int32_t own = l->face_child_vert[face];

    if (first >= end || first < 0 || end > next->face_count)
        return fail(c, face, "the range of children is empty or outside");
    for (int32_t k = first; k < end; ++k)
    {
        if (next->face_parent[k] != face ||
            next->face_cage[k] != l->face_cage[face] ||
            next->face_hole[k] != l->face_hole[face])
            return fail(c, face, "a child does not take after its parent");
    }
    for (int32_t i = l->face_first[face]; i < l->face_first[face + 1]; ++i)
    {
        const int32_t born = l->edge_child_vert[l->face_edges[i]];

        if (!child_has_vertex(next, first, end, l->face_verts[i]) ||
            born < l->vert_count || !child_has_vertex(next, first, end, born))
            return fail(c, face, "a vertex is missing from the children");
    }
    if (own != -1 &&
        (own < l->vert_count || !child_has_vertex(next, first, end, own)))
        return fail(c, face, "the face's vertex is missing from the children");
    return OSDTEX_OK;
}

static otx_status
check_hierarchy(const checker *c)
{
    const otx_level *l = c->level;
    const bool is_leaf = c->index == c->surface->level_count - 1;

    for (int32_t f = 0; c->index == 0 && f < l->face_count; ++f)
    {
        if (l->face_cage[f] != f)
            return fail(c, f, "a face of level 0 is not its own ancestor");
    }
    if (is_leaf)
        return OSDTEX_OK;
    if (l->face_child_first[0] != 0 ||
        l->face_child_first[l->face_count] != l[1].face_count)
        return fail(c, 0, "the children do not add up");
    for (int32_t f = 0; f < l->face_count; ++f)
        OTX_TRY(check_children(c, f));
    return OSDTEX_OK;
}

static otx_status
check_level(const checker *c)
{
    OTX_TRY(check_corners(c));
    for (int32_t f = 0; f < c->level->face_count; ++f)
        OTX_TRY(check_face_edges(c, f));
    OTX_TRY(check_edge_faces(c));
    OTX_TRY(check_manifold(c));
    return check_hierarchy(c);
}

static otx_status
check_frame(const checker *c, int32_t v)
{
    const otx_surface *s = c->surface;
    const otx_vec3 p = otx_vec3_load(s->points, v);
    const otx_vec3 n = otx_vec3_load(s->normals, v);
    const otx_vec3 a = otx_vec3_load(s->tangents, 2 * v);
    const otx_vec3 b = otx_vec3_load(s->tangents, 2 * v + 1);

    if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
        return fail(c, v, "a point is not finite");
    if (!(fabs(otx_vec3_length(n) - 1.0) < frame_error) ||
        !(fabs(otx_vec3_length(a) - 1.0) < frame_error) ||
        !(otx_vec3_length(otx_vec3_sub(otx_vec3_cross(a, b), n)) < frame_error))
        return fail(c, v, "tangents and normal are no orthonormal frame");
    return OSDTEX_OK;
}

static otx_status
check_limit(const checker *c)
{
    const otx_surface *s = c->surface;

    for (int32_t v = 0; v < c->level->vert_count; ++v)
        OTX_TRY(check_frame(c, v));
    for (int32_t i = 0; s->uv_count > 0 && i < c->level->corner_count; ++i)
    {
        if (!in_range(s->face_uvs[i], s->uv_count))
            return fail(c, i, "a UV is out of range");
    }
    for (int32_t i = 0; i < 2 * s->uv_count; ++i)
    {
        if (!isfinite(s->uvs[i]))
            return fail(c, i / 2, "a UV is not finite");
    }
    return OSDTEX_OK;
}

otx_status
otx_surface_validate(otx_run *run, const otx_surface *surface)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    checker c = {run, surface, NULL, 0};
    otx_status status = OSDTEX_OK;

    for (; status == OSDTEX_OK && c.index < surface->level_count; ++c.index)
    {
        c.level = &surface->levels[c.index];
        status = check_level(&c);
        otx_arena_release(run->scratch, mark);
    }
    --c.index;
    return status == OSDTEX_OK ? check_limit(&c) : status;
}

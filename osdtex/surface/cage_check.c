/* cage_check.c -- what would crash OpenSubdiv or be swallowed by it.
 *
 * OpenSubdiv 3.5 dies on vertex and hole indices out of range, reads past the
 * end on face-varying ones, and takes NaN, repeated vertices and inconsistent
 * winding without a word. See docs/notes/cage.md for the list. */
#include "surface/cage_check.h"

#include "math/vec.h"

#include <math.h>

#define STAGE "cage"

/* Squares of coordinates, and sums of them, stay finite as float. */
static const float coordinate_max = 1e15f;

/* The same of UVs. */
static const float uv_max = 1e15f;

enum
{
    TWINS_MAX = 8 /* faces of one edge that are compared with each other */
};

/* A face is flat when its area is below this share of its edges' squared
 * lengths: float's resolution, with a margin. */
static const double flat_share = 1e-9;

/* Where a face is, for findings. */
static otx_where
at_face(const otx_cage_input *in, int32_t face)
{
    return (otx_where){
        in->path, in->face_line ? in->face_line[face] : 0, face, -1};
}

static otx_where
at_vertex(const otx_cage_input *in, int32_t vertex)
{
    return (otx_where){
        in->path, in->vert_line ? in->vert_line[vertex] : 0, -1, vertex};
}

/* Keeps the first failure. */
static void
record(otx_status *first, otx_status status)
{
    if (*first == OSDTEX_OK)
        *first = status;
}

static otx_status
check_face_size(otx_run *run, const otx_cage_input *in, int32_t face)
{
    const int64_t size =
        (int64_t)in->face_first[face + 1] - in->face_first[face];
    const otx_where where = at_face(in, face);

    if (size < 3)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
            "face %d has %lld corners; a face needs at least 3, so delete it "
            "or give it more",
            face, (long long)size);
    if (size > OTX_CAGE_VALENCE_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, where,
            "face %d has %lld corners, over the limit of %d; split it", face,
            (long long)size, OTX_CAGE_VALENCE_MAX);
    return OSDTEX_OK;
}

/*   seen  [vert_count], 0 before the first face, marks of the faces so far */
static otx_status
check_face_verts(
    otx_run *run, const otx_cage_input *in, int32_t face, int32_t *seen)
{
    const otx_where where = at_face(in, face);

    for (int32_t i = in->face_first[face]; i < in->face_first[face + 1]; ++i)
    {
        const int32_t v = in->face_verts[i];

        if (v < 0 || v >= in->vert_count)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE, where,
                "face %d refers to vertex %d, but there are only vertices 0 "
                "to %d; export the file again",
                face, v, in->vert_count - 1);
        if (seen[v] == face + 1)
            return otx_fail(
                run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
                "face %d repeats vertex %d; merge its corners or delete it",
                face, v);
        seen[v] = face + 1;
    }
    return OSDTEX_OK;
}

static otx_status
check_triangles(otx_run *run, const otx_cage_input *in)
{
    for (int32_t f = 0; f < in->face_count; ++f)
    {
        const int32_t size = in->face_first[f + 1] - in->face_first[f];

        if (size != 3)
            return otx_fail(
                run, OSDTEX_ERROR_TOPOLOGY, STAGE, at_face(in, f),
                "face %d has %d corners, and Loop subdivides triangles only; "
                "use {scheme} catmark",
                f, size);
    }
    return OSDTEX_OK;
}

otx_status
otx_cage_check_faces(otx_run *run, const otx_cage_input *in, otx_scheme scheme)
{
    otx_where where = OTX_NOWHERE;
    otx_status status = OSDTEX_OK;
    int32_t *seen;

    where.file = in->path;
    if (in->face_count <= 0 || in->vert_count <= 0)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
            "there are no faces to subdivide; export the mesh as polygons");
    seen = OTX_ZNEW(run->scratch, int32_t, in->vert_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < in->face_count; ++f)
    {
        const otx_status size = check_face_size(run, in, f);

        record(&status, size);
        if (size == OSDTEX_OK)
            record(&status, check_face_verts(run, in, f, seen));
    }
    if (status == OSDTEX_OK && scheme == OTX_SCHEME_LOOP)
        return check_triangles(run, in);
    return status;
}

static otx_status
check_point(otx_run *run, const otx_cage_input *in, int32_t vertex)
{
    const float *p = in->points + 3 * (size_t)vertex;

    for (int32_t i = 0; i < 3; ++i)
    {
        if (!isfinite(p[i]))
            return otx_fail(
                run, OSDTEX_ERROR_NUMERIC, STAGE, at_vertex(in, vertex),
                "vertex %d has a coordinate that is not a finite number; "
                "export the file again",
                vertex);
        if (fabsf(p[i]) > coordinate_max)
            return otx_fail(
                run, OSDTEX_ERROR_NUMERIC, STAGE, at_vertex(in, vertex),
                "vertex %d lies at %g, beyond the limit of %g scene units; "
                "scale the model down",
                vertex, (double)p[i], (double)coordinate_max);
    }
    return OSDTEX_OK;
}

otx_status
otx_cage_check_points(otx_run *run, const otx_cage_input *in)
{
    otx_status status = OSDTEX_OK;

    for (int32_t v = 0; v < in->vert_count; ++v)
        record(&status, check_point(run, in, v));
    return status;
}

/* The first UV that is no place in a picture; uv_count: there is none. */
static int32_t
find_bad_uv(const otx_cage_input *in)
{
    int32_t i = 0;

    /* Written so that NaN is bad, too. */
    while (i < in->uv_count && fabsf(in->uvs[2 * (size_t)i]) <= uv_max &&
           fabsf(in->uvs[2 * (size_t)i + 1]) <= uv_max)
        ++i;
    return i;
}

static void
note_bad_uv(otx_run *run, const otx_cage_input *in, int32_t bad)
{
    const float u = in->uvs[2 * (size_t)bad];
    const float v = in->uvs[2 * (size_t)bad + 1];
    otx_where where = OTX_NOWHERE;

    where.file = in->path;
    if (isfinite(u) && isfinite(v))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "UV %d lies at (%g, %g), beyond the limit of %g, so the cage's UVs "
            "are left out; unwrap the cage again to keep them",
            bad, (double)u, (double)v, (double)uv_max);
    else
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "UV %d is not a finite number, so the cage's UVs are left out; "
            "unwrap the cage again to keep them",
            bad);
}

/* Counts corners without UV of a face into *missing. */
static otx_status
check_face_uvs(
    otx_run *run, const otx_cage_input *in, int32_t face, int32_t *missing)
{
    for (int32_t i = in->face_first[face]; i < in->face_first[face + 1]; ++i)
    {
        const int32_t uv = in->face_uvs[i];

        if (uv == -1)
            ++*missing;
        else if (uv < 0 || uv >= in->uv_count)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE, at_face(in, face),
                "face %d refers to UV %d, but there are %d; export the file "
                "again",
                face, uv, in->uv_count);
    }
    return OSDTEX_OK;
}

otx_status
otx_cage_check_uvs(otx_run *run, const otx_cage_input *in, bool *usable)
{
    otx_where where = OTX_NOWHERE;
    otx_status status = OSDTEX_OK;
    int32_t missing = 0;
    int32_t bad;

    *usable = false;
    if (!in->face_uvs || in->uv_count <= 0)
        return OSDTEX_OK;
    for (int32_t f = 0; f < in->face_count; ++f)
    {
        const int32_t before = missing;

        record(&status, check_face_uvs(run, in, f, &missing));
        if (before == 0 && missing > 0)
            where = at_face(in, f);
    }
    OTX_TRY(status);
    if (missing == in->face_first[in->face_count])
        return OSDTEX_OK;
    where.file = in->path;
    bad = find_bad_uv(in);
    *usable = missing == 0 && bad == in->uv_count;
    if (missing > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "%d corners have no UV (first in face %d), so the cage's UVs are "
            "left out; unwrap the whole cage to keep them",
            missing, where.face);
    else if (!*usable)
        note_bad_uv(run, in, bad);
    return OSDTEX_OK;
}

/* Whether two faces have the same corners in the same cyclic order, or, of
 * step -1, in the opposite one. */
static bool
same_face(const otx_topology *t, int32_t a, int32_t b, int32_t step)
{
    const int32_t size = t->face_first[a + 1] - t->face_first[a];
    const int32_t *va = t->face_verts + t->face_first[a];
    const int32_t *vb = t->face_verts + t->face_first[b];
    int32_t shift = 0;

    if (t->face_first[b + 1] - t->face_first[b] != size)
        return false;
    while (shift < size && vb[shift] != va[0])
        ++shift;
    for (int32_t k = 0; k < size; ++k)
    {
        if (shift == size || va[k] != vb[(shift + step * k + size) % size])
            return false;
    }
    return true;
}

/* Whether two half-edges of one edge start at the same vertex. */
static bool
same_direction(const otx_topology *t, int32_t corner_a, int32_t corner_b)
{
    return t->face_verts[corner_a] == t->face_verts[corner_b];
}

/* Two faces at an edge with all corners in common. Of an edge with two faces
 * they must be wound alike: two sides of a sheet are a surface. */
static bool
find_twins(const otx_topology *t, int32_t edge, int32_t *a, int32_t *b)
{
    const int32_t *corners = t->edge_corners + t->edge_corner_first[edge];
    const int32_t edge_size = otx_topology_edge_size(t, edge);
    const int32_t size = edge_size < TWINS_MAX ? edge_size : TWINS_MAX;

    for (int32_t j = 1; j < size; ++j)
        for (int32_t i = 0; i < j; ++i)
        {
            const bool alike = same_direction(t, corners[i], corners[j]);

            *a = t->corner_face[corners[i]];
            *b = t->corner_face[corners[j]];
            if ((alike || edge_size > 2) &&
                same_face(t, *a, *b, alike ? 1 : -1))
                return true;
        }
    return false;
}

static otx_status
check_edge(
    otx_run *run, const otx_cage_input *in, const otx_topology *t, int32_t edge)
{
    const int32_t *verts = t->edge_verts + 2 * (size_t)edge;
    const int32_t *corners = t->edge_corners + t->edge_corner_first[edge];
    const int32_t size = otx_topology_edge_size(t, edge);
    int32_t a, b;

    if (size < 2)
        return OSDTEX_OK;
    if (find_twins(t, edge, &a, &b))
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, at_face(in, b),
            "face %d has the same corners as face %d; delete one of them", b,
            a);
    a = t->corner_face[corners[0]];
    b = t->corner_face[corners[1]];
    if (size > 2)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, at_face(in, a),
            "%d faces (%d, %d, %d%s) share the edge between vertices %d and "
            "%d; at most 2 may, so detach the others",
            size, a, b, t->corner_face[corners[2]], size > 3 ? ", …" : "",
            verts[0], verts[1]);
    if (same_direction(t, corners[0], corners[1]))
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, at_face(in, a),
            "faces %d and %d are wound against each other at the edge between "
            "vertices %d and %d; flip one of them",
            a, b, verts[0], verts[1]);
    return OSDTEX_OK;
}

static otx_status
check_fan(
    otx_run *run, const otx_cage_input *in, const otx_topology *t,
    int32_t vertex, otx_topology_fan f)
{
    otx_where where = at_face(in, t->corner_face[f.start]);

    where.vertex = vertex;
    if (f.faces + (f.border > 0) > OTX_CAGE_VALENCE_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, where,
            "vertex %d joins %d faces, over the limit of %d; dissolve some of "
            "its edges",
            vertex, f.faces, OTX_CAGE_VALENCE_MAX);
    return OSDTEX_OK;
}

/* Parts that touch only at vertices are parted there (surface/pinch.h).
 *
 *   used  vertices with faces */
static otx_status
count_pinches(
    otx_run *run, const otx_cage_input *in, const otx_topology *t,
    const otx_topology_fan *fans, int32_t used, int32_t *split_count)
{
    const int32_t count = otx_topology_fan_count(run->scratch, t);
    otx_where where = OTX_NOWHERE;
    int32_t pinches = 0;

    if (count < 0)
        return otx_fail_memory(run, STAGE);
    *split_count = count - used;
    if (count == used)
        return OSDTEX_OK;
    for (int32_t v = 0; v < t->vert_count; ++v)
    {
        if (fans[v].start < 0 ||
            otx_topology_fan_size(t, fans[v].start) == fans[v].faces ||
            pinches++ > 0)
            continue;
        where = at_face(in, t->corner_face[fans[v].start]);
        where.vertex = v;
    }
    otx_note(
        run, OSDTEX_SEVERITY_WARNING, STAGE, where,
        "parts of the mesh touch only at %d %s (first is vertex %d, at face "
        "%d); each part gets a vertex of its own there, and its corner stays "
        "where it is",
        pinches, pinches == 1 ? "vertex" : "vertices", where.vertex,
        where.face);
    return OSDTEX_OK;
}

static bool
is_welded_away(const otx_cage_input *in, int32_t vertex)
{
    return in->welded && in->welded[vertex] != vertex;
}

static otx_status
check_fans(
    otx_run *run, const otx_cage_input *in, const otx_topology *t, bool plain,
    int32_t *split_count)
{
    const otx_topology_fan *fans = otx_topology_fans(run->scratch, t);
    otx_status status = OSDTEX_OK;
    int32_t isolated = 0, unused = 0;
    otx_where where = OTX_NOWHERE;

    *split_count = 0;
    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < t->vert_count; ++v)
    {
        if (fans[v].start < 0 && !is_welded_away(in, v) && isolated++ == 0)
            where = at_vertex(in, v);
        unused += fans[v].start < 0;
        if (fans[v].start >= 0 && !plain)
            record(&status, check_fan(run, in, t, v, fans[v]));
    }
    if (status == OSDTEX_OK && isolated > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "%d vertices belong to no face (first is vertex %d); they are "
            "kept, and have no effect",
            isolated, where.vertex);
    if (plain || status != OSDTEX_OK)
        return status;
    return count_pinches(run, in, t, fans, t->vert_count - unused, split_count);
}

/* A plain mesh is not refused for what it is not: where it is no manifold it
 * ends, and textures do not go on there. */
static void
note_cut(
    otx_run *run, const otx_cage_input *in, const otx_topology *t, int32_t edge)
{
    const int32_t *verts = t->edge_verts + 2 * (size_t)edge;
    const int32_t *corners = t->edge_corners + t->edge_corner_first[edge];
    const int32_t size = otx_topology_edge_size(t, edge);
    const int32_t face = t->corner_face[corners[0]];

    if (size > 2)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, at_face(in, face),
            "%d faces share the edge between vertices %d and %d; the texture "
            "is cut there",
            size, verts[0], verts[1]);
    else if (size == 2 && same_direction(t, corners[0], corners[1]))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, at_face(in, face),
            "faces %d and %d are wound against each other at the edge between "
            "vertices %d and %d; the texture is cut there, and on one of them "
            "it is mirrored: flip that one",
            face, t->corner_face[corners[1]], verts[0], verts[1]);
}

otx_status
otx_cage_check_manifold(
    otx_run *run, const otx_cage_input *in, const otx_topology *t,
    otx_scheme scheme, int32_t *split_count)
{
    const bool plain = scheme == OTX_SCHEME_NONE;
    otx_status status = OSDTEX_OK;

    for (int32_t e = 0; e < t->edge_count; ++e)
    {
        if (plain)
            note_cut(run, in, t, e);
        else
            record(&status, check_edge(run, in, t, e));
    }
    OTX_TRY(status);
    return check_fans(run, in, t, plain, split_count);
}

/* Whether the area vector of a face (Newell's sum) vanishes beside its edges.
 */
static bool
is_flat(const otx_cage_input *in, int32_t face)
{
    const int32_t first = in->face_first[face];
    const int32_t size = in->face_first[face + 1] - first;
    const otx_vec3 origin = otx_vec3_load(in->points, in->face_verts[first]);
    otx_vec3 area2 = {0.0, 0.0, 0.0};
    double edges_sq = 0.0;

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec3 p = otx_vec3_sub(
            otx_vec3_load(in->points, in->face_verts[first + k]), origin);
        const otx_vec3 q = otx_vec3_sub(
            otx_vec3_load(in->points, in->face_verts[first + (k + 1) % size]),
            origin);
        const otx_vec3 edge = otx_vec3_sub(q, p);

        area2 = otx_vec3_add(area2, otx_vec3_cross(p, q));
        edges_sq += otx_vec3_dot(edge, edge);
    }
    return !(otx_vec3_length(area2) > flat_share * edges_sq);
}

void
otx_cage_check_areas(otx_run *run, const otx_cage_input *in)
{
    for (int32_t f = 0; f < in->face_count; ++f)
    {
        if (is_flat(in, f))
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, at_face(in, f),
                "face %d has no area; the texture on it may look stretched", f);
    }
}

/* sheet.c -- variables from (vertex, patch) pairs. */
#include "relax/sheet.h"

#include "base/csr.h"
#include "relax/sheet_check.h"

#include <assert.h>

/* Corners of every vertex. */
static bool
vertex_corners(
    const otx_level *leaf, otx_arena *arena, int32_t **first, int32_t **corner)
{
    int32_t *start = OTX_ZNEW(arena, int32_t, (int64_t)leaf->vert_count + 2);
    int32_t *list = OTX_NEW(arena, int32_t, leaf->corner_count);

    if (!start || !list)
        return false;
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        otx_csr_count(start, leaf->face_verts[c], 1);
    otx_csr_sum(start, leaf->vert_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        list[otx_csr_place(start, leaf->face_verts[c])] = c;
    *first = start;
    *corner = list;
    return true;
}

/* The patches of the faces that are taken, -1 elsewhere. */
static const int32_t *
taken(
    const otx_level *leaf, otx_arena *arena, const int32_t *face_patch,
    const uint8_t *inside)
{
    int32_t *patch;

    if (!inside)
        return face_patch;
    patch = OTX_NEW(arena, int32_t, leaf->face_count);
    for (int32_t f = 0; patch && f < leaf->face_count; ++f)
        patch[f] = inside[f] ? face_patch[f] : -1;
    return patch;
}

/* The patch of every corner, -1 where there is none. */
static int32_t *
corner_patches(
    const otx_level *leaf, otx_arena *arena, const int32_t *face_patch)
{
    int32_t *patch = OTX_NEW(arena, int32_t, leaf->corner_count);

    for (int32_t f = 0; patch && f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
            patch[c] = face_patch[f];
    return patch;
}

/* Marks the variables that faces outside have too. */
static void
fix_rim(
    const otx_level *leaf, const int32_t *first, const int32_t *corner,
    const int32_t *patch, const int32_t *variable, const int32_t *all,
    const uint8_t *inside, otx_sheet *s)
{
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        if (inside[f] || all[f] < 0)
            continue;
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            const int32_t v = leaf->face_verts[c];

            for (int32_t i = first[v]; i < first[v + 1]; ++i)
                if (patch[corner[i]] == all[f])
                    s->fixed[variable[corner[i]]] = 1;
        }
    }
}

/* Marks the variables of faces that are still. */
static void
fix_still(
    const otx_level *leaf, const uint8_t *still, const int32_t *variable,
    otx_sheet *s)
{
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f];
             still[f] && c < leaf->face_first[f + 1]; ++c)
            if (variable[c] >= 0)
                s->fixed[variable[c]] = 1;
}

/* One variable for each patch around each vertex; variable[corner], -1 none. */
static void
number_variables(
    const otx_level *leaf, const int32_t *first, const int32_t *corner,
    const int32_t *patch, const otx_vec2 *uvs, otx_sheet *s, int32_t *variable)
{
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        for (int32_t i = first[v]; i < first[v + 1]; ++i)
        {
            const int32_t c = corner[i];
            int32_t j = first[v];

            variable[c] = -1;
            if (patch[c] < 0)
                continue;
            while (patch[corner[j]] != patch[c])
                ++j;
            if (j < i)
            {
                variable[c] = variable[corner[j]];
                continue;
            }
            s->verts[s->count] = v;
            s->patches[s->count] = patch[c];
            s->at[s->count] = uvs[c];
            variable[c] = s->count++;
        }
}

static void
list_faces(
    const otx_level *leaf, const int32_t *face_patch, const int32_t *variable,
    otx_sheet *s)
{
    int32_t n = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        if (face_patch[f] < 0)
            continue;
        s->first[s->face_count++] = n;
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            s->corners[n] = variable[c];
            s->corner_leaf[n++] = c;
        }
    }
    s->first[s->face_count] = n;
}

/* Variables at the two ends of an edge, in the order of edge_verts. */
static void
side(
    const otx_level *leaf, int32_t edge, int32_t face, const int32_t *variable,
    int32_t out[2])
{
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    int32_t k = 0;

    while (leaf->face_edges[first + k] != edge)
        ++k;
    out[0] = variable[first + k];
    out[1] = variable[first + (k + 1) % size];
    if (leaf->face_verts[first + k] != leaf->edge_verts[2 * (size_t)edge])
    {
        const int32_t swap = out[0];

        out[0] = out[1];
        out[1] = swap;
    }
}

static void
list_seams(
    const otx_surface *surface, double texels, const int32_t *face_patch,
    const int32_t *variable, otx_sheet *s)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
        const int32_t *v = leaf->edge_verts + 2 * (size_t)e;
        otx_sheet_seam *seam = &s->seams[s->seam_count];

        if (f[0] < 0 || f[1] < 0 || face_patch[f[0]] < 0 ||
            face_patch[f[1]] < 0 || face_patch[f[0]] == face_patch[f[1]])
            continue;
        side(leaf, e, f[0], variable, seam->a);
        side(leaf, e, f[1], variable, seam->b);
        seam->length = texels * otx_surface_density(surface, v, 2) *
                       otx_vec3_length(otx_vec3_sub(
                           otx_vec3_load(surface->points, v[0]),
                           otx_vec3_load(surface->points, v[1])));
        ++s->seam_count;
    }
}

otx_status
otx_sheet_build(
    otx_run *run, const otx_surface *surface, double texels,
    const int32_t *face_patch, const otx_sheet_part *part, const otx_vec2 *uvs,
    otx_sheet *out)
{
    const uint8_t *inside = part ? part->inside : NULL;
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_arena *arena = run->scratch;
    int32_t *first, *corner;
    const int32_t *faces = taken(leaf, arena, face_patch, inside);
    const int32_t *patch = faces ? corner_patches(leaf, arena, faces) : NULL;
    int32_t *variable = OTX_NEW(arena, int32_t, leaf->corner_count);
    otx_rigid_mesh mesh;

    *out = (otx_sheet){0};
    out->fixed = OTX_ZNEW(arena, uint8_t, leaf->corner_count);
    out->first = OTX_NEW(arena, int32_t, leaf->face_count + 1);
    out->corners = OTX_NEW(arena, int32_t, leaf->corner_count);
    out->corner_leaf = OTX_NEW(arena, int32_t, leaf->corner_count);
    out->verts = OTX_NEW(arena, int32_t, leaf->corner_count);
    out->patches = OTX_NEW(arena, int32_t, leaf->corner_count);
    out->at = OTX_NEW(arena, otx_vec2, leaf->corner_count);
    out->seams = OTX_NEW(arena, otx_sheet_seam, leaf->edge_count + 1);
    if (!patch || !variable || !out->fixed || !out->first || !out->corners ||
        !out->corner_leaf || !out->verts || !out->patches || !out->at ||
        !out->seams || !vertex_corners(leaf, arena, &first, &corner))
        return otx_fail_memory(run, "relax");
    number_variables(leaf, first, corner, patch, uvs, out, variable);
    if (inside)
        fix_rim(leaf, first, corner, patch, variable, face_patch, inside, out);
    if (part && part->still)
        fix_still(leaf, part->still, variable, out);
    list_faces(leaf, faces, variable, out);
    list_seams(surface, texels, faces, variable, out);
    mesh = (otx_rigid_mesh){out->face_count, out->count,      out->first,
                            out->corners,    out->verts,      surface->points,
                            texels,          surface->density};
    if (otx_rigid_build(arena, &mesh, &out->rigid) != OSDTEX_OK)
        return otx_fail_memory(run, "relax");
    assert(!otx_sheet_check(out, surface));
    return OSDTEX_OK;
}

void
otx_sheet_store(const otx_sheet *sheet, otx_vec2 *uvs)
{
    for (int32_t i = 0; i < sheet->first[sheet->face_count]; ++i)
        uvs[sheet->corner_leaf[i]] = sheet->at[sheet->corners[i]];
}

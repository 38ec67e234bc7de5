/* tile_check.c -- samples along edges and at vertices, and counts of cells. */
#include "mapping/tile_check.h"

#include "image/view.h"

#include <math.h>
#include <string.h>

static otx_vec2
uv_of(const otx_mapping *mapping, int32_t corner)
{
    const float *uv = mapping->uvs + 2 * (size_t)corner;

    return (otx_vec2){uv[0], uv[1]};
}

static void
sample(const otx_image *level, otx_vec2 uv, float *color)
{
    otx_view_value(
        otx_view_of(level, false, false),
        (otx_vec2){uv.x * level->width, uv.y * level->height}, color);
}

/* The corner of `face` at the start of `edge`'s first vertex and at the other,
 * whichever way the face goes along it. */
static void
corners_on(
    const otx_level *leaf, int32_t face, int32_t edge, int32_t *first,
    int32_t *second)
{
    const int32_t *verts = leaf->edge_verts + 2 * (size_t)edge;

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        if (leaf->face_verts[c] == verts[0])
            *first = c;
        if (leaf->face_verts[c] == verts[1])
            *second = c;
    }
}

/* Whether two faces with different tiles meet at the edge. */
static bool
parts_tiles(const otx_mapping *mapping, const otx_level *leaf, int32_t edge)
{
    const int32_t *faces = leaf->edge_faces + 2 * (size_t)edge;

    return faces[0] >= 0 && faces[1] >= 0 &&
           mapping->face_patch[faces[0]] >= 0 &&
           mapping->face_patch[faces[1]] >= 0 &&
           mapping->face_patch[faces[0]] != mapping->face_patch[faces[1]];
}

static double
edge_mismatch(
    const otx_mapping *mapping, const otx_level *leaf, int32_t edge,
    const otx_image *level, int32_t samples)
{
    int32_t corners[2][2] = {{0, 0}, {0, 0}};
    double most = 0.0;

    for (int32_t i = 0; i < 2; ++i)
        corners_on(
            leaf, leaf->edge_faces[2 * (size_t)edge + (size_t)i], edge,
            &corners[i][0], &corners[i][1]);
    for (int32_t k = 0; k < samples; ++k)
    {
        float color[2][OTX_IMAGE_MAX_CHANNELS];

        for (int32_t i = 0; i < 2; ++i)
            sample(
                level,
                otx_vec2_lerp(
                    uv_of(mapping, corners[i][0]),
                    uv_of(mapping, corners[i][1]), k / (samples - 1.0)),
                color[i]);
        for (int32_t c = 0; c < level->channels; ++c)
            most = fmax(most, fabs((double)color[0][c] - color[1][c]));
    }
    return most;
}

/* Largest spread of a channel over the faces around a vertex. */
static otx_status
corner_mismatch(
    otx_run *run, const otx_mapping *mapping, const otx_level *leaf,
    const otx_image *level, double *out)
{
    const size_t channels = (size_t)level->channels;
    const size_t count = (size_t)leaf->vert_count * channels;
    float *low = OTX_NEW(run->scratch, float, count);
    float *high = OTX_NEW(run->scratch, float, count);

    OTX_TRY(otx_run_ok(run));
    for (size_t i = 0; i < count; ++i)
    {
        low[i] = INFINITY;
        high[i] = -INFINITY;
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = leaf->face_first[f];
             k < leaf->face_first[f + 1] && mapping->face_patch[f] >= 0; ++k)
        {
            const size_t at = (size_t)leaf->face_verts[k] * channels;
            float color[OTX_IMAGE_MAX_CHANNELS];

            sample(level, uv_of(mapping, k), color);
            for (size_t c = 0; c < channels; ++c)
            {
                low[at + c] = fminf(low[at + c], color[c]);
                high[at + c] = fmaxf(high[at + c], color[c]);
            }
        }
    *out = 0.0;
    for (size_t i = 0; i < count; ++i)
        if (high[i] >= low[i])
            *out = fmax(*out, (double)high[i] - low[i]);
    return OSDTEX_OK;
}

otx_status
otx_tile_check_match(
    otx_run *run, const otx_mapping *mapping, const otx_image *level,
    int32_t samples, otx_tile_match *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    out->edge = 0.0;
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        if (parts_tiles(mapping, leaf, e))
            out->edge = fmax(
                out->edge, edge_mismatch(mapping, leaf, e, level, samples));
    OTX_TRY(corner_mismatch(run, mapping, leaf, level, &out->corner));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* ------------------------------------------------------------------- use */

/* The cell that a leaf face lies in. */
static int32_t
cell_of(const otx_mapping *mapping, const otx_tile_layout *layout, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const int32_t first = leaf->face_first[face];
    const otx_vec2 middle =
        otx_vec2_lerp(uv_of(mapping, first), uv_of(mapping, first + 2), 0.5);

    return (int32_t)(middle.y * layout->rows) * layout->columns +
           (int32_t)(middle.x * layout->columns);
}

/* Cells of the patches, -1 for those without a face, and their counts. */
static void
count_cells(
    const otx_mapping *mapping, const otx_tile_layout *layout,
    int32_t *patch_cell, int32_t *uses)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t patch = mapping->face_patch[f];

        if (patch < 0 || patch_cell[patch] >= 0)
            continue;
        patch_cell[patch] = cell_of(mapping, layout, f);
        ++uses[patch_cell[patch]];
    }
}

/* Tiles that meet at vertices: every corner of a tile is looked at from the
 * faces that come later. Lists of (tile) run through the leaf corners. */
static otx_status
count_vertices(
    otx_run *run, const otx_mapping *mapping, const int32_t *patch_cell,
    otx_tile_use *out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    int32_t *head = OTX_NEW(run->scratch, int32_t, leaf->vert_count);
    int32_t *next = OTX_NEW(run->scratch, int32_t, leaf->corner_count);
    int32_t *patch = OTX_NEW(run->scratch, int32_t, leaf->corner_count);

    OTX_TRY(otx_run_ok(run));
    memset(head, -1, (size_t)leaf->vert_count * sizeof *head);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            patch[c] = mapping->face_patch[f];
            next[c] = head[leaf->face_verts[c]];
            head[leaf->face_verts[c]] = c;
        }
    for (int32_t v = 0; v < leaf->vert_count; ++v)
    {
        bool meets = false, equal = false;

        for (int32_t a = head[v]; a >= 0; a = next[a])
            for (int32_t b = next[a]; b >= 0 && patch[a] >= 0; b = next[b])
            {
                const bool apart = patch[b] >= 0 && patch[a] != patch[b];

                meets |= apart;
                equal |= apart && patch_cell[patch[a]] == patch_cell[patch[b]];
            }
        out->vertices += meets;
        out->equal_at += equal;
    }
    return OSDTEX_OK;
}

otx_status
otx_tile_check_use(
    otx_run *run, const otx_mapping *mapping, const otx_tile_layout *layout,
    otx_tile_use *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const int32_t cells = layout->columns * layout->rows;
    int32_t *patch_cell = OTX_NEW(run->scratch, int32_t, mapping->patch_count);
    int32_t *uses = OTX_ZNEW(run->scratch, int32_t, cells);

    *out = (otx_tile_use){.tiles = layout->names ? layout->name_count : cells};
    OTX_TRY(otx_run_ok(run));
    memset(patch_cell, -1, (size_t)mapping->patch_count * sizeof *patch_cell);
    count_cells(mapping, layout, patch_cell, uses);
    out->least = INT32_MAX;
    for (int32_t i = 0; i < out->tiles; ++i)
    {
        out->used += uses[i] > 0;
        out->least = uses[i] < out->least ? uses[i] : out->least;
        out->most = uses[i] > out->most ? uses[i] : out->most;
        out->mean += (double)uses[i] / out->tiles;
    }
    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *faces = leaf->edge_faces + 2 * (size_t)e;

        if (!parts_tiles(mapping, leaf, e))
            continue;
        ++out->edges;
        out->equal += patch_cell[mapping->face_patch[faces[0]]] ==
                      patch_cell[mapping->face_patch[faces[1]]];
    }
    OTX_TRY(count_vertices(run, mapping, patch_cell, out));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* layout.c -- texture coordinates of the leaves, charts and tiles. */
#include "bake/layout.h"

#include "bake/charts.h"
#include "bake/fvar_linear.h"
#include "image/udim.h"
#include "math/vec.h"
#include "surface/draft.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    MARGIN_OWN = 16 /* texels continued beyond the rims of own UVs */
};

/* ---- coordinates --------------------------------------------------------- */

static otx_status
use_own(otx_run *run, otx_layout *out)
{
    const otx_surface *surface = out->surface;
    const int32_t corners = otx_surface_leaf(surface)->corner_count;
    float *leaf_uvs = OTX_NEW(run->arena, float, 2 * (size_t)corners);

    OTX_TRY(otx_run_ok(run));
    for (int32_t c = 0; c < corners; ++c)
        memcpy(
            leaf_uvs + 2 * (size_t)c,
            surface->uvs + 2 * (size_t)surface->face_uvs[c],
            2 * sizeof *leaf_uvs);
    out->uv_count = surface->cage->uv_count;
    out->uvs = surface->cage->uvs;
    out->face_uvs = surface->cage->face_uvs;
    out->leaf_uvs = leaf_uvs;
    return OSDTEX_OK;
}

static otx_status
make_atlas(
    otx_run *run, const otx_layout_options *options, bool charts,
    otx_layout *out)
{
    const otx_surface *surface = out->surface;
    const int32_t cage_corners = surface->cage->corner_count;
    const int32_t corners = otx_surface_leaf(surface)->corner_count;
    const otx_atlas_options how = {
        options->side, options->margin, options->texels_per_unit};
    float *leaf_uvs = OTX_NEW(run->arena, float, 2 * (size_t)corners);
    int32_t *face_uvs;
    otx_atlas atlas;

    OTX_TRY(otx_run_ok(run));
    out->is_atlas = true;
    out->leaf_uvs = leaf_uvs;
    out->is_charts = charts;
    if (charts)
    {
        OTX_TRY(otx_charts_make(run, surface, &how, &atlas));
        out->uv_count = atlas.uv_count;
        out->uvs = atlas.uvs;
        out->face_uvs = atlas.corner_index;
        out->margin = atlas.margin;
        return otx_fvar_linear(run, surface, atlas.corner_uvs, leaf_uvs);
    }
    OTX_TRY(otx_atlas_pack(run, surface, &how, &atlas));
    otx_atlas_tell(run, &atlas);
    OTX_TRY(otx_fvar_linear(run, surface, atlas.uvs, leaf_uvs));
    face_uvs = OTX_NEW(run->arena, int32_t, cage_corners);
    OTX_TRY(otx_run_ok(run));
    for (int32_t c = 0; c < cage_corners; ++c)
        face_uvs[c] = c;
    out->uv_count = cage_corners;
    out->uvs = atlas.uvs;
    out->face_uvs = face_uvs;
    out->margin = atlas.margin;
    return OSDTEX_OK;
}

/* Own UVs or an atlas, judged by a draft of the cage as it was, or would be,
 * before the mapping was made. */
static otx_status
choose_source(
    otx_run *run, const otx_surface *surface, otx_layout_source asked,
    otx_layout_source *out)
{
    otx_run aside = *run;
    otx_uv_survey survey;
    otx_surface draft;
    otx_status status;

    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = otx_surface_draft(
        &aside, surface->cage, surface->level_count - 1, &draft);
    if (status == OSDTEX_OK)
        status = otx_uv_choose(&aside, &draft, asked, out, &survey);
    otx_arena_destroy(aside.arena);
    return status;
}

static otx_status
place_leaves(otx_run *run, const otx_layout_options *options, otx_layout *out)
{
    otx_layout_source source;

    OTX_TRY(choose_source(run, out->surface, options->source, &source));
    if (source != OTX_LAYOUT_OWN)
        return make_atlas(run, options, source == OTX_LAYOUT_CHARTS, out);
    out->margin = options->margin > 0 ? options->margin : MARGIN_OWN;
    return use_own(run, out);
}

/* ---- covered faces, rims, charts ------------------------------------------
 */

static bool
is_finite(const float *uvs, int32_t first, int32_t end)
{
    for (size_t k = 2 * (size_t)first; k < 2 * (size_t)end; ++k)
        if (!isfinite(uvs[k]))
            return false;
    return true;
}

static otx_status
find_covered(otx_run *run, const otx_mapping *mapping, otx_layout *out)
{
    const otx_level *leaf = otx_surface_leaf(out->surface);
    uint8_t *covered = OTX_NEW(run->arena, uint8_t, leaf->face_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t first = leaf->face_first[f],
                      end = leaf->face_first[f + 1];

        covered[f] = !(leaf->face_hole && leaf->face_hole[f]) &&
                     mapping->face_patch[f] >= 0 &&
                     is_finite(mapping->uvs, first, end) &&
                     is_finite(out->leaf_uvs, first, end);
        count += covered[f];
    }
    out->covered = covered;
    if (count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, OTX_NOWHERE,
            "there is no face to bake: all are holes or have no texture");
    return OSDTEX_OK;
}

static int32_t
next_corner(const otx_level *level, int32_t face, int32_t corner)
{
    return corner + 1 == level->face_first[face + 1] ? level->face_first[face]
                                                     : corner + 1;
}

static bool
is_same(const float *uvs, int32_t a, int32_t b)
{
    return uvs[2 * (size_t)a] == uvs[2 * (size_t)b] &&
           uvs[2 * (size_t)a + 1] == uvs[2 * (size_t)b + 1];
}

/* The corner of the face across from which the shared edge runs back; -1 at a
 * boundary or beside what is not covered. */
static int32_t
twin_of(const otx_layout *layout, int32_t face, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t edge = leaf->face_edges[leaf->face_first[face] + k];
    const int32_t other = otx_layout_across(layout, face, k);

    if (other < 0)
        return -1;
    for (int32_t c = leaf->face_first[other]; c < leaf->face_first[other + 1];
         ++c)
        if (leaf->face_edges[c] == edge)
            return c;
    return -1;
}

/* Whether the texture ends at an edge: nothing beyond, or placed elsewhere.
 * Children of an edge get their coordinates by the same sums on both sides, so
 * where they hang together they are equal to the bit. */
static bool
is_rim(const otx_layout *layout, int32_t face, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t corner = leaf->face_first[face] + k;
    const int32_t twin = twin_of(layout, face, k);

    if (twin < 0)
        return true;

    const int32_t other = otx_level_neighbour(leaf, face, k);

    return !is_same(layout->leaf_uvs, corner, next_corner(leaf, other, twin)) ||
           !is_same(layout->leaf_uvs, next_corner(leaf, face, corner), twin);
}

static otx_status
find_rims(otx_run *run, otx_layout *out)
{
    const otx_level *leaf = otx_surface_leaf(out->surface);
    uint8_t *rim = OTX_ZNEW(run->arena, uint8_t, leaf->corner_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; out->covered[f] && k < otx_level_face_size(leaf, f);
             ++k)
            rim[leaf->face_first[f] + k] = is_rim(out, f, k);
    out->rim = rim;
    return OSDTEX_OK;
}

/* Labels all faces that are reached from `seed` without crossing a rim. */
static void
flood(const otx_layout *layout, int32_t seed, int32_t *queue, int32_t *chart)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    int32_t count = 0;

    chart[seed] = seed;
    queue[count++] = seed;
    for (int32_t i = 0; i < count; ++i)
    {
        const int32_t f = queue[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t g = otx_level_neighbour(leaf, f, k);

            if (layout->rim[leaf->face_first[f] + k] || chart[g] >= 0)
                continue;
            chart[g] = seed;
            queue[count++] = g;
        }
    }
}

static otx_status
find_charts(otx_run *run, otx_layout *out)
{
    const otx_level *leaf = otx_surface_leaf(out->surface);
    int32_t *chart = OTX_NEW(run->arena, int32_t, leaf->face_count);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *queue = OTX_NEW(run->scratch, int32_t, leaf->face_count);

    OTX_TRY(otx_run_ok(run));
    memset(chart, -1, (size_t)leaf->face_count * sizeof *chart);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (out->covered[f] && chart[f] < 0)
            flood(out, f, queue, chart);
    otx_arena_release(run->scratch, mark);
    out->chart = chart;
    return OSDTEX_OK;
}

/* ---- tiles ----------------------------------------------------------------
 */

/* How far a leaf face may reach beyond the tiles that there are, where it is
 * cut off: about a texel. Whether the UVs can be baked onto was decided on a
 * draft, between whose corners a curved border bulges by less. */
static const double BULGE = 1e-3;

/* The tiles that a face reaches into, as ranges of columns and rows. */
typedef struct span
{
    int32_t column, column_end, row, row_end;
} span;

static int32_t
clamp(double x, int32_t low, int32_t high)
{
    return (int32_t)fmin(fmax(x, low), high);
}

/*   count  of columns or rows that there are */
static void
span_along(double low, double high, int32_t count, int32_t *first, int32_t *end)
{
    const double over = fmin(OTX_UDIM_OVER, 0.25 * (high - low));

    *first = clamp(floor(low + over), 0, count - 1);
    *end = clamp(floor(high - over) + 1.0, *first + 1, count);
}

static bool
span_of(const otx_layout *layout, int32_t face, span *out)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        for (int32_t i = 0; i < 2; ++i)
        {
            const double x = layout->leaf_uvs[2 * (size_t)c + (size_t)i];

            low[i] = fmin(low[i], x);
            high[i] = fmax(high[i], x);
        }
    if (!(low[0] > -BULGE && low[1] > -BULGE &&
          high[0] < OTX_UDIM_COLUMNS + BULGE &&
          high[1] < OTX_UDIM_ROWS + BULGE))
        return false;
    span_along(
        low[0], high[0], OTX_UDIM_COLUMNS, &out->column, &out->column_end);
    span_along(low[1], high[1], OTX_UDIM_ROWS, &out->row, &out->row_end);
    /* The last place of the last row would be 10000. */
    return out->row_end < OTX_UDIM_ROWS || out->column_end < OTX_UDIM_COLUMNS;
}

/* The corner of a leaf face that is farthest beyond the tiles. */
static const float *
outermost_uv(const otx_layout *layout, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const float *best = NULL;
    double most = -INFINITY;

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const float *uv = layout->leaf_uvs + 2 * (size_t)c;
        const double beyond = fmax(
            fmax(-uv[0], uv[0] - (double)OTX_UDIM_COLUMNS),
            fmax(-uv[1], uv[1] - (double)OTX_UDIM_ROWS));

        if (best && !(beyond > most))
            continue;
        best = uv;
        most = beyond;
    }
    return best;
}

static otx_status
outside(otx_run *run, const otx_layout *layout, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const float *uv = outermost_uv(layout, face);
    const otx_cage *cage = layout->surface->cage;
    otx_where where = OTX_NOWHERE;

    where.file = cage->path;
    where.face = leaf->face_cage[face];
    where.line = cage->face_line ? cage->face_line[where.face] : 0;
    return otx_fail(
        run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
        "face %d has UVs near (%g, %g), outside of the UDIM tiles 1001 to "
        "9999; move them to u from 0 to 10 and v from 0, or bake to an atlas",
        where.face, (double)uv[0], (double)uv[1]);
}

/* Counts or lists the faces of every tile.
 *
 *   counts  [columns * rows] faces of a tile; when listing, where the next
 *           goes
 *   faces   NULL to count */
static otx_status
visit_tiles(
    otx_run *run, const otx_layout *layout, int32_t *counts, int32_t *faces)
{
    const int32_t face_count = otx_surface_leaf(layout->surface)->face_count;
    span s;

    for (int32_t f = 0; f < face_count; ++f)
    {
        if (!layout->covered[f])
            continue;
        if (!span_of(layout, f, &s))
            return outside(run, layout, f);
        for (int32_t y = s.row; y < s.row_end; ++y)
            for (int32_t x = s.column; x < s.column_end; ++x)
            {
                int32_t *count = &counts[y * OTX_UDIM_COLUMNS + x];

                if (faces)
                    faces[*count] = f;
                ++*count;
            }
    }
    return OSDTEX_OK;
}

static otx_status
list_tiles(otx_run *run, otx_layout *out, int32_t *counts)
{
    const int32_t numbers = OTX_UDIM_COLUMNS * OTX_UDIM_ROWS;
    int64_t total = 0;
    int32_t *tiles, *first, *faces;

    OTX_TRY(visit_tiles(run, out, counts, NULL));
    for (int32_t i = 0; i < numbers; ++i)
    {
        out->tile_count += counts[i] > 0;
        total += counts[i];
    }
    if (total > INT32_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "the faces reach over too many UDIM tiles; repair the UVs");
    tiles = OTX_NEW(run->arena, int32_t, out->tile_count);
    first = OTX_NEW(run->arena, int32_t, out->tile_count + 1);
    faces = OTX_NEW(run->arena, int32_t, total);
    OTX_TRY(otx_run_ok(run));
    first[0] = 0;
    for (int32_t i = 0, t = 0; i < numbers; ++i)
    {
        if (counts[i] == 0)
            continue;
        tiles[t] = OTX_UDIM_FIRST + i;
        first[t + 1] = first[t] + counts[i];
        counts[i] = first[t++];
    }
    out->tiles = tiles;
    out->tile_first = first;
    out->tile_faces = faces;
    return visit_tiles(run, out, counts, faces);
}

static otx_status
find_tiles(otx_run *run, otx_layout *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *counts =
        OTX_ZNEW(run->scratch, int32_t, OTX_UDIM_COLUMNS * OTX_UDIM_ROWS);
    const otx_status status =
        counts ? list_tiles(run, out, counts) : otx_fail_memory(run, STAGE);

    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_layout_find_tile(
    otx_run *run, const otx_layout *layout, int32_t udim, int32_t *tile)
{
    for (int32_t t = 0; t < layout->tile_count; ++t)
        if (layout->tiles[t] == udim)
        {
            *tile = t;
            return OSDTEX_OK;
        }
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "the bake has no tile %d; its %d tiles begin with %d", (int)udim,
        (int)layout->tile_count,
        layout->tile_count > 0 ? (int)layout->tiles[0] : 0);
}

otx_status
otx_layout_build(
    otx_run *run, const otx_mapping *mapping, const otx_layout_options *options,
    otx_layout *out)
{
    *out = (otx_layout){.surface = mapping->surface, .side = options->side};
    if (options->side < 1 || options->side > 32768 || options->margin < 0 ||
        options->margin > OTX_ATLAS_MARGIN_MAX ||
        !(options->texels_per_unit >= 0.0 &&
          isfinite(options->texels_per_unit)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a texture has 1 to 32768 texels a side, margins of 0 to %d, and "
            "a positive number of texels per unit",
            OTX_ATLAS_MARGIN_MAX);
    OTX_TRY(place_leaves(run, options, out));
    OTX_TRY(find_covered(run, mapping, out));
    OTX_TRY(find_rims(run, out));
    OTX_TRY(find_charts(run, out));
    return find_tiles(run, out);
}

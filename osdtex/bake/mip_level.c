/* mip_level.c -- what each block of a level has to look at. */
#include "bake/mip_level.h"

#include "image/pyramid.h"
#include "surface/facet.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    GUTTER_MIN = 4 /* texels, at every level */
};

/* ---- rims -----------------------------------------------------------------
 */

/* Whether the facet at an edge has an area on the texture: from one that has
 * none, nothing can be continued. */
static bool
has_area(const otx_layout *layout, int32_t face, int32_t edge)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    int32_t side;
    const otx_facet facet = otx_facet_at_edge(leaf, face, edge, &side);
    otx_vec2 p[3];

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = layout->leaf_uvs + 2 * (size_t)facet.corners[k];

        p[k] = (otx_vec2){uv[0], uv[1]};
    }

    const double area2 =
        otx_vec2_cross(otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0]));

    return fabs(area2) > 0.0;
}

/* Which edges are listed. */
typedef struct choice
{
    const otx_layout *layout;
    const int32_t *face_patch; /* NULL: the rims */
} choice;

bool
otx_mip_is_seam(
    const otx_layout *layout, const int32_t *face_patch,
    const otx_mip_rim *edge)
{
    const int32_t other = otx_layout_across(layout, edge->face, edge->edge);

    return other >= 0 && face_patch[other] != face_patch[edge->face];
}

static bool
is_listed(const choice *c, int32_t face, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(c->layout->surface);

    if (!has_area(c->layout, face, k))
        return false;
    if (!c->face_patch)
        return c->layout->rim[leaf->face_first[face] + k];
    return otx_mip_is_seam(c->layout, c->face_patch, &(otx_mip_rim){face, k});
}

/* Lists the edges of a tile: [*count] in `arena`. */
static otx_status
list_edges(
    otx_run *run, otx_arena *arena, const choice *c, int32_t tile,
    const otx_mip_rim **edges, int32_t *count)
{
    const otx_layout *layout = c->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    otx_mip_rim *out = NULL;

    /* First the count, then the list. */
    for (int32_t pass = 0; pass < 2; ++pass)
    {
        int32_t n = 0;

        for (int32_t i = layout->tile_first[tile];
             i < layout->tile_first[tile + 1]; ++i)
        {
            const int32_t f = layout->tile_faces[i];

            for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
            {
                if (!is_listed(c, f, k))
                    continue;
                if (out)
                    out[n] = (otx_mip_rim){f, k};
                ++n;
            }
        }
        *count = n;
        if (!out)
            out = OTX_NEW(arena, otx_mip_rim, n);
        if (!out)
            return otx_fail_memory(run, STAGE);
    }
    *edges = out;
    return OSDTEX_OK;
}

otx_status
otx_mip_find_rims(
    otx_run *run, otx_arena *arena, const otx_layout *layout, int32_t tile,
    const otx_mip_rim **rims, int32_t *count)
{
    const choice rim = {layout, NULL};

    return list_edges(run, arena, &rim, tile, rims, count);
}

otx_status
otx_mip_find_seams(
    otx_run *run, otx_arena *arena, const otx_layout *layout,
    const int32_t *face_patch, int32_t tile, const otx_mip_rim **seams,
    int32_t *count)
{
    const choice seam = {layout, face_patch};

    return list_edges(run, arena, &seam, tile, seams, count);
}

/* ---- blocks ---------------------------------------------------------------
 */

/* Blocks that an interval of texels touches, aprons included, within
 * [0, columns). */
static void
cut(double low, double high, int32_t columns, int32_t *first, int32_t *end)
{
    const double a = floor((low - OTX_MIP_APRON) / OTX_MIP_BLOCK);
    const double b = floor((high + OTX_MIP_APRON) / OTX_MIP_BLOCK) + 1.0;

    *first = a > 0.0 ? a < columns ? (int32_t)a : columns : 0;
    *end = b > 0.0 ? b < columns ? (int32_t)b : columns : 0;
}

/* Rows count from the top, and so do texels here. */
static otx_bin_box
box_of(const otx_mip *mip, otx_vec2 low, otx_vec2 high)
{
    otx_bin_box box;

    cut(low.x, high.x, mip->columns, &box.x, &box.x_end);
    cut(mip->side - high.y, mip->side - low.y, mip->columns, &box.y,
        &box.y_end);
    return box;
}

static otx_bin_box
box_of_face(const void *context, int32_t index)
{
    const otx_mip *mip = context;
    const otx_layout *layout = mip->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t face =
        layout->tile_faces[layout->tile_first[mip->tile] + index];
    otx_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const otx_vec2 p = otx_mip_texel(mip, c);

        low = (otx_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (otx_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return box_of(mip, low, high);
}

static otx_bin_box
box_of_edge(const otx_mip *mip, const otx_mip_rim *rim, double r)
{
    otx_vec2 p[2];

    otx_mip_ends(mip, rim, p);
    return box_of(
        mip, (otx_vec2){fmin(p[0].x, p[1].x) - r, fmin(p[0].y, p[1].y) - r},
        (otx_vec2){fmax(p[0].x, p[1].x) + r, fmax(p[0].y, p[1].y) + r});
}

static otx_bin_box
box_of_rim(const void *context, int32_t index)
{
    const otx_mip *mip = context;

    return box_of_edge(mip, &mip->rims[index], mip->gutter);
}

static otx_bin_box
box_of_seam(const void *context, int32_t index)
{
    const otx_mip *mip = context;

    return box_of_edge(mip, &mip->seams[index], mip->blend);
}

/* Hands a rim from blocks that have some to those that have none, ring by
 * ring. */
static otx_status
spread_rims(otx_run *run, otx_arena *arena, otx_mip *mip)
{
    const int32_t n = mip->columns;
    const size_t blocks = (size_t)n * (size_t)n;
    int32_t *far = OTX_NEW(arena, int32_t, blocks);
    int32_t *queue = OTX_NEW(arena, int32_t, blocks);
    int32_t count = 0;

    if (!far || !queue)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < n * n; ++i)
    {
        const int64_t first = mip->near_rims.first[i];

        far[i] = -1;
        if (first == mip->near_rims.first[i + 1])
            continue;
        far[i] = mip->near_rims.items[first];
        queue[count++] = i;
    }
    for (int32_t k = 0; k < count; ++k)
    {
        const int32_t x = queue[k] % n, y = queue[k] / n;
        const int32_t around[4] = {
            x > 0 ? queue[k] - 1 : -1, x + 1 < n ? queue[k] + 1 : -1,
            y > 0 ? queue[k] - n : -1, y + 1 < n ? queue[k] + n : -1};

        for (int i = 0; i < 4; ++i)
        {
            if (around[i] < 0 || far[around[i]] >= 0)
                continue;
            far[around[i]] = far[queue[k]];
            queue[count++] = around[i];
        }
    }
    mip->far_rim = far;
    return OSDTEX_OK;
}

otx_status
otx_mip_build(otx_run *run, otx_arena *arena, otx_mip *mip)
{
    const otx_layout *layout = mip->layout;
    const int32_t faces =
        layout->tile_first[mip->tile + 1] - layout->tile_first[mip->tile];
    const int32_t gutter = layout->margin >> mip->level;

    mip->side = otx_pyramid_side(layout->side, mip->level);
    mip->columns = (mip->side + OTX_MIP_BLOCK - 1) / OTX_MIP_BLOCK;
    mip->gutter = gutter > GUTTER_MIN ? gutter : GUTTER_MIN;
    OTX_TRY(otx_bin_build(
        run, arena, mip->columns, mip->columns, faces, box_of_face, mip,
        &mip->faces));
    OTX_TRY(otx_bin_build(
        run, arena, mip->columns, mip->columns, mip->rim_count, box_of_rim, mip,
        &mip->near_rims));
    OTX_TRY(otx_bin_build(
        run, arena, mip->columns, mip->columns, mip->seam_count, box_of_seam,
        mip, &mip->near_seams));
    return spread_rims(run, arena, mip);
}

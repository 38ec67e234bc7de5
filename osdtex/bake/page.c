/* page.c -- what each block of a level has to look at. */
#include "bake/page.h"

#include "bake/facet.h"
#include "image/pyramid.h"

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

otx_status
otx_page_find_rims(
    otx_run *run, otx_arena *arena, const otx_layout *layout, int32_t tile,
    const otx_page_rim **rims, int32_t *count)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    otx_page_rim *out = NULL;

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
                if (!layout->rim[leaf->face_first[f] + k] ||
                    !has_area(layout, f, k))
                    continue;
                if (out)
                    out[n] = (otx_page_rim){f, k};
                ++n;
            }
        }
        *count = n;
        if (!out)
            out = OTX_NEW(arena, otx_page_rim, n);
        if (!out)
            return otx_fail_memory(run, STAGE);
    }
    *rims = out;
    return OSDTEX_OK;
}

/* ---- blocks ---------------------------------------------------------------
 */

/* Blocks that an interval of texels touches, within [0, columns). */
static void
cut(double low, double high, int32_t columns, int32_t *first, int32_t *end)
{
    const double a = floor(low / OTX_PAGE_BLOCK);
    const double b = floor(high / OTX_PAGE_BLOCK) + 1.0;

    *first = a > 0.0 ? a < columns ? (int32_t)a : columns : 0;
    *end = b > 0.0 ? b < columns ? (int32_t)b : columns : 0;
}

/* Rows count from the top, and so do texels here. */
static otx_bin_box
box_of(const otx_page *page, otx_vec2 low, otx_vec2 high)
{
    otx_bin_box box;

    cut(low.x, high.x, page->columns, &box.x, &box.x_end);
    cut(page->side - high.y, page->side - low.y, page->columns, &box.y,
        &box.y_end);
    return box;
}

static otx_bin_box
box_of_face(const void *context, int32_t index)
{
    const otx_page *page = context;
    const otx_layout *layout = page->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t face =
        layout->tile_faces[layout->tile_first[page->tile] + index];
    otx_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const otx_vec2 p = otx_page_texel(page, c);

        low = (otx_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (otx_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return box_of(page, low, high);
}

static otx_bin_box
box_of_rim(const void *context, int32_t index)
{
    const otx_page *page = context;
    int32_t corners[2];

    otx_page_ends(page, index, corners);

    const otx_vec2 a = otx_page_texel(page, corners[0]);
    const otx_vec2 b = otx_page_texel(page, corners[1]);
    const double r = page->gutter;

    return box_of(
        page, (otx_vec2){fmin(a.x, b.x) - r, fmin(a.y, b.y) - r},
        (otx_vec2){fmax(a.x, b.x) + r, fmax(a.y, b.y) + r});
}

/* Hands a rim from blocks that have some to those that have none, ring by
 * ring. */
static otx_status
spread_rims(otx_run *run, otx_arena *arena, otx_page *page)
{
    const int32_t n = page->columns;
    const size_t blocks = (size_t)n * (size_t)n;
    int32_t *far = OTX_NEW(arena, int32_t, blocks);
    int32_t *queue = OTX_NEW(arena, int32_t, blocks);
    int32_t count = 0;

    if (!far || !queue)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < n * n; ++i)
    {
        const int64_t first = page->near_rims.first[i];

        far[i] = -1;
        if (first == page->near_rims.first[i + 1])
            continue;
        far[i] = page->near_rims.items[first];
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
    page->far_rim = far;
    return OSDTEX_OK;
}

otx_status
otx_page_build(otx_run *run, otx_arena *arena, otx_page *page)
{
    const otx_layout *layout = page->layout;
    const int32_t faces =
        layout->tile_first[page->tile + 1] - layout->tile_first[page->tile];
    const int32_t gutter = layout->margin >> page->level;

    page->side = otx_pyramid_side(layout->side, page->level);
    page->columns = (page->side + OTX_PAGE_BLOCK - 1) / OTX_PAGE_BLOCK;
    page->gutter = gutter > GUTTER_MIN ? gutter : GUTTER_MIN;
    OTX_TRY(otx_bin_build(
        run, arena, page->columns, page->columns, faces, box_of_face, page,
        &page->faces));
    OTX_TRY(otx_bin_build(
        run, arena, page->columns, page->columns, page->rim_count, box_of_rim,
        page, &page->near_rims));
    return spread_rims(run, arena, page);
}

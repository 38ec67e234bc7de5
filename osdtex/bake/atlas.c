/* atlas.c -- sizes from extents, shelves from sizes. */
#include "bake/atlas.h"

#include "bake/extent.h"
#include "base/union_find.h"
#include "image/udim.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    SEARCH_STEPS = 40,
    AUTO_MARGIN_MAX = 16
};

/* Cells of a packing, in texels. */
typedef struct packing
{
    int32_t face_count;
    int32_t side;          /* of a tile */
    const double *extents; /* [face_count * 2] of the blocks, scene units */
    const uint8_t *odd;    /* [face_count * 2] 1: that side is an odd multiple
                            * of twice the margin */
    int32_t *order;        /* [face_count], high cells first */
    int32_t *cells;        /* [face_count * 2] widths and heights */
    int32_t *places;       /* [face_count * 3] x, y, tile */
} packing;

/* ---- sizes --------------------------------------------------------------- */

/* Of a block of `texels` with its margins: a multiple of twice the margin that
 * holds at least a block of that size, in a tile; of an odd block an even one.
 */
static int32_t
cell_side(double texels, bool odd, int32_t margin, int32_t side)
{
    const int32_t step = odd ? 4 * margin : 2 * margin;
    const int32_t most = side / step * step;
    const double steps = ceil((texels + 2 * margin) / step);

    if (!(steps * step < most))
        return most;
    return steps * step > 4.0 * margin ? (int32_t)steps * step : 4 * margin;
}

/* Makes the sides of blocks that are one edge of the cage as long, by the
 * longest: then they get as many texels, and lookups along the edge find the
 * same from both sides. Opposite edges of a quad are one length, so whole loops
 * of edges are. Triangles are halves of squares, whose three sides have as many
 * texels, and a length of their own: odd multiples of one number of texels have
 * parts in common (rim_chain.h), so the loops that end at them are such. Of
 * other faces the sides run aslant. */
static otx_status
even_out(otx_run *run, const otx_level *cage, double *extents, uint8_t *odd)
{
    uint8_t *ends = OTX_ZNEW(run->scratch, uint8_t, cage->edge_count);
    int32_t *parent = OTX_NEW(run->scratch, int32_t, cage->edge_count);
    double *lengths = OTX_ZNEW(run->scratch, double, cage->edge_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t e = 0; e < cage->edge_count; ++e)
        parent[e] = e;
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        const int32_t *edges = cage->face_edges + cage->face_first[f];

        for (int32_t k = 0; k < 2 && otx_level_face_size(cage, f) == 4; ++k)
            otx_union_find_join(parent, edges[k], edges[k + 2]);
    }
    for (int32_t f = 0; f < cage->face_count; ++f)
        for (int32_t k = 0; k < 3 && otx_level_face_size(cage, f) == 3; ++k)
            ends[otx_union_find_root(
                parent, cage->face_edges[cage->face_first[f] + k])] = 1;
    for (int32_t pass = 0; pass < 2; ++pass)
        for (int32_t f = 0; f < cage->face_count; ++f)
        {
            const int32_t *edges = cage->face_edges + cage->face_first[f];

            for (int32_t k = 0; k < 2 && otx_level_face_size(cage, f) == 4; ++k)
            {
                double *length =
                    &lengths[otx_union_find_root(parent, edges[k])];
                double *extent = &extents[2 * (size_t)f + (size_t)k];

                odd[2 * (size_t)f + (size_t)k] =
                    ends[otx_union_find_root(parent, edges[k])];

                if (pass == 0)
                    *length = fmax(*length, *extent);
                else
                    *extent = *length;
            }
        }
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        double *extent = &extents[2 * (size_t)f];

        if (otx_level_face_size(cage, f) != 3)
            continue;
        extent[0] = extent[1] = fmax(extent[0], extent[1]);
        odd[2 * (size_t)f] = odd[2 * (size_t)f + 1] = 1;
    }
    return OSDTEX_OK;
}

/* ---- shelves --------------------------------------------------------------
 */

/* Places the cells and returns how many tiles they take. */
static int32_t
place(packing *p)
{
    int32_t x = 0, y = 0, height = 0, tile = 0;

    for (int32_t i = 0; i < p->face_count; ++i)
    {
        const int32_t face = p->order[i];
        const int32_t *cell = p->cells + 2 * (size_t)face;

        if (x + cell[0] > p->side)
        {
            x = 0;
            y += height;
            height = 0;
        }
        if (y + cell[1] > p->side)
        {
            x = y = height = 0;
            ++tile;
        }
        memcpy(
            p->places + 3 * (size_t)face, (const int32_t[]){x, y, tile},
            3 * sizeof *p->places);
        x += cell[0];
        /* The first of a shelf is the highest: the order is by height. */
        height = height > cell[1] ? height : cell[1];
    }
    return tile + 1;
}

static int32_t
pack(packing *p, double texels_per_unit, int32_t margin)
{
    for (size_t i = 0; i < 2 * (size_t)p->face_count; ++i)
        p->cells[i] = cell_side(
            texels_per_unit * p->extents[i], p->odd[i], margin, p->side);
    return place(p);
}

/* The most texels to a scene unit with which all cells fit one tile; 0 when
 * there are none. */
static double
fit(packing *p, int32_t margin)
{
    double low = 0.0, high = 0.0;

    for (size_t i = 0; i < 2 * (size_t)p->face_count; ++i)
        high = fmax(high, p->extents[i]);
    /* Where the longest face alone fills the tile. */
    high = high > 0.0 ? p->side / high : 1.0;
    if (pack(p, low, margin) > 1)
        return 0.0;
    for (int32_t i = 0; i < SEARCH_STEPS; ++i)
    {
        const double middle = 0.5 * (low + high);

        if (pack(p, middle, margin) > 1)
            high = middle;
        else
            low = middle;
    }
    return low;
}

/* Share of the cells' texels that is not margin. */
static double
share_of_blocks(const packing *p, int32_t margin)
{
    double blocks = 0.0, cells = 0.0;

    for (int32_t f = 0; f < p->face_count; ++f)
    {
        const double width = p->cells[2 * (size_t)f];
        const double height = p->cells[2 * (size_t)f + 1];

        blocks += (width - 2 * margin) * (height - 2 * margin);
        cells += width * height;
    }
    return blocks / cells;
}

/* Settles texels to a unit and margin, and leaves the packing as it then is. */
static void
settle(packing *p, const otx_atlas_options *options, otx_atlas *out)
{
    const bool free = options->margin == 0;
    int32_t margin = free ? AUTO_MARGIN_MAX : options->margin;

    /* As otx_atlas_check has it of margins that are asked for. */
    while (free && margin > OTX_ATLAS_MARGIN_MIN && 4 * margin > p->side)
        margin /= 2;
    for (;;)
    {
        out->margin = margin;
        out->texels_per_unit = options->texels_per_unit > 0.0
                                   ? options->texels_per_unit
                                   : fit(p, margin);
        out->tile_count = pack(p, out->texels_per_unit, margin);
        if (!free || margin == OTX_ATLAS_MARGIN_MIN ||
            (out->tile_count == 1 && share_of_blocks(p, margin) >= 0.5) ||
            (options->texels_per_unit > 0.0 &&
             share_of_blocks(p, margin) >= 0.5))
            return;
        margin /= 2;
    }
}

static double
height_of(const packing *p, int32_t face)
{
    return p->extents[2 * (size_t)face + 1];
}

/* Orders faces by height, ties by index, with a merge of neighbours: stable. */
static bool
sort_faces(otx_arena *scratch, packing *p)
{
    const int32_t n = p->face_count;
    int32_t *from = p->order, *to = OTX_NEW(scratch, int32_t, n);

    if (!to)
        return false;
    for (int32_t i = 0; i < n; ++i)
        from[i] = i;
    for (int64_t width = 1; width < n; width *= 2)
    {
        for (int64_t start = 0; start < n; start += 2 * width)
        {
            const int64_t middle = start + width < n ? start + width : n;
            const int64_t end = start + 2 * width < n ? start + 2 * width : n;
            int64_t a = start, b = middle;

            for (int64_t k = start; k < end; ++k)
                to[k] = b == end || (a < middle && height_of(p, from[a]) >=
                                                       height_of(p, from[b]))
                            ? from[a++]
                            : from[b++];
        }
        int32_t *swap = from;

        from = to;
        to = swap;
    }
    p->order = from;
    return true;
}

/* ---- coordinates --------------------------------------------------------- */

static void
set_uvs(const otx_cage *cage, const packing *p, const otx_atlas *atlas)
{
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        const int32_t first = cage->face_first[f];
        const int32_t n = cage->face_first[f + 1] - first;
        const int32_t *at = p->places + 3 * (size_t)f;
        const int32_t *cell = p->cells + 2 * (size_t)f;
        const double width = cell[0] - 2 * atlas->margin;
        const double height = cell[1] - 2 * atlas->margin;

        for (int32_t k = 0; k < n; ++k)
        {
            const otx_vec2 c = otx_extent_corner(n, k);
            float *uv = atlas->uvs + 2 * (size_t)(first + k);

            uv[0] =
                (float)(at[2] % OTX_UDIM_COLUMNS + (at[0] + atlas->margin + width * c.x) / p->side);
            uv[1] =
                (float)(at[2] / OTX_UDIM_COLUMNS + (at[1] + atlas->margin + height * c.y) / p->side);
        }
    }
}

otx_status
otx_atlas_check(otx_run *run, const otx_atlas_options *options)
{
    const int32_t margin = options->margin;

    if (margin != 0 &&
        (margin < OTX_ATLAS_MARGIN_MIN || margin > OTX_ATLAS_MARGIN_MAX ||
         (margin & (margin - 1)) != 0))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the margin of an atlas is 4, 8, 16, 32 or 64 texels, not %d",
            margin);
    if (4 * (margin ? margin : OTX_ATLAS_MARGIN_MIN) > options->side)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a texture of %d texels a side has no room for blocks with such "
            "margins; raise the resolution",
            options->side);
    return OSDTEX_OK;
}

otx_status
otx_atlas_check_tiles(otx_run *run, const otx_atlas *atlas)
{
    if (atlas->tile_count > OTX_UDIM_COLUMNS * OTX_UDIM_ROWS - 1)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "the blocks fill %d tiles, more than UDIM can number; raise the "
            "resolution or lower the texels per unit",
            atlas->tile_count);
    return OSDTEX_OK;
}

static void
warn(
    otx_run *run, const otx_cage *cage, const otx_atlas_options *options,
    const otx_atlas *atlas)
{
    /* Without texels to a unit only blocks of the least size fill more than one
     * tile.
     */
    if (!(atlas->texels_per_unit > 0.0))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
            "%d faces fill %d tiles of %d x %d texels with the smallest blocks "
            "that there are, of %d texels a side and as many between them; "
            "raise the resolution, or unwrap the cage and bake onto its own "
            "UVs",
            cage->face_count, atlas->tile_count, options->side, options->side,
            2 * atlas->margin);
}

void
otx_atlas_tell(otx_run *run, const otx_atlas *atlas)
{
    if (atlas->texels_per_unit > 0.0)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
            "an atlas of %d tile%s, %.4g texels per scene unit, margins of %d "
            "texels",
            atlas->tile_count, atlas->tile_count == 1 ? "" : "s",
            atlas->texels_per_unit, atlas->margin);
}

otx_status
otx_atlas_pack(
    otx_run *run, const otx_surface *surface, const otx_atlas_options *options,
    otx_atlas *out)
{
    const otx_cage *cage = surface->cage;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const size_t faces = (size_t)cage->face_count;
    double *extents = OTX_NEW(run->scratch, double, 2 * faces);
    uint8_t *odd = OTX_ZNEW(run->scratch, uint8_t, 2 * faces);
    packing p = {
        .face_count = cage->face_count,
        .side = options->side,
        .extents = extents,
        .odd = odd,
        .order = OTX_NEW(run->scratch, int32_t, faces),
        .cells = OTX_NEW(run->scratch, int32_t, 2 * faces),
        .places = OTX_NEW(run->scratch, int32_t, 3 * faces),
    };

    *out = (otx_atlas){0};
    OTX_TRY(otx_atlas_check(run, options));
    out->uvs = OTX_NEW(run->arena, float, 2 * (size_t)cage->corner_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_extent_measure(run, surface, extents));
    OTX_TRY(even_out(run, &surface->levels[0], extents, odd));
    if (!sort_faces(run->scratch, &p))
        return otx_fail_memory(run, STAGE);
    settle(&p, options, out);
    set_uvs(cage, &p, out);
    otx_arena_release(run->scratch, mark);
    OTX_TRY(otx_atlas_check_tiles(run, out));
    warn(run, cage, options, out);
    return OSDTEX_OK;
}

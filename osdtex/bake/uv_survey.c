/* uv_survey.c -- whether a cage's own UVs can be baked onto.
 *
 * Overlaps are found by drawing every face into a grid of counters, by the
 * even-odd rule on the middles of its cells. Two faces that share an edge
 * compute the same crossings of it, to the bit, so neighbours never claim a
 * cell together. */
#include "bake/uv_survey.h"

#include "image/udim.h"
#include "math/vec.h"
#include "surface/limit.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    GRID_SIDE = 512,     /* cells of a tile's side, fewer when there are many */
    GRID_SIDE_MIN = 8,   /* tiles */
    CELLS_MAX = 1 << 22, /* of all tiles */
    DEPTH_MAX = 8,       /* faces on a cell, in the mean, that are counted */
    CORNERS_MAX = 64     /* of a face; longer ones are drawn by their first */
};

/* Squared tile sides below which a face has no area in UV: a millionth of a
 * texel of 1024 to a tile. */
static const double FLAT = 1e-12;

/* Counters over all tiles that UVs lie in, row by row from tile 1001. */
typedef struct grid
{
    int32_t side; /* cells of a tile's side */
    int32_t width, height;
    uint8_t *cells; /* 0, 1, or 2 for more */
    int64_t drawn, limit;
} grid;

typedef struct survey
{
    const otx_surface *surface;
    const otx_level *leaf;
    otx_uv_survey *out;
    double high[2];       /* of the UVs */
    double beyond;        /* of the farthest corner outside */
    double uv_area, area; /* of faces that have both */
    grid grid;
} survey;

static const float *
uv_at(const survey *s, int32_t corner)
{
    return s->surface->uvs + 2 * (size_t)s->surface->face_uvs[corner];
}

/* ---- one face at a time ---------------------------------------------------
 */

static double
uv_area_of(const survey *s, int32_t face)
{
    const int32_t first = s->leaf->face_first[face];
    const float *a = uv_at(s, first);
    double area2 = 0.0;

    for (int32_t c = first + 2; c < s->leaf->face_first[face + 1]; ++c)
    {
        const float *p = uv_at(s, c - 1), *q = uv_at(s, c);

        area2 += ((double)p[0] - a[0]) * ((double)q[1] - a[1]) -
                 ((double)p[1] - a[1]) * ((double)q[0] - a[0]);
    }
    return 0.5 * fabs(area2);
}

static double
area_of(const survey *s, int32_t face)
{
    const int32_t first = s->leaf->face_first[face];
    const int32_t *verts = s->leaf->face_verts + first;
    const int32_t size = otx_level_face_size(s->leaf, face);
    const otx_vec3 origin = otx_vec3_load(s->surface->points, verts[0]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t k = 2; k < size; ++k)
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(
                    otx_vec3_load(s->surface->points, verts[k - 1]), origin),
                otx_vec3_sub(
                    otx_vec3_load(s->surface->points, verts[k]), origin)));
    return 0.5 * sqrt(otx_vec3_dot(sum, sum));
}

/* How far a corner lies beyond the tiles; at most 0 inside. The last tile of
 * the last row would be 10000. */
static double
beyond_of(const float uv[2])
{
    const double sides = fmax(
        fmax(-uv[0], uv[0] - (double)OTX_UDIM_COLUMNS),
        fmax(-uv[1], uv[1] - (double)OTX_UDIM_ROWS));
    const double last = fmin(
        uv[0] - (double)(OTX_UDIM_COLUMNS - 1),
        uv[1] - (double)(OTX_UDIM_ROWS - 1));

    return fmax(sides, last);
}

static void
look_outside(survey *s, int32_t face)
{
    bool outside = false;

    for (int32_t c = s->leaf->face_first[face];
         c < s->leaf->face_first[face + 1]; ++c)
    {
        const float *uv = uv_at(s, c);
        const double beyond = beyond_of(uv);

        for (int k = 0; k < 2; ++k)
            s->high[k] = fmax(s->high[k], (double)uv[k]);
        /* Written so that NaN is outside. */
        if (beyond <= OTX_UDIM_OVER)
            continue;
        outside = true;
        if (s->out->outside_face >= 0 && !(beyond > s->beyond))
            continue;
        s->beyond = beyond;
        s->out->outside_face = s->leaf->face_cage[face];
        memcpy(s->out->outside_uv, uv, sizeof s->out->outside_uv);
    }
    s->out->outside += outside;
}

static void
look_at_area(survey *s, int32_t face)
{
    const double uv_area = uv_area_of(s, face);

    if (uv_area > FLAT)
    {
        s->uv_area += uv_area;
        s->area += area_of(s, face);
        return;
    }
    if (otx_limit_face_is_flat(s->leaf, s->surface->points, face))
        return;
    if (s->out->flat++ == 0)
        s->out->flat_face = s->leaf->face_cage[face];
}

static bool
is_hole(const survey *s, int32_t face)
{
    return s->leaf->face_hole && s->leaf->face_hole[face];
}

/* ---- overlaps ------------------------------------------------------------ */

static bool
grid_begin(otx_arena *scratch, const double high[2], grid *g)
{
    const double columns = fmax(1.0, ceil(high[0] - OTX_UDIM_OVER));
    const double rows = fmax(1.0, ceil(high[1] - OTX_UDIM_OVER));

    g->side = GRID_SIDE;
    while (g->side > GRID_SIDE_MIN &&
           columns * rows * g->side * g->side > CELLS_MAX)
        g->side /= 2;
    g->width = (int32_t)columns * g->side;
    g->height = (int32_t)rows * g->side;
    g->limit = DEPTH_MAX * (int64_t)g->width * g->height;
    g->cells = OTX_ZNEW(scratch, uint8_t, (size_t)g->width * (size_t)g->height);
    return g->cells != NULL;
}

/* Where the face's border crosses the middle of a row, ascending.
 *
 *   x  [count] and more, out
 *
 * Returns how many there are. */
static int32_t
crossings(const otx_vec2 *corners, int32_t count, double y, double *x)
{
    int32_t found = 0;

    for (int32_t k = 0; k < count; ++k)
    {
        otx_vec2 a = corners[k], b = corners[k + 1 == count ? 0 : k + 1];
        int32_t i;

        if ((a.y <= y) == (b.y <= y))
            continue;
        if (a.y > b.y)
        {
            const otx_vec2 swap = a;

            a = b;
            b = swap;
        }

        const double at = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);

        for (i = found++; i > 0 && x[i - 1] > at; --i)
            x[i] = x[i - 1];
        x[i] = at;
    }
    return found;
}

static int32_t
clamp(double x, int32_t end)
{
    return x > 0.0 ? (x < end ? (int32_t)x : end) : 0;
}

/* Counts a face's cells between two crossings. Returns whether one of them was
 * another's. */
static bool
fill(grid *g, int32_t row, double from, double to)
{
    uint8_t *cells = g->cells + (size_t)row * (size_t)g->width;
    const int32_t end = clamp(ceil(to - 0.5), g->width);
    bool overlaps = false;

    for (int32_t i = clamp(ceil(from - 0.5), g->width); i < end; ++i)
    {
        overlaps |= cells[i] > 0;
        cells[i] += cells[i] < 2;
        ++g->drawn;
    }
    return overlaps;
}

static bool
draw(survey *s, int32_t face)
{
    grid *g = &s->grid;
    const int32_t first = s->leaf->face_first[face];
    const int32_t size = otx_level_face_size(s->leaf, face);
    const int32_t count = size < CORNERS_MAX ? size : CORNERS_MAX;
    double low = INFINITY, high = -INFINITY, x[CORNERS_MAX];
    otx_vec2 corners[CORNERS_MAX];
    bool overlaps = false;

    for (int32_t k = 0; k < count; ++k)
    {
        const float *uv = uv_at(s, first + k);

        corners[k] =
            (otx_vec2){(double)uv[0] * g->side, (double)uv[1] * g->side};
        low = fmin(low, corners[k].y);
        high = fmax(high, corners[k].y);
    }

    const int32_t end = clamp(ceil(high - 0.5), g->height);

    for (int32_t row = clamp(ceil(low - 0.5), g->height); row < end; ++row)
    {
        const int32_t found = crossings(corners, count, row + 0.5, x);

        for (int32_t i = 0; i + 1 < found; i += 2)
            overlaps |= fill(g, row, x[i], x[i + 1]);
    }
    return overlaps;
}

static void
count_cells(const grid *g, otx_uv_survey *out)
{
    const size_t cells = (size_t)g->width * (size_t)g->height;
    int64_t covered = 0, several = 0;

    for (size_t i = 0; i < cells; ++i)
    {
        covered += g->cells[i] > 0;
        several += g->cells[i] > 1;
    }
    if (covered == 0)
        return;
    out->overlap = (double)several / (double)covered;
    out->depth = (double)g->drawn / (double)covered;
}

/* UVs that many faces share entirely would take for ever: drawing ends where
 * every cell has been drawn several times over, which says enough. */
static otx_status
find_overlaps(otx_run *run, survey *s)
{
    if (!grid_begin(run->scratch, s->high, &s->grid))
        return otx_fail_memory(run, STAGE);
    for (int32_t f = 0;
         f < s->leaf->face_count && s->grid.drawn < s->grid.limit; ++f)
    {
        if (!is_hole(s, f) && draw(s, f) && s->out->overlap_face < 0)
            s->out->overlap_face = s->leaf->face_cage[f];
    }
    count_cells(&s->grid, s->out);
    return OSDTEX_OK;
}

otx_status
otx_uv_survey_run(otx_run *run, const otx_surface *surface, otx_uv_survey *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    survey s = {
        .surface = surface, .leaf = otx_surface_leaf(surface), .out = out};
    otx_status status = OSDTEX_OK;

    *out = (otx_uv_survey){
        .outside_face = -1, .flat_face = -1, .overlap_face = -1};
    for (int32_t f = 0; f < s.leaf->face_count; ++f)
    {
        if (is_hole(&s, f))
            continue;
        ++out->face_count;
        look_outside(&s, f);
        look_at_area(&s, f);
    }
    if (s.uv_area > 0.0)
        out->side = sqrt(s.area / s.uv_area);
    if (out->outside == 0)
        status = find_overlaps(run, &s);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* Whether a face's bounding box reaches into the unit square at (u, v). */
static bool
reaches_into(const survey *s, int32_t face, double u, double v)
{
    const double corner[2] = {u, v};
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    bool reaches = true;

    for (int32_t c = s->leaf->face_first[face];
         c < s->leaf->face_first[face + 1]; ++c)
        for (int k = 0; k < 2; ++k)
        {
            low[k] = fmin(low[k], (double)uv_at(s, c)[k]);
            high[k] = fmax(high[k], (double)uv_at(s, c)[k]);
        }
    for (int k = 0; k < 2; ++k)
        reaches = reaches && high[k] > corner[k] + OTX_UDIM_OVER &&
                  low[k] < corner[k] + 1.0 - OTX_UDIM_OVER;
    return reaches;
}

bool
otx_uv_survey_has_tile(const otx_surface *surface, int32_t tile)
{
    const survey s = {.surface = surface, .leaf = otx_surface_leaf(surface)};

    for (int32_t f = 0; f < s.leaf->face_count; ++f)
        if (!is_hole(&s, f) &&
            reaches_into(&s, f, otx_udim_column(tile), otx_udim_row(tile)))
            return true;
    return false;
}

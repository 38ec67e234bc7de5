/* radial_cut.c -- what of a texture patch is pasted. */
#include "method/lapped/radial_cut.h"

#include "image/view.h"

#include <stdlib.h>
#include <string.h>

enum
{
    RINGS = 24,
    STEP = 2, /* rings from an angle to the next, at most */
    ANGLES = OTX_RADIAL_ANGLES,
    FILLS = 3, /* rounds in which cells without samples take their neighbours */
    MARGIN = 2 /* cells around what is open that a piece has to cover, too */
};

/* Side of a cell, texels. */
static const double CELL = 2.0;
/* Of the outline's radius, within which the path runs. */
static const double BAND = 0.85;
/* Costs in Delta E: of leaving out a cell that nothing covers yet, of laying
 * one over what is covered, of a step along the path, and of one to another
 * ring. */
static const double OPEN = 25.0, COVERED = 1.0, LENGTH = 0.5, BEND = 0.5;
/* From this alpha on a paste is what is seen. */
static const double SHOWN = 0.5;

/* What the samples of a chart say about the plane. */
typedef struct plane
{
    int32_t side;  /* cells */
    float *differ; /* Delta E to what lies there; negative unknown */
    float *open;   /* share that is not covered */
} plane;

/* ---- the plane ---- */

static void
texel_of(const otx_lapped *l, otx_vec2 texel, float lab[3])
{
    const otx_exemplar *e = l->exemplar;
    const double x = texel.x * e->lab.width / e->match.width;
    const double y = texel.y * e->lab.height / e->match.height;
    const int32_t i = otx_view_fold((int32_t)floor(x), e->lab.width, e->wrap_x);
    const int32_t j =
        otx_view_fold((int32_t)floor(y), e->lab.height, e->wrap_y);

    memcpy(lab, otx_image_at(&e->lab, i, j), 3 * sizeof *lab);
}

static int32_t
cell_of(const plane *p, otx_vec2 at)
{
    const double x = floor(at.x / CELL) + p->side / 2;
    const double y = floor(at.y / CELL) + p->side / 2;

    if (!(x >= 0 && y >= 0 && x < p->side && y < p->side))
        return -1;
    return (int32_t)y * p->side + (int32_t)x;
}

static void
add_sample(
    const otx_lapped *l, const otx_lapped_paste *paste, plane *p,
    int32_t *count, int64_t sample, otx_vec2 at)
{
    const int32_t cell = cell_of(p, at);
    float lab[3];

    if (cell < 0)
        return;
    ++count[cell];
    if (!l->samples.covered[sample])
    {
        p->open[cell] += 1.0f;
        return;
    }
    texel_of(l, otx_vec2_add(paste->centre, at), lab);
    p->differ[cell] +=
        (float)sqrt(otx_image_distance_sq(lab, l->samples.shown + 3 * sample));
}

static void
add_samples(
    const otx_lapped *l, const otx_lapped_paste *paste, plane *p,
    int32_t *count)
{
    const otx_lapped_chart *c = &paste->chart;

    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t t = 0; t < otx_facet_count(l->leaf, c->faces[i]); ++t)
        {
            const otx_lapped_facet facet = otx_lapped_facet_at(l, c, i, t);

            for (int32_t s = 0; s < facet.count; ++s)
                add_sample(
                    l, paste, p, count, facet.first + s,
                    otx_lapped_place(&facet, s));
        }
}

/* Sums become means. */
static void
divide(plane *p, const int32_t *count)
{
    for (int32_t i = 0; i < p->side * p->side; ++i)
    {
        const float covered = (float)count[i] - p->open[i];

        p->differ[i] = covered > 0.0f ? p->differ[i] / covered : -1.0f;
        p->open[i] = count[i] > 0 ? p->open[i] / (float)count[i] : 0.0f;
    }
}

/* Cells that no sample fell into take after those around them. */
static void
fill(plane *p, float *spare)
{
    static const int32_t X[] = {1, -1, 0, 0}, Y[] = {0, 0, 1, -1};
    const size_t bytes = (size_t)p->side * (size_t)p->side * sizeof *spare;

    memcpy(spare, p->differ, bytes);
    for (int32_t y = 1; y + 1 < p->side; ++y)
        for (int32_t x = 1; x + 1 < p->side; ++x)
        {
            float sum = 0.0f, known = 0.0f;

            for (int k = 0; k < 4; ++k)
            {
                const float d = p->differ[(y + Y[k]) * p->side + x + X[k]];

                sum += d >= 0.0f ? d : 0.0f;
                known += d >= 0.0f ? 1.0f : 0.0f;
            }
            if (p->differ[y * p->side + x] < 0.0f && known > 0.0f)
                spare[y * p->side + x] = sum / known;
        }
    memcpy(p->differ, spare, bytes);
}

/* What is next to open cells has to be covered as they have: slivers would be
 * left along the feather. */
static void
widen(plane *p, float *spare)
{
    memcpy(spare, p->open, (size_t)p->side * (size_t)p->side * sizeof *spare);
    for (int32_t y = 1; y + 1 < p->side; ++y)
        for (int32_t x = 1; x + 1 < p->side; ++x)
            for (int32_t k = 0; k < 9; ++k)
                p->open[y * p->side + x] = fmaxf(
                    p->open[y * p->side + x],
                    spare[(y + k / 3 - 1) * p->side + x + k % 3 - 1]);
}

static otx_status
make_plane(
    const otx_lapped *l, otx_arena *scratch, const otx_radial *outline,
    const otx_lapped_paste *paste, plane *p)
{
    int32_t *count;
    float *spare;

    p->side = 2 * ((int32_t)ceil((double)outline->most / CELL) + 1);
    p->differ = OTX_ZNEW(scratch, float, p->side * p->side);
    p->open = OTX_ZNEW(scratch, float, p->side * p->side);
    count = OTX_ZNEW(scratch, int32_t, p->side * p->side);
    spare = OTX_NEW(scratch, float, p->side * p->side);
    if (otx_arena_failed(scratch))
        return OSDTEX_ERROR_MEMORY;
    add_samples(l, paste, p, count);
    divide(p, count);
    for (int i = 0; i < FILLS; ++i)
        fill(p, spare);
    for (int i = 0; i < MARGIN; ++i)
        widen(p, spare);
    return OSDTEX_OK;
}

/* ---- the path ---- */

static double
radius_of(const otx_radial *outline, int32_t angle, int32_t ring)
{
    const double least = 1.0 - BAND;

    return (double)outline->radius[angle] *
           (least + (1.0 - least) * ring / (RINGS - 1));
}

/* The cost of the path through each place. */
static void
price(const plane *p, const otx_radial *outline, double cost[ANGLES][RINGS])
{
    for (int32_t a = 0; a < ANGLES; ++a)
    {
        const otx_vec2 ray = otx_vec2_polar(6.283185307179586 * a / ANGLES);
        double outside = 0.0, inside = 0.0;

        for (int32_t r = 0; r < RINGS; ++r)
        {
            const int32_t cell =
                cell_of(p, otx_vec2_scale(radius_of(outline, a, r), ray));

            cost[a][r] = COVERED * inside;
            inside += cell >= 0 ? 1.0 - (double)p->open[cell] : 0.0;
        }
        for (int32_t r = RINGS - 1; r >= 0; --r)
        {
            const int32_t cell =
                cell_of(p, otx_vec2_scale(radius_of(outline, a, r), ray));
            const float differ = cell >= 0 ? p->differ[cell] : -1.0f;

            cost[a][r] += LENGTH + OPEN * outside + fmax((double)differ, 0.0);
            outside += cell >= 0 ? (double)p->open[cell] : 0.0;
        }
    }
}

/* The best path once around from angle `begin`.
 *
 *   start  the ring that it starts from and comes back to; -1: any, and it need
 *          not come back */
static void
best_path(
    double cost[ANGLES][RINGS], int32_t begin, int32_t start,
    uint8_t path[ANGLES])
{
    double sum[RINGS], next[RINGS];
    uint8_t from[ANGLES + 1][RINGS];
    int32_t ring = start;

    for (int32_t r = 0; r < RINGS; ++r)
        sum[r] = start < 0 || r == start ? cost[begin][r] : INFINITY;
    for (int32_t i = 1; i <= ANGLES; ++i)
    {
        const double *here = cost[(begin + i) % ANGLES];

        for (int32_t r = 0; r < RINGS; ++r)
        {
            const int32_t first = r > STEP ? r - STEP : 0;
            const int32_t last = r + STEP < RINGS ? r + STEP : RINGS - 1;

            next[r] = INFINITY;
            for (int32_t q = first; q <= last; ++q)
                if (sum[q] + BEND * abs(q - r) < next[r])
                {
                    next[r] = sum[q] + BEND * abs(q - r);
                    from[i][r] = (uint8_t)q;
                }
            next[r] += here[r];
        }
        memcpy(sum, next, sizeof sum);
    }
    for (int32_t r = 0; start < 0 && r < RINGS; ++r)
        if (ring < 0 || sum[r] < sum[ring])
            ring = r;
    for (int32_t i = ANGLES; i > 0; --i)
    {
        ring = from[i][ring];
        path[(begin + i - 1) % ANGLES] = (uint8_t)ring;
    }
}

/* A path that need not close says where one that does begins: half way round,
 * where its ends are far. */
otx_status
otx_lapped_cut(
    const otx_lapped *l, otx_arena *scratch, const otx_radial *outline,
    const otx_lapped_paste *paste, otx_radial *out)
{
    double cost[ANGLES][RINGS];
    uint8_t path[ANGLES];
    plane p;

    OTX_TRY(make_plane(l, scratch, outline, paste, &p));
    price(&p, outline, cost);
    best_path(cost, 0, -1, path);
    best_path(cost, ANGLES / 2, path[ANGLES / 2], path);
    *out = *outline;
    for (int32_t a = 0; a < ANGLES; ++a)
        out->radius[a] = (float)radius_of(outline, a, path[a]);
    otx_radial_bound(out);
    return OSDTEX_OK;
}

/* Whether an alpha leaves something at a place of a paste of features. */
static bool
is_opaque(const otx_lapped *l, const otx_lapped_paste *paste, otx_vec2 at)
{
    const otx_features *f = &l->features;

    return !f->by_alpha || paste->pieces[0].height <= OTX_LAPPED_BENEATH ||
           otx_features_at(
               f, otx_vec2_scale(
                      (double)f->width / l->exemplar->match.width,
                      otx_vec2_add(paste->centre, at))) > 0;
}

int64_t
otx_lapped_mark(
    const otx_lapped *l, const otx_lapped_paste *paste, otx_samples *samples)
{
    const otx_lapped_chart *c = &paste->chart;
    int64_t fresh = 0;

    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t t = 0; t < otx_facet_count(l->leaf, c->faces[i]); ++t)
        {
            const otx_lapped_facet facet = otx_lapped_facet_at(l, c, i, t);

            for (int32_t s = 0; s < facet.count; ++s)
            {
                const otx_vec2 at = otx_lapped_place(&facet, s);
                const double alpha = otx_lapped_alpha(paste, at);

                if (alpha >= OTX_LAPPED_COVERED && is_opaque(l, paste, at))
                    fresh +=
                        otx_samples_set(samples, c->faces[i], facet.first + s);
                if (alpha >= SHOWN)
                    texel_of(
                        l, otx_vec2_add(paste->centre, at),
                        samples->shown + 3 * (facet.first + s));
            }
        }
    return fresh;
}

/* toroid.c -- windows sewn over the line where the picture's borders meet.
 *
 * The picture is seen as a torus. Windows are centred on the meeting line, one
 * half a side after the other, so that each crossing is covered twice and the
 * second may correct the first. A window's rim stays what it was, the texels
 * at the line must change, and expansion moves over the best few windows say
 * what is shown in between. */
#include "quilt/toroid.h"

#include "quilt/oddness.h"
#include "quilt/quilt.h"
#include "quilt/window_search.h"

enum
{
    RIM = 2,     /* texels of a window that stay */
    WINDOWS = 4, /* that are tried at a place */
    ROUNDS = 2
};

/* A window's side as a share of the picture's shorter one: large enough for a
 * feature to be cut around. */
static const double WINDOW_SHARE = 0.26;

static const char STAGE[] = "toroid";

typedef struct toroid
{
    otx_run *run;
    const otx_exemplar *exemplar;
    otx_texel_pool pool;
    otx_texel_map map;
    otx_window_search search;
    int32_t side; /* of a window, even */
    int64_t seam_length;
    double seam_sum;
} toroid;

static int32_t *
texel_at(const toroid *t, int32_t x, int32_t y)
{
    return &t->map.texels
                [(size_t)otx_image_wrap(y, t->map.height) *
                     (size_t)t->map.width +
                 (size_t)otx_image_wrap(x, t->map.width)];
}

/* Whether texels on both sides of the line are still the picture's border:
 * axis 0 between columns width - 1 and 0, axis 1 between rows. */
static bool
is_open(const toroid *t, int32_t axis, int32_t along)
{
    const int32_t w = t->map.width, h = t->map.height;
    const int32_t at = otx_image_wrap(along, axis == 0 ? h : w);

    return axis == 0 ? *texel_at(t, -1, at) == at * w + w - 1 &&
                           *texel_at(t, 0, at) == at * w
                     : *texel_at(t, at, -1) == (h - 1) * w + at &&
                           *texel_at(t, at, 0) == at;
}

/* What the window at (x, y) shows now, without the texels at the line. */
static void
take_current(
    const toroid *t, int32_t x, int32_t y, int32_t axis, otx_texel_map *out)
{
    const int32_t n = t->side, half = n / 2;

    for (int32_t j = 0; j < n; ++j)
        for (int32_t i = 0; i < n; ++i)
            out->texels[(size_t)j * (size_t)n + (size_t)i] =
                *texel_at(t, x + i, y + j);
    for (int32_t k = n / 4 - RIM; k < n - n / 4 + RIM; ++k)
    {
        const int32_t first = axis == 0 ? k * n + half - 1 : (half - 1) * n + k;

        if (!is_open(t, axis, (axis == 0 ? y : x) + k))
            continue;
        out->texels[first] = OTX_TEXEL_NONE;
        out->texels[first + (axis == 0 ? 1 : n)] = OTX_TEXEL_NONE;
    }
}

static void
lock_rim(otx_quilt *quilt)
{
    const int32_t n = quilt->width;

    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            if (x < RIM || y < RIM || x >= n - RIM || y >= n - RIM)
                quilt->locks[(size_t)y * (size_t)n + (size_t)x] = 0;
}

static otx_status
sew(toroid *t, otx_quilt *quilt)
{
    for (int32_t s = quilt->sheet_count - 1; s >= 0; --s)
        otx_quilt_fill(quilt, s);
    otx_quilt_price(quilt);
    return otx_quilt_settle(t->run, quilt, ROUNDS);
}

static void
commit(toroid *t, const otx_quilt *quilt, int32_t x, int32_t y)
{
    const otx_quilt_seams seams = otx_quilt_measure(quilt);

    for (int32_t j = 0; j < quilt->height; ++j)
        for (int32_t i = 0; i < quilt->width; ++i)
            *texel_at(t, x + i, y + j) = otx_quilt_texel(quilt, i, j);
    t->seam_length += seams.length;
    t->seam_sum += seams.mean * (double)seams.length;
}

/* Covers the line where it passes the middle of the window at (x, y). */
static otx_status
cover(toroid *t, int32_t x, int32_t y, int32_t axis)
{
    const otx_arena_mark mark = otx_arena_here(t->run->scratch);
    otx_quilt *quilt = OTX_NEW(t->run->scratch, otx_quilt, 1);
    otx_texel_window windows[WINDOWS];
    otx_texel_map now;
    int32_t count;

    OTX_TRY(otx_run_ok(t->run));
    OTX_TRY(
        otx_texel_map_create(t->run, t->run->scratch, t->side, t->side, &now));
    take_current(t, x, y, axis, &now);
    OTX_TRY(otx_window_search_find(
        t->run, &t->search, &now, WINDOWS, windows, &count));
    OTX_TRY(otx_quilt_create(
        t->run, t->run->scratch, &t->pool, t->side, t->side, quilt));
    otx_quilt_add(quilt, 0, 0, now);
    for (int32_t i = 0; i < count; ++i)
    {
        otx_texel_map sheet;

        OTX_TRY(otx_texel_map_create(
            t->run, t->run->scratch, t->side, t->side, &sheet));
        otx_texel_pool_lay(&t->pool, windows[i], &sheet);
        otx_quilt_add(quilt, 0, 0, sheet);
    }
    lock_rim(quilt);
    OTX_TRY(sew(t, quilt));
    commit(t, quilt, x, y);
    otx_arena_release(t->run->scratch, mark);
    return OSDTEX_OK;
}

/* All of the line, in steps of half a window. */
static otx_status
cover_line(toroid *t, int32_t axis)
{
    const int32_t length = axis == 0 ? t->map.height : t->map.width;
    const int32_t half = t->side / 2;
    const int32_t steps = (length + half - 1) / half;

    for (int32_t k = 0; k < steps; ++k)
    {
        const int32_t along = (int32_t)((int64_t)k * length / steps) - half;

        OTX_TRY(
            axis == 0 ? cover(t, -half, along, axis)
                      : cover(t, along, -half, axis));
        OTX_TRY(
            otx_progress(t->run, STAGE, 0.5 * axis + 0.5 * (k + 1.0) / steps));
    }
    return OSDTEX_OK;
}

static otx_status
begin(toroid *t)
{
    const otx_image *image = &t->exemplar->lab;
    const int32_t least =
        image->width < image->height ? image->width : image->height;

    if (least < OTX_TOROID_MIN_SIDE)
        return otx_fail(
            t->run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "a picture of %d x %d texels is too small to be made to tile; it "
            "takes %d",
            image->width, image->height, OTX_TOROID_MIN_SIDE);
    t->side = 2 * (int32_t)(0.5 * WINDOW_SHARE * least);
    OTX_TRY(otx_texel_pool_create(
        t->run, t->run->scratch, t->exemplar, &t->exemplar->lab, 0, &t->pool));
    OTX_TRY(otx_texel_map_create(
        t->run, t->run->arena, image->width, image->height, &t->map));
    for (int32_t i = 0; i < image->width * image->height; ++i)
        t->map.texels[i] = i;
    return otx_window_search_create(
        t->run, t->run->scratch, &t->pool, t->side, &t->search);
}

static otx_status
make(toroid *t, otx_toroid *out)
{
    OTX_TRY(begin(t));
    if (!t->exemplar->wrap_x)
        OTX_TRY(cover_line(t, 0));
    if (!t->exemplar->wrap_y)
        OTX_TRY(cover_line(t, 1));
    out->map = t->map;
    if (t->seam_length > 0 && t->pool.random_pair > 0.0)
        out->cut = t->seam_sum / (double)t->seam_length / t->pool.random_pair;
    return otx_oddness_measure(t->run, &t->pool, &t->map, &out->oddness);
}

otx_status
otx_toroid_make(otx_run *run, const otx_exemplar *exemplar, otx_toroid *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    toroid t = {.run = run, .exemplar = exemplar};
    otx_status status;

    *out = (otx_toroid){0};
    status = make(&t, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

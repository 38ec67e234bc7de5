/* analysis.c -- does a picture have a direction, or a lattice?
 *
 * The luminance of the centre square is measured (grain.c, lags.c, lattice.c)
 * and classified. Thresholds were set on some twenty photographs and patterns;
 * what they gave is listed in docs/notes/material.md, what they make of others
 * in docs/notes/analysis.md. */
#include "analysis/analysis.h"

#include "analysis/grain.h"
#include "analysis/gravity.h"
#include "analysis/lattice.h"

#include <string.h>

static const double LAG_SHARE = 0.62;    /* longest lag, of the side */
static const double OVERLAP_SHARE = 0.3; /* of the area, least, of a turn */
static const double LATTICE_REGULARITY = 0.45, LATTICE_CONTRAST = 0.12;
static const double WEAK_REGULARITY = 0.2, WEAK_CONTRAST = 0.15;
static const double COHERENCE = 0.22;
static const double TURN_LIKENESS = 0.75;

/* Lighting from the side turns the structure tensor; where the picture is like
 * itself far along a direction nearby, that is the one. */
static const double RIDGE_REACH = OTX_PI / 12, RIDGE_LIKENESS = 0.15;

/* Of a grain that is lit from the side, or of shingles. Photographs of wood and
 * bark have .05 to .23, which changes with gamma and crop and is not seen. */
static const double SKEW = 0.3;

const char *
otx_analysis_name(otx_analysis_class kind)
{
    static const char *const names[OTX_ANALYSIS_CLASS_COUNT] = {
        "isotropic", "directional", "weak-lattice", "lattice"};

    return (unsigned)kind < OTX_ANALYSIS_CLASS_COUNT ? names[kind] : "?";
}

/* -- turns --------------------------------------------------------------- */

/* The best likeness of the square with itself turned, and for half turns the
 * point about which. */
static otx_status
measure_turn(
    const otx_square *s, otx_lags_correlator *c, int quarters, double *value,
    otx_vec2 *centre)
{
    const int32_t n = s->side;
    float *turned = OTX_NEW(s->run->scratch, float, (int64_t)n *n);
    otx_lags map = {.reach = (int32_t)((1.0 - sqrt(OVERLAP_SHARE)) * n)};
    const int32_t w = 2 * map.reach + 1;
    int32_t best = 0;

    OTX_TRY(otx_run_ok(s->run));
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            turned[y * n + x] = quarters == 2
                                    ? s->f[(n - 1 - y) * n + n - 1 - x]
                                    : s->f[(n - 1 - x) * n + y];
    /* turned(x) against f(x + lag): x' = n - 1 - x has the same colour. */
    OTX_TRY(otx_lags_likeness(s, c, turned, s->f, &map));
    for (int32_t i = 1; i < w * w; ++i)
        if (map.at[i] > map.at[best])
            best = i;
    *value = map.at[best];
    *centre = (otx_vec2){
        s->x0 + 0.5 * s->texel * (n + best % w - map.reach),
        s->y0 + 0.5 * s->texel * (n + best / w - map.reach)};
    return OSDTEX_OK;
}

/* -- the whole ----------------------------------------------------------- */

static bool
is_lattice(double regularity, double contrast)
{
    return regularity >= LATTICE_REGULARITY && contrast >= LATTICE_CONTRAST;
}

static void
classify(otx_analysis *a)
{
    const bool lattice = is_lattice(a->regularity, a->contrast);
    /* Where there is a grain it says more than a weak lattice. */
    const bool weak = !lattice && a->coherence < COHERENCE &&
                      a->regularity >= WEAK_REGULARITY &&
                      a->contrast >= WEAK_CONTRAST;
    bool even;

    a->kind = lattice                     ? OTX_ANALYSIS_LATTICE
              : weak                      ? OTX_ANALYSIS_WEAK_LATTICE
              : a->coherence >= COHERENCE ? OTX_ANALYSIS_DIRECTIONAL
                                          : OTX_ANALYSIS_ISOTROPIC;
    even = lattice ? a->half_turn >= TURN_LIKENESS : a->skew < SKEW;
    a->symmetry =
        a->quarter_turn >= TURN_LIKENESS && !(a->coherence >= COHERENCE) ? 4
        : even                                                           ? 2
                                                                         : 1;
    if (a->kind == OTX_ANALYSIS_ISOTROPIC)
        a->symmetry = 0;
    if (lattice || a->kind == OTX_ANALYSIS_ISOTROPIC)
        a->angle = 0.0;
    else if (weak)
    {
        const otx_vec2 *g = a->generators;
        const otx_vec2 s =
            otx_vec2_length(g[0]) <= otx_vec2_length(g[1]) ? g[0] : g[1];

        a->angle = atan2(s.y, s.x);
    }
    a->angle -= OTX_PI * floor(a->angle / OTX_PI);
    if (!lattice && !weak)
        a->generators[0] = a->generators[1] = (otx_vec2){0, 0};
}

/* Of roof tiles the columns outshine the ends of the tiles, so that half a tile
 * further along all looks alike. What changes along the grain is therefore
 * given as much say as the whole. */
static otx_status
look_along(
    const otx_square *s, otx_lags_correlator *c, const otx_lags *whole,
    double angle, otx_lattice *lattice)
{
    otx_lags map = {.reach = whole->reach};
    const int32_t w = 2 * map.reach + 1;
    otx_lattice found;
    float *slope;

    OTX_TRY(otx_grain_slope(s, angle, &slope));
    OTX_TRY(otx_lags_likeness(s, c, slope, slope, &map));
    for (int32_t i = 0; i < w * w; ++i)
        map.at[i] = 0.5f * (map.at[i] + whole->at[i]);
    otx_lattice_find(&map, &found);
    if (is_lattice(found.regularity, found.contrast))
        *lattice = found;
    return OSDTEX_OK;
}

static otx_status
measure(const otx_square *s, otx_analysis *out)
{
    otx_lags map = {.reach = (int32_t)(LAG_SHARE * s->side)};
    otx_lags_correlator c;
    otx_lattice lattice;
    otx_gravity gravity;
    otx_grain grain;
    double ridge, likeness;
    otx_vec2 unused;

    OTX_TRY(otx_grain_measure(s, &grain));
    OTX_TRY(otx_gravity_measure(s, &gravity));
    OTX_TRY(otx_lags_prepare(s, &c));
    OTX_TRY(otx_lags_likeness(s, &c, s->f, s->f, &map));
    otx_lattice_find(&map, &lattice);
    ridge = otx_lags_ridge(&map, grain.angle, RIDGE_REACH, &likeness);
    if (likeness >= RIDGE_LIKENESS)
        grain.angle = ridge;
    if (grain.coherence >= COHERENCE &&
        !is_lattice(lattice.regularity, lattice.contrast))
        OTX_TRY(look_along(s, &c, &map, grain.angle, &lattice));
    out->upright = gravity.upright;
    out->angle = grain.angle;
    out->coherence = grain.coherence;
    out->skew = grain.skew;
    out->regularity = lattice.regularity;
    out->contrast = lattice.contrast;
    memcpy(out->generators, lattice.generators, sizeof out->generators);
    OTX_TRY(measure_turn(s, &c, 2, &out->half_turn, &out->centre));
    return measure_turn(s, &c, 1, &out->quarter_turn, &unused);
}

otx_status
otx_analysis_run(
    otx_run *run, const otx_image *lab, bool wrap_x, bool wrap_y,
    otx_analysis *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_square s;

    *out = (otx_analysis){0};
    OTX_TRY(otx_square_cut(run, lab, &s));
    OTX_TRY(measure(&s, out));
    classify(out);
    for (int k = 0; k < 2; ++k)
        out->generators[k] = otx_vec2_scale(s.texel, out->generators[k]);
    if (out->kind == OTX_ANALYSIS_LATTICE)
        otx_lattice_fit(lab, wrap_x, wrap_y, out->generators);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_analysis_force_lattice(
    otx_run *run, const otx_image *lab, const otx_vec2 generators[2],
    otx_analysis *out)
{
    otx_vec2 g[2] = {generators[0], generators[1]};
    const double a = otx_vec2_length(g[0]), b = otx_vec2_length(g[1]);
    const double longest = hypot(lab->width, lab->height);

    /* Written so that NaN is refused too. */
    if (!(fabs(otx_vec2_cross(g[0], g[1])) >= 0.1 * a * b) || !(a >= 4.0) ||
        !(b >= 4.0) || a > longest || b > longest)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "exemplar", OTX_NOWHERE,
            "the generators (%g, %g) and (%g, %g) do not span a lattice cell "
            "inside the picture",
            g[0].x, g[0].y, g[1].x, g[1].y);
    OTX_TRY(otx_analysis_run(run, lab, false, false, out));
    otx_lattice_order(g);
    out->kind = OTX_ANALYSIS_LATTICE;
    out->upright = false;
    out->generators[0] = g[0];
    out->generators[1] = g[1];
    out->symmetry = out->half_turn >= TURN_LIKENESS ? 2 : 1;
    out->angle = 0.0;
    return OSDTEX_OK;
}

/* match_maps.c -- principal axes of colours and maps together. Sums are made
 * row by row, so that they do not depend on the number of threads. */
#include "exemplar/match_maps.h"

#include "exemplar/statistics.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
    COLORS = 3,
    CHANNELS = COLORS + OTX_COMPANION_COUNT,
    KEPT = 3,
    SWEEPS = 40 /* of Jacobi; eight channels take five */
};

static const char STAGE[] = "material";

typedef struct row_sums
{
    double mean[CHANNELS], square[CHANNELS][CHANNELS];
} row_sums;

typedef struct mixing
{
    const otx_exemplar *from;
    double factors[CHANNELS]; /* of channels as they are, 0: it counts not */
    row_sums *rows;
    double mean[CHANNELS];
    double axes[KEPT][CHANNELS];
    otx_image *to;
} mixing;

/* ---- what places are told apart by ---- */

static double
tilt(const float *n)
{
    const double flat = (double)n[0] * n[0] + (double)n[1] * n[1];
    const double all = flat + (double)n[2] * n[2];

    return all > 0.0 ? sqrt(flat / all) : 0.0;
}

/* The maps at a texel of the picture: means where they have several there. */
static void
read_maps(const otx_exemplar *e, int32_t x, int32_t y, double *out)
{
    const otx_companions *c = &e->companions;
    const int32_t n = c->image.width / e->match.width;

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        out[k] = 0.0;
    for (int32_t j = 0; j < n; ++j)
        for (int32_t i = 0; i < n; ++i)
        {
            const float *p = otx_image_at(&c->image, n * x + i, n * y + j);

            for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
                if (c->maps[k].is_there)
                    out[k] += (k == OTX_COMPANION_NORMAL
                                   ? tilt(p + c->maps[k].first)
                                   : (double)p[c->maps[k].first]) /
                              ((double)n * n);
        }
}

static void
read_texel(const mixing *m, int32_t x, int32_t y, double *out)
{
    const float *color = otx_image_at(&m->from->match, x, y);

    for (int k = 0; k < COLORS; ++k)
        out[k] = (double)color[k];
    read_maps(m->from, x, y, out + COLORS);
    for (int k = 0; k < CHANNELS; ++k)
        out[k] *= m->factors[k];
}

/* ---- how they vary ---- */

static otx_status
sum_row(void *context, int64_t y, otx_worker *worker)
{
    const mixing *m = context;
    row_sums r = {0};
    double t[CHANNELS];

    (void)worker;
    for (int32_t x = 0; x < m->from->match.width; ++x)
    {
        read_texel(m, x, (int32_t)y, t);
        for (int a = 0; a < CHANNELS; ++a)
        {
            r.mean[a] += t[a] - m->mean[a];
            for (int b = 0; b <= a; ++b)
                r.square[a][b] += (t[a] - m->mean[a]) * (t[b] - m->mean[b]);
        }
    }
    m->rows[y] = r;
    return OSDTEX_OK;
}

/* Sets the means and covariances; deviations are taken from a texel. */
static otx_status
survey(otx_run *run, mixing *m, double covariance[CHANNELS][CHANNELS])
{
    const otx_image *image = &m->from->match;
    const double texels = (double)image->width * image->height;
    row_sums all = {0};

    read_texel(m, 0, 0, m->mean);
    OTX_TRY(otx_pool_for(run->pool, image->height, sum_row, m));
    for (int32_t y = 0; y < image->height; ++y)
        for (int a = 0; a < CHANNELS; ++a)
        {
            all.mean[a] += m->rows[y].mean[a] / texels;
            for (int b = 0; b <= a; ++b)
                all.square[a][b] += m->rows[y].square[a][b] / texels;
        }
    for (int a = 0; a < CHANNELS; ++a)
        for (int b = 0; b <= a; ++b)
            covariance[a][b] = covariance[b][a] =
                all.square[a][b] - all.mean[a] * all.mean[b];
    for (int a = 0; a < CHANNELS; ++a)
        m->mean[a] += all.mean[a];
    return OSDTEX_OK;
}

/* So that the colours together, and each map, differ by their weights, and all
 * by as much as the colours did. */
static otx_status
choose_factors(otx_run *run, const otx_match_weights *weights, mixing *m)
{
    double c[CHANNELS][CHANNELS], spread[1 + OTX_COMPANION_COUNT];
    double factors[1 + OTX_COMPANION_COUNT], sum = 0.0, color = 0.0;

    for (int k = 0; k < CHANNELS; ++k)
        m->factors[k] = 1.0;
    OTX_TRY(survey(run, m, c));
    for (int k = 0; k < COLORS; ++k)
        color += fmax(c[k][k], 0.0);
    spread[0] = sqrt(color);
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        spread[1 + k] = sqrt(fmax(c[COLORS + k][COLORS + k], 0.0));
    for (int k = 0; k <= OTX_COMPANION_COUNT; ++k)
    {
        const double weight = k == 0 ? weights->color : weights->maps[k - 1];

        factors[k] = spread[k] > 1e-9 ? weight : 0.0;
        sum += factors[k] * factors[k];
    }
    for (int k = 0; k <= OTX_COMPANION_COUNT; ++k)
        factors[k] *=
            sum > 0.0 && spread[k] > 1e-9
                ? (spread[0] > 1e-9 ? spread[0] : 1.0) / (sqrt(sum) * spread[k])
                : 0.0;
    for (int k = 0; k < COLORS; ++k)
        m->factors[k] = factors[0];
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        m->factors[COLORS + k] = factors[1 + k];
    return OSDTEX_OK;
}

/* ---- the axes ---- */

/* Turns rows and columns p and q so that they part. */
static void
rotate(double a[CHANNELS][CHANNELS], double v[CHANNELS][CHANNELS], int p, int q)
{
    const double theta = 0.5 * atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
    const double c = cos(theta), s = sin(theta);

    for (int k = 0; k < CHANNELS; ++k)
    {
        const double x = a[k][p], y = a[k][q];

        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
    }
    for (int k = 0; k < CHANNELS; ++k)
    {
        const double x = a[p][k], y = a[q][k];
        const double g = v[p][k], h = v[q][k];

        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
        v[p][k] = c * g - s * h;
        v[q][k] = s * g + c * h;
    }
}

/* The axes of most variance, each with its largest part upward; returns the
 * share of all variance along them. */
static double
choose_axes(double a[CHANNELS][CHANNELS], mixing *m)
{
    double v[CHANNELS][CHANNELS] = {{0.0}}, all = 0.0, kept = 0.0;
    bool taken[CHANNELS] = {false};

    for (int k = 0; k < CHANNELS; ++k)
    {
        v[k][k] = 1.0;
        all += a[k][k];
    }
    for (int i = 0; i < SWEEPS; ++i)
        for (int p = 0; p < CHANNELS; ++p)
            for (int q = p + 1; q < CHANNELS; ++q)
                if (fabs(a[p][q]) > 1e-15 * all)
                    rotate(a, v, p, q);
    for (int k = 0; k < KEPT; ++k)
    {
        int best = -1, large = 0;

        for (int i = 0; i < CHANNELS; ++i)
            if (!taken[i] && (best < 0 || a[i][i] > a[best][best]))
                best = i;
        taken[best] = true;
        kept += fmax(a[best][best], 0.0);
        for (int i = 1; i < CHANNELS; ++i)
            if (fabs(v[best][i]) > fabs(v[best][large]))
                large = i;
        for (int i = 0; i < CHANNELS; ++i)
            m->axes[k][i] = v[best][large] < 0.0 ? -v[best][i] : v[best][i];
    }
    return all > 0.0 ? kept / all : 1.0;
}

static otx_status
project_row(void *context, int64_t y, otx_worker *worker)
{
    const mixing *m = context;
    double t[CHANNELS];

    (void)worker;
    for (int32_t x = 0; x < m->to->width; ++x)
    {
        float *out = otx_image_at(m->to, x, (int32_t)y);

        read_texel(m, x, (int32_t)y, t);
        for (int k = 0; k < KEPT; ++k)
        {
            double sum = 0.0;

            for (int i = 0; i < CHANNELS; ++i)
                sum += m->axes[k][i] * (t[i] - m->mean[i]);
            out[k] = (float)sum;
        }
    }
    return OSDTEX_OK;
}

/* ---- all of it ---- */

static otx_status
check(otx_run *run, const otx_match_weights *weights, const otx_exemplar *e)
{
    bool good = weights->color >= 0.0 && !isinf(weights->color);

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        good = good && weights->maps[k] >= 0.0 && !isinf(weights->maps[k]);
    if (!good)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "what a map weighs in the match is a number from 0 on");
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        if (weights->maps[k] > 0.0 && !e->companions.maps[k].is_there)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE,
                otx_where_file(e->source_path),
                "the match is to look at the %s map, and the material has "
                "none; name its file with {map}, or leave it out of "
                "{match-maps}",
                otx_companion_name((otx_companion_kind)k));
    return OSDTEX_OK;
}

static bool
has_maps(const otx_match_weights *weights)
{
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        if (weights->maps[k] > 0.0)
            return true;
    return false;
}

static void
say(otx_run *run, const otx_match_weights *weights, const mixing *m,
    double share)
{
    char text[256] = "";

    for (int k = -1; k < OTX_COMPANION_COUNT; ++k)
    {
        const double weight = k < 0 ? weights->color : weights->maps[k];
        const char *name =
            k < 0 ? "color" : otx_companion_name((otx_companion_kind)k);
        const size_t used = strlen(text);

        if (weight > 0.0)
            snprintf(
                text + used, sizeof text - used, "%s%s (%g%s)",
                used > 0 ? ", " : "", name, weight,
                m->factors[k < 0 ? 0 : COLORS + k] > 0.0 ? "" : ", all alike");
    }
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "the match looks at %s; three channels hold %.1f %% of what they vary "
        "by",
        text, 100.0 * share);
}

static otx_status
mix(otx_run *run, const otx_match_weights *weights, otx_exemplar *e)
{
    double covariance[CHANNELS][CHANNELS], share;
    mixing m = {.from = e};
    otx_image made;

    m.rows = OTX_NEW(run->scratch, row_sums, e->match.height);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(choose_factors(run, weights, &m));
    OTX_TRY(survey(run, &m, covariance));
    share = choose_axes(covariance, &m);
    OTX_TRY(otx_image_create(
        run, run->arena, e->match.width, e->match.height, KEPT, &made));
    m.to = &made;
    OTX_TRY(otx_pool_for(run->pool, made.height, project_row, &m));
    e->match = made;
    e->mixes_maps = true;
    say(run, weights, &m, share);
    return otx_exemplar_measure(run, e);
}

otx_status
otx_match_maps_mix(
    otx_run *run, const otx_match_weights *weights, otx_exemplar *e)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_status status;

    OTX_TRY(check(run, weights, e));
    if (!has_maps(weights) || !e->match.pixels)
        return OSDTEX_OK;
    status = mix(run, weights, e);
    otx_arena_release(run->scratch, mark);
    return status;
}

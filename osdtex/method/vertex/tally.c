/* tally.c -- figures of what was made. */
#include "method/vertex/vertex.h"

#include "base/sort.h"
#include "image/view.h"

enum
{
    CELLS = 16,      /* along each side of the exemplar */
    SAMPLES = 65536, /* of lightness, about */
    RANKS = 256
};

/* Sums over the texels that were made. */
typedef struct tally
{
    int64_t texels, continued, pairs, held;
    double departure; /* from the field, radians */
    int64_t used[CELLS * CELLS];
    double *lightness; /* of every `stride`-th texel */
    int64_t stride, samples;
} tally;

/* Whether the right neighbour goes on within three quarters of a texel. */
static void
compare(const otx_synth_chart *c, int64_t i, tally *t)
{
    const otx_synth_match a = c->matches[i], b = c->matches[i + 1];
    const float *m = c->metric + 3 * i;
    const float dx = a.x + a.c * m[0] - a.s * m[1] - b.x;
    const float dy = a.y + a.s * m[0] + a.c * m[1] - b.y;

    ++t->pairs;
    t->continued += dx * dx + dy * dy < 0.5625f;
}

static double
departure_of(const float *field, otx_synth_match m, int32_t symmetry)
{
    const double turn = 2.0 * OTX_PI / symmetry;
    const double angle = fabs(atan2(
        (double)(m.s * field[0] - m.c * field[1]),
        (double)(m.c * field[0] + m.s * field[1])));
    const double rest = angle - turn * floor(angle / turn);

    return fmin(rest, turn - rest);
}

static int32_t
cell_of(double at, int32_t side)
{
    const int32_t cell = (int32_t)(CELLS * at / side);

    return cell < 0 ? 0 : cell >= CELLS ? CELLS - 1 : cell;
}

static void
look(const otx_exemplar *e, otx_synth_match m, tally *t)
{
    const otx_vec2 at = {(double)m.x, (double)m.y};
    float lab[3];

    ++t->used
          [cell_of(at.y, e->lab.height) * CELLS + cell_of(at.x, e->lab.width)];
    if (t->texels++ % t->stride != 0)
        return;
    otx_view_value(otx_view_of(&e->lab, e->wrap_x, e->wrap_y), at, lab);
    t->lightness[t->samples++] = (double)lab[0];
}

static void
add_chart(
    const otx_exemplar *e, const otx_synth_chart *c, int32_t symmetry, tally *t)
{
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const int64_t i = (int64_t)y * c->width + x;

            if (c->kinds[i] != OTX_SYNTH_FREE)
                continue;
            look(e, c->matches[i], t);
            if (x + 1 < c->width && c->kinds[i + 1] == OTX_SYNTH_FREE)
                compare(c, i, t);
            if (!c->field ||
                (c->field[2 * i] == 0.0f && c->field[2 * i + 1] == 0.0f))
                continue;
            ++t->held;
            t->departure +=
                departure_of(c->field + 2 * i, c->matches[i], symmetry);
        }
}

static double
spread_of(const double *values, int64_t count)
{
    double sum = 0.0, squares = 0.0;

    for (int64_t i = 0; i < count; ++i)
        sum += values[i];
    sum /= (double)count;
    for (int64_t i = 0; i < count; ++i)
        squares += (values[i] - sum) * (values[i] - sum);
    return sqrt(squares / (double)count);
}

/* Mean distance of the values of equal rank; both sorted. */
static double
distance_of(const double *a, int64_t a_count, const double *b, int64_t b_count)
{
    double sum = 0.0;

    for (int64_t r = 0; r < RANKS; ++r)
        sum += fabs(
            a[r * (a_count - 1) / (RANKS - 1)] -
            b[r * (b_count - 1) / (RANKS - 1)]);
    return sum / RANKS;
}

/* Share of the exemplar that is used: e to the entropy of its cells. */
static double
use_of(const tally *t)
{
    double entropy = 0.0;

    for (int32_t i = 0; i < CELLS * CELLS; ++i)
    {
        const double share = (double)t->used[i] / (double)t->texels;

        entropy -= share > 0.0 ? share * log(share) : 0.0;
    }
    return exp(entropy) / (CELLS * CELLS);
}

static otx_status
report_lightness(const otx_vertex *v, tally *t)
{
    const otx_image *lab = &v->job->exemplars->lab;
    const int64_t count = (int64_t)lab->width * lab->height;
    double *values = OTX_NEW(v->run->scratch, double, count);

    if (!values)
        return otx_fail_memory(v->run, "map");
    for (int64_t i = 0; i < count; ++i)
        values[i] = (double)lab->pixels[i * lab->channels];
    otx_sort_doubles(values, (size_t)count);
    otx_sort_doubles(t->lightness, (size_t)t->samples);

    const double spread = spread_of(values, count);

    if (!(spread > 0.0))
        return OSDTEX_OK;
    otx_figures_real(
        v->job->figures, "made.contrast", "",
        spread_of(t->lightness, t->samples) / spread);
    otx_figures_real(
        v->job->figures, "made.histogram", "",
        distance_of(t->lightness, t->samples, values, count) / spread);
    return OSDTEX_OK;
}

static otx_status
count_all(const otx_vertex *v, tally *t)
{
    int64_t texels = 0;

    for (int32_t k = 0; k < v->set.territory.count; ++k)
        texels += v->set.targets[k].free;
    *t = (tally){.stride = texels / SAMPLES + 1};
    t->lightness = OTX_NEW(v->run->scratch, double, texels / t->stride + 1);
    OTX_TRY(otx_run_ok(v->run));
    for (int32_t k = 0; k < v->set.territory.count; ++k)
        add_chart(v->job->exemplars, &v->charts[k], v->guide.symmetry, t);
    return OSDTEX_OK;
}

otx_status
otx_vertex_report(const otx_vertex *v)
{
    otx_figures *f = v->job->figures;
    tally *t = OTX_NEW(v->run->scratch, tally, 1);

    if (!t)
        return otx_fail_memory(v->run, "map");
    OTX_TRY(count_all(v, t));
    otx_figures_count(f, "made.charts", "charts", v->set.territory.count);
    otx_figures_count(f, "made.texels", "texels", t->texels);
    if (t->pairs > 0)
        otx_figures_real(
            f, "made.coherence", "", (double)t->continued / (double)t->pairs);
    if (t->texels == 0)
        return OSDTEX_OK;
    if (t->held > 0)
        otx_figures_real(
            f, "made.departure", "degrees",
            180.0 / OTX_PI * t->departure / (double)t->held);
    otx_figures_real(f, "made.used", "", use_of(t));
    return report_lightness(v, t);
}

/* measure.c -- sums and quantiles over faces and seams, in index order.
 *
 * Stretch is that of [Sander01], taken from one linear map per face: the least
 * squares fit of the face's UVs to its corners, which for a triangle is the
 * triangle's and for a quad does not depend on a choice of diagonal.
 *
 * [Sander01] Sander, Snyder, Gortler, Hoppe: Texture mapping progressive
 * meshes. SIGGRAPH 2001. */
#include "mapping/measure.h"

#include "mapping/coverage.h"
#include "mapping/laid_face.h"
#include "mapping/seam.h"
#include "mapping/series.h"
#include "mapping/window.h"
#include "surface/limit.h"

static const char stage[] = "measure";

typedef struct survey
{
    const otx_mapping *mapping;
    const otx_exemplar *exemplars;
    int32_t exemplar_count;
    const otx_level *leaf;
    double texels_per_unit;
    otx_series l2, ratio, log_area;
    otx_coverage uses[OTX_EXEMPLARS_MAX];
    otx_laid_face face; /* the one at hand */
    int32_t source;     /* the exemplar that it shows */
} survey;

/* Sums of products of two centred point sets: xx xy yx yy. */
static void
products(const otx_vec2 *a, const otx_vec2 *b, int32_t count, double sums[4])
{
    otx_vec2 ma = {0.0, 0.0}, mb = {0.0, 0.0};

    for (int32_t k = 0; k < count; ++k)
    {
        ma = otx_vec2_add(ma, otx_vec2_scale(1.0 / count, a[k]));
        mb = otx_vec2_add(mb, otx_vec2_scale(1.0 / count, b[k]));
    }
    sums[0] = sums[1] = sums[2] = sums[3] = 0.0;
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_vec2 p = otx_vec2_sub(a[k], ma), q = otx_vec2_sub(b[k], mb);

        sums[0] += p.x * q.x;
        sums[1] += p.x * q.y;
        sums[2] += p.y * q.x;
        sums[3] += p.y * q.y;
    }
}

/* Singular values, first the larger, of the linear map that fits q to p.
 * False when the face or its map has no area, or the map is reversed. */
static bool
singular_values(const otx_laid_face *face, double *larger, double *smaller)
{
    double pp[4], qp[4];

    products(face->p, face->p, face->size, pp);
    products(face->q, face->p, face->size, qp);

    const double det = pp[0] * pp[3] - pp[1] * pp[2];

    if (!(det > 0.0))
        return false;

    const double a = (qp[0] * pp[3] - qp[1] * pp[2]) / det;
    const double b = (qp[1] * pp[0] - qp[0] * pp[1]) / det;
    const double c = (qp[2] * pp[3] - qp[3] * pp[2]) / det;
    const double d = (qp[3] * pp[0] - qp[2] * pp[1]) / det;
    /* Half the sum and half the difference of the singular values. */
    const double sum = 0.5 * hypot(a + d, b - c);
    const double difference = 0.5 * hypot(a - d, b + c);

    *larger = sum + difference;
    *smaller = sum - difference;
    return *smaller > 0.0 && a * d - b * c > 0.0;
}

static void
use_face(survey *s, const otx_laid_face *face)
{
    for (int32_t k = 1; k + 1 < face->size; ++k)
    {
        const otx_vec2 p[3] = {face->p[0], face->p[k], face->p[k + 1]};
        const otx_vec2 q[3] = {
            otx_vec2_scale(s->texels_per_unit, face->q[0]),
            otx_vec2_scale(s->texels_per_unit, face->q[k]),
            otx_vec2_scale(s->texels_per_unit, face->q[k + 1])};

        otx_coverage_add(
            &s->uses[s->source], q, fabs(otx_laid_face_area(p, 3)));
    }
}

/* Texels by which a face leaves a picture that does not tile. */
static double
overhang(const survey *s, const otx_laid_face *face)
{
    const otx_exemplar *exemplar = &s->exemplars[s->source];
    double most = 0.0;

    for (int32_t k = 0; k < face->size; ++k)
    {
        const otx_vec2 t = otx_vec2_scale(s->texels_per_unit, face->q[k]);

        if (!exemplar->wrap_x)
            most = fmax(most, fmax(-t.x, t.x - exemplar->match.width));
        if (!exemplar->wrap_y)
            most = fmax(most, fmax(-t.y, t.y - exemplar->match.height));
    }
    return most;
}

static void
survey_face(survey *s, int32_t index, otx_measure *out)
{
    otx_laid_face *face = &s->face;
    double larger, smaller;

    s->source = otx_source_of(s->mapping, index);
    otx_laid_face_set(
        s->mapping, &s->exemplars[s->source], s->texels_per_unit, index, face);

    const double area = otx_laid_face_area(face->p, face->size);
    const double uv_area = otx_laid_face_area(face->q, face->size);
    const double beyond = overhang(s, face);
    const bool flipped =
        !(uv_area > 0.0) &&
        !otx_limit_face_is_flat(s->leaf, s->mapping->surface->points, index);

    out->area += area * s->texels_per_unit * s->texels_per_unit;
    out->shares[s->source].area +=
        area * s->texels_per_unit * s->texels_per_unit;
    ++out->shares[s->source].faces;
    out->flips += flipped;
    out->folds += uv_area > 0.0 && otx_laid_face_is_folded(face);
    out->outside += beyond > OTX_SEAM_TOLERANCE;
    out->outside_max = fmax(out->outside_max, beyond);
    use_face(s, face);
    if (!(uv_area > 0.0) || !singular_values(face, &larger, &smaller))
        return;
    otx_series_add(
        &s->l2,
        sqrt(0.5 * (1.0 / (larger * larger) + 1.0 / (smaller * smaller))),
        area);
    otx_series_add(&s->ratio, larger / smaller, area);
    otx_series_add(&s->log_area, fabs(log(larger * smaller)), area);
}

static void
measure_coverage(const survey *s, otx_measure *out)
{
    double sum = 0.0;

    for (int32_t k = 0; k < s->exemplar_count; ++k)
    {
        out->shares[k].coverage = otx_coverage_evenness(&s->uses[k]);
        sum += out->shares[k].coverage * out->shares[k].area;
    }
    out->coverage = s->exemplar_count == 1 ? out->shares[0].coverage
                    : out->area > 0.0      ? sum / out->area
                                           : 0.0;
}

static bool
allocate_survey(otx_run *run, survey *s)
{
    otx_series *all[] = {&s->l2, &s->ratio, &s->log_area};

    for (int32_t k = 0; k < s->exemplar_count; ++k)
        if (!otx_coverage_begin(run->scratch, &s->exemplars[k], &s->uses[k]))
            return false;
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    {
        all[i]->items =
            OTX_NEW(run->scratch, otx_series_item, s->leaf->face_count);
        if (!all[i]->items)
            return false;
    }
    return true;
}

static otx_status
measure_faces(otx_run *run, survey *s, otx_measure *out)
{
    const otx_mapping *mapping = s->mapping;
    uint8_t *used = OTX_ZNEW(run->scratch, uint8_t, mapping->patch_count);

    if (!used || !allocate_survey(run, s))
        return otx_fail_memory(run, stage);
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
    {
        const int32_t patch = mapping->face_patch[f];

        if (s->leaf->face_hole[f])
            continue;
        if (!otx_seam_covered(mapping, f))
        {
            ++out->uncovered;
            continue;
        }
        if (patch < mapping->patch_count && !used[patch])
        {
            used[patch] = 1;
            ++out->patches;
        }
        survey_face(s, f, out);
    }
    out->log_area_mean = otx_series_mean(&s->log_area);
    out->stretch_l2_mean = otx_series_mean(&s->l2);
    out->stretch_l2_p95 = otx_series_quantile(&s->l2, 0.95);
    out->stretch_ratio_mean = otx_series_mean(&s->ratio);
    out->stretch_ratio_p95 = otx_series_quantile(&s->ratio, 0.95);
    measure_coverage(s, out);
    return OSDTEX_OK;
}

static void
sum_seams(const survey *s, const otx_seam_list *list, otx_measure *out)
{
    const double length = list->total_length - list->transition_length;
    double energy = 0.0, visible = 0.0;

    for (int32_t i = 0; i < list->edge_count; ++i)
    {
        const int32_t first = list->sample_first[i];
        const int32_t end = list->sample_first[i + 1];
        const int32_t face = s->leaf->edge_faces[2 * (size_t)list->edges[i]];
        const double step =
            s->exemplars[otx_source_of(s->mapping, face)].lab_step;
        double sum = 0.0;

        if (list->transition[i])
            continue;
        for (int32_t k = first; k < end; ++k)
            sum += list->samples[k];
        sum /= end - first;
        energy += list->lengths[i] * sum;
        visible += sum > step ? list->lengths[i] : 0.0;
    }
    out->seam_length = length;
    out->transition_length = list->transition_length;
    if (out->area > 0.0)
    {
        out->seam_energy = energy / out->area;
        /* Lines of length L per area A are met 2 L / (pi A) times by a straight
         * line of unit length [Buffon]. */
        out->seams_per_100 = 100.0 * 2.0 / OTX_PI * length / out->area;
    }
    if (length > 0.0)
        out->seam_visible_share = visible / length;
    if (list->interior_length > 0.0)
        out->seam_share = length / list->interior_length;
}

static double
ratio_or_zero(double value, double unit)
{
    return unit > 0.0 ? value / unit : 0.0;
}

/* Samples of the seams, or of the transitions; the sum of their squares. */
static double
take_samples(const otx_seam_list *list, bool transition, otx_series *out)
{
    double squares = 0.0;

    for (int32_t i = 0; i < list->edge_count; ++i)
        for (int32_t k = list->sample_first[i];
             k < list->sample_first[i + 1] && list->transition[i] == transition;
             ++k)
        {
            squares += (double)list->samples[k] * list->samples[k];
            otx_series_add(out, list->samples[k], 1.0);
        }
    return squares;
}

static otx_status
measure_seams(
    otx_run *run, const survey *faces, const otx_seam_list *list,
    otx_measure *out)
{
    const int32_t count = list->sample_first[list->edge_count];
    otx_series s = {.items = OTX_NEW(run->scratch, otx_series_item, count)};
    double squares;

    OTX_TRY(otx_run_ok(run));
    sum_seams(faces, list, out);
    squares = take_samples(list, true, &s);
    out->transition_rms = s.count > 0 ? sqrt(squares / s.count) : 0.0;
    s.count = 0;
    squares = take_samples(list, false, &s);
    out->seam_rms = s.count > 0 ? sqrt(squares / s.count) : 0.0;
    out->seam_p50 = otx_series_quantile(&s, 0.5);
    out->seam_p95 = otx_series_quantile(&s, 0.95);
    out->seam_rms_sigma = ratio_or_zero(out->seam_rms, out->lab_sigma);
    out->seam_rms_step = ratio_or_zero(out->seam_rms, out->lab_step);
    out->seam_p95_sigma = ratio_or_zero(out->seam_p95, out->lab_sigma);
    return OSDTEX_OK;
}

static otx_status
measure_windows(
    otx_run *run, survey *s, const otx_seam_list *seams, int32_t count,
    otx_measure *out)
{
    otx_window_figures figures;

    OTX_TRY(otx_window_measure(
        run, s->mapping, s->exemplars, seams, count, &figures));
    out->windows = figures.seam_count;
    out->window_seam_p50 = figures.seam_p50;
    out->window_seam_p90 = figures.seam_p90;
    out->window_interior_p50 = figures.interior_p50;
    out->window_interior_p90 = figures.interior_p90;
    return OSDTEX_OK;
}

static otx_status
measure_all(
    otx_run *run, survey *s, const otx_measure_options *options,
    otx_measure *out)
{
    otx_seam_list seams;

    OTX_TRY(measure_faces(run, s, out));
    OTX_TRY(otx_progress(run, stage, 0.2));
    OTX_TRY(otx_seam_collect(run, s->mapping, s->exemplars, &seams));
    OTX_TRY(measure_seams(run, s, &seams, out));
    OTX_TRY(otx_progress(run, stage, 0.5));
    if (options->window_count > 0)
        OTX_TRY(measure_windows(run, s, &seams, options->window_count, out));
    return otx_progress(run, stage, 1.0);
}

otx_status
otx_measure_run(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_measure_options *options, otx_measure *out)
{
    const otx_measure_options defaults = otx_measure_options_default();
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    survey s = {
        .mapping = mapping,
        .exemplars = exemplars,
        .exemplar_count = otx_source_count(mapping),
        .leaf = otx_surface_leaf(mapping->surface),
        .texels_per_unit = otx_seam_texels_per_unit(mapping, exemplars),
    };

    *out = (otx_measure){
        .texels_per_unit = s.texels_per_unit,
        .lab_sigma = exemplars->lab_sigma,
        .lab_step = exemplars->lab_step,
    };

    if (!exemplars->lab.pixels)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "measure", OTX_NOWHERE,
            "the mapping was read to be looked up only, without what its "
            "figures are measured by; read it again with figures");

    const otx_status status =
        measure_all(run, &s, options ? options : &defaults, out);

    otx_arena_release(run->scratch, mark);
    return status;
}

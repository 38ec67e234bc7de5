/* bond.c -- which course of the exemplar each strip shows, and from where.
 *
 * A strip continues its longest neighbour: it shows the next course, shifted
 * so that what is side by side in the exemplar is so on the surface as far as
 * may be. A ring is closed where two columns of its course look alike, which
 * stretches it least; in masonry that is from one head joint to another. */
#include "method/material/strips.h"

#include "analysis/courses.h"
#include "image/view.h"

#include <string.h>

enum
{
    COLUMNS_MAX = 256, /* of a course that are compared */
    SAMPLES = 12       /* of a column */
};

/* What a ring's squared strain costs, of a random pair of columns 1. */
static const double STRAIN_COST = 4.0;

/* -- columns ------------------------------------------------------------- */

typedef struct columns
{
    int32_t count;
    float *colors; /* [courses * count * SAMPLES * 3] */
} columns;

static otx_status
read_columns(const otx_material *m, columns *out)
{
    float *to;

    out->count = (int32_t)fmin(COLUMNS_MAX, m->courses.period);
    out->colors = to = OTX_NEW(
        m->job->run->scratch, float,
        3 * (int64_t)m->courses.count * out->count * SAMPLES);
    OTX_TRY(otx_run_ok(m->job->run));
    for (int32_t c = 0; c < m->courses.count; ++c)
        for (int32_t i = 0; i < out->count; ++i)
            for (int32_t k = 0; k < SAMPLES; ++k, to += 3)
                otx_view_value(
                    otx_view_of(&m->job->exemplars->match, true, true),
                    otx_courses_texel(
                        &m->courses, (i + 0.5) * m->courses.period / out->count,
                        c + (k + 0.5) / SAMPLES),
                    to);
    return OSDTEX_OK;
}

/* Mean squared distance of two columns of a course, of random texels 1. */
static double
column_distance(
    const otx_material *m, const columns *c, int32_t course, int32_t a,
    int32_t b)
{
    const float *of =
        c->colors + (size_t)course * (size_t)c->count * SAMPLES * 3;
    const double sigma = m->job->exemplars->match_sigma;
    double sum = 0.0;

    for (int32_t k = 0; k < SAMPLES; ++k)
        sum += otx_image_distance_sq(
            of + 3 * ((size_t)a * SAMPLES + (size_t)k),
            of + 3 * ((size_t)b * SAMPLES + (size_t)k));
    return sum / (SAMPLES * fmax(sigma * sigma, 1e-12));
}

/* -- rings --------------------------------------------------------------- */

/* From where to where a ring is to show its course. */
static void
close_ring(const otx_material *m, const columns *c, otx_course_strip *strip)
{
    const double texel = m->courses.period / c->count;
    double best = INFINITY;

    for (int32_t start = 0; start < c->count; ++start)
        for (int32_t end = 0; end < c->count; ++end)
        {
            const double part = (end - start) * texel;
            const double closing =
                part +
                m->courses.period *
                    fmax(
                        round((strip->length - part) / m->courses.period),
                        part > 0.0 ? 0.0 : 1.0);
            const double strain = log(closing / strip->length);
            double cost = STRAIN_COST * strain * strain;

            if (!(cost < best))
                continue;
            cost += column_distance(m, c, strip->course, start, end);
            if (!(cost < best))
                continue;
            best = cost;
            strip->closing = closing;
            strip->start = (start + 0.5) * texel;
        }
}

static otx_status
close_rings(otx_strips *s)
{
    const otx_arena_mark mark = otx_arena_here(s->m->job->run->scratch);
    columns c;

    OTX_TRY(read_columns(s->m, &c));
    for (int32_t i = 0; i < s->count; ++i)
        if (s->strips[i].length > 0.0)
            close_ring(s->m, &c, &s->strips[i]);
    otx_arena_release(s->m->job->run->scratch, mark);
    return OSDTEX_OK;
}

/* -- neighbours ---------------------------------------------------------- */

static void
choose_course(
    otx_strips *s, int32_t strip, int32_t from,
    const otx_strip_contact *contact)
{
    const int32_t count = s->m->courses.count;
    int up;

    if (from < 0)
        return;
    up = (contact->above >= 0.0) == (contact->b == strip) ? 1 : -1;
    s->strips[strip].course =
        otx_image_wrap(s->strips[from].course + up, count);
}

static void
choose_shift(
    otx_strips *s, int32_t strip, int32_t from,
    const otx_strip_contact *contact)
{
    const double period = s->m->courses.period;
    double lag;

    if (from < 0)
        return;
    lag = atan2(contact->lag.y, contact->lag.x) * period / (2.0 * OTX_PI);
    s->strips[strip].shift =
        s->strips[from].shift - (contact->b == strip ? lag : -lag);
}

/* -- out ----------------------------------------------------------------- */

/* Whole rounds of a ring that is closed by no whole number of pictures. */
static double
rounds_before(const otx_strips *s, int32_t face)
{
    const otx_level *leaf = s->leaf.level;
    const otx_course_strip *strip = &s->strips[s->of[face]];
    double sum = 0.0;

    if (!(strip->length > 0.0))
        return 0.0;
    for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
         ++i)
        sum += s->along[i];
    return floor(
        (sum / otx_level_face_size(leaf, face) + strip->shift - strip->start) /
        strip->closing);
}

static void
write_face(otx_material *m, const otx_strips *s, int32_t face)
{
    const otx_level *leaf = s->leaf.level;
    const otx_course_strip *strip = &s->strips[s->of[face]];
    const double shift = strip->shift - rounds_before(s, face) * strip->closing;

    for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
         ++i)
    {
        const double course = strip->course + otx_strips_across(s, face, i);
        const double along = s->along[i] + shift;

        m->laid.uvs[i] = otx_courses_texel(&m->courses, along, course);
        m->laid.cells[i] = (otx_vec2){along / m->courses.period, course};
    }
}

otx_status
otx_coursing_lay(otx_material *m)
{
    const otx_arena_mark mark = otx_arena_here(m->job->run->scratch);
    otx_strip_tears tears;
    otx_strips s;

    OTX_TRY(otx_strips_find(m, &s));
    OTX_TRY(otx_strips_visit(&s, choose_course));
    OTX_TRY(otx_unroll_measure(&s, &tears));
    OTX_TRY(close_rings(&s));
    OTX_TRY(otx_unroll_solve(&s, &tears));
    OTX_TRY(otx_strips_touch(&s));
    OTX_TRY(otx_strips_visit(&s, choose_shift));
    for (int32_t f = 0; f < s.leaf.level->face_count; ++f)
        if (s.of[f] >= 0)
            write_face(m, &s, f);
    otx_arena_release(m->job->run->scratch, mark);
    return OSDTEX_OK;
}

/* coursing.c -- whether an exemplar is laid course by course, and which way. */
#include "method/material/coursing.h"

#include "analysis/exemplar_analysis.h"

/* Lattices that hold together along their courses are laid as a whole. */
static const double LOOSE = 0.3;

/* Factor that makes it worth while to lay courses across the field. */
static const double CLEARLY = 1.1;

/* In lightness, or in what tells more in the space that is asked for. */
static otx_status
find_courses(otx_run *run, const otx_exemplar *e, otx_courses *out)
{
    otx_image channel;

    OTX_TRY(otx_courses_find(run, &e->lab, out));
    if (out->count > 0 || !otx_exemplar_analysis_channel(e, &channel))
        return OSDTEX_OK;
    return otx_courses_find(run, &channel, out);
}

/* Whether the exemplar is laid course by course; its cell then is a course of
 * the whole picture's length. */
otx_status
otx_coursing_choose(otx_material *m)
{
    const otx_exemplar *e = m->job->exemplars;
    const int32_t wish = m->settings->courses;
    otx_vec2 *g = m->analysis.generators;
    otx_courses found;
    double height;

    if (wish == OTX_COURSING_OFF)
        return OSDTEX_OK;
    if (e->wrap_x && e->wrap_y)
        OTX_TRY(find_courses(m->job->run, e, &found));
    else
        found.count = 0;
    if (wish == OTX_COURSING_ON && found.count == 0)
        return otx_fail(
            m->job->run, OSDTEX_ERROR_SUPPORT, "map",
            otx_where_file(e->source_path),
            "courses are asked for, and the exemplar has none that repeat "
            "across a picture that tiles; try {tileable} make, or leave out "
            "courses=on");
    if (wish == OTX_COURSING_AUTO &&
        !(otx_courses_are_plain(&found) && m->analysis.contrast < LOOSE))
        return OSDTEX_OK;
    m->courses = found;
    height = (found.joints[found.count] - found.joints[0]) / found.count;
    m->cell = height / m->texels;
    g[0] = found.upright ? (otx_vec2){0, m->courses.period}
                         : (otx_vec2){m->courses.period, 0};
    g[1] = found.upright ? (otx_vec2){-height, 0} : (otx_vec2){0, height};
    m->analysis.angle = found.upright ? 0.5 * OTX_PI : 0.0;
    otx_note(
        m->job->run, OSDTEX_SEVERITY_INFO, "map",
        otx_where_file(e->source_path),
        "%d courses of %.0f texels, laid one by one (courses=off: as one "
        "lattice)",
        (int)found.count, height);
    return OSDTEX_OK;
}

/* What the turn of the field costs along the directions of the courses and
 * across them. */
static void
split_turn(const otx_direction *field, double *along, double *across)
{
    const otx_connection *c = field->connection;

    *along = *across = 0.0;
    for (int32_t e = 0; e < c->level->edge_count; ++e)
    {
        const int32_t face = c->level->edge_faces[2 * (size_t)e];
        const double turn = c->inner[e] ? otx_direction_turn(field, e) : 0.0;
        otx_vec2 side, d;
        double cross;

        if (turn == 0.0)
            continue;
        side = c->sides[otx_connection_corner(c, e, face)];
        d = otx_vec2_polar(otx_direction_angle(field, face));
        /* The step to the other face is at right angles to the side. */
        cross = otx_vec2_cross(side, d) / fmax(otx_vec2_length(side), 1e-30);
        *along += c->weights[e] * turn * turn * cross * cross;
        *across += c->weights[e] * turn * turn * (1.0 - cross * cross);
    }
}

void
otx_coursing_turn(otx_material *m)
{
    const otx_vec2 quarter =
        m->solved.field.symmetry == 2 ? (otx_vec2){-1, 0} : (otx_vec2){0, 1};
    double along, across;

    split_turn(&m->solved.field, &along, &across);
    if (!(across > CLEARLY * along))
        return;
    for (int32_t f = 0; f < m->solved.connection.level->face_count; ++f)
        m->solved.field.powers[f] =
            otx_vec2_mul(m->solved.field.powers[f], quarter);
    otx_note(
        m->job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "courses lie at right angles to the smoothest field, where fewer of "
        "them end");
}

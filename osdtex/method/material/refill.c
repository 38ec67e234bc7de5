/* refill.c -- patches where periodic coordinates fail.
 *
 * Around a dislocation, and wherever the coordinates are squeezed, patches of
 * the exemplar that follow the same field continue what is around them. */
#include "method/material/material.h"

#include "method/material/solved_face.h"

#include "cluster/dual.h"
#include "flatten/stretch.h"

/* How far from a seam the periodic texture gives way to it, in cells. */
static const double REACH = 1.0;

/* Periodic texture narrower than two cells between patches is no use: half
 * that, and how far from what is wide enough it is kept. */
static const double CORE = 1.0;
static const double KEPT = 1.5;

/* -- which faces --------------------------------------------------------- */

/* Whether no corner of a leaf face is turned inside out. */
static bool
is_unfolded(const otx_material *m, const otx_vec2 *cells, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const double sense =
        otx_vec2_cross(m->analysis.generators[0], m->analysis.generators[1]);

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec2 at = cells[first + k];

        if (!(sense *
                  otx_vec2_cross(
                      otx_vec2_sub(cells[first + (k + 1) % size], at),
                      otx_vec2_sub(cells[first + (k + size - 1) % size], at)) >
              0.0))
            return false;
    }
    return true;
}

/* Whether every fan triangle of a leaf face keeps its sense and its size
 * within `limit`. */
static bool
is_sound(const otx_material *m, const otx_vec2 *cells, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    const otx_vec2 *g = m->analysis.generators;
    const double limit = m->settings->stretch;
    const int32_t first = leaf->face_first[face];

    for (int32_t k = 1; k + 1 < otx_level_face_size(leaf, face); ++k)
    {
        const int32_t at[3] = {first, first + k, first + k + 1};
        otx_vec3 p[3];
        otx_vec2 q[3];
        double s[2];

        for (int j = 0; j < 3; ++j)
        {
            p[j] = otx_vec3_scale(
                m->texels,
                otx_vec3_load(
                    m->job->surface->points, leaf->face_verts[at[j]]));
            q[j] = otx_vec2_add(
                otx_vec2_scale(cells[at[j]].x, g[0]),
                otx_vec2_scale(cells[at[j]].y, g[1]));
        }
        otx_stretch_singular(p, q, s);
        if (!(s[1] > 1.0 / limit) || !(s[0] < limit))
            return false;
    }
    return true;
}

static double
face_area(const otx_material *m, int32_t leaf_face)
{
    otx_vec3 unused;

    return 0.5 * otx_vec3_length(
                     otx_dual_leaf_area(m->job->surface, leaf_face, &unused));
}

/* Opens what is too narrow between open faces: limbs with a dislocation every
 * other cell, strips along them. */
static otx_status
open_narrow(otx_material *m)
{
    const otx_arena_mark mark = otx_arena_here(m->job->run->scratch);
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    const int32_t count = m->solved.connection.level->face_count;
    uint8_t *marked = OTX_ZNEW(m->job->run->scratch, uint8_t, count);
    double *distance;

    OTX_TRY(otx_run_ok(m->job->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (m->laid.open[f])
            marked[otx_material_solved_face(m, f)] = 1;
    OTX_TRY(otx_phase_distance(
        m->job->run, &m->solved.connection, marked, &distance));
    for (int32_t f = 0; f < count; ++f)
        marked[f] = distance[f] > CORE * m->cell;
    OTX_TRY(otx_phase_distance(
        m->job->run, &m->solved.connection, marked, &distance));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (distance[otx_material_solved_face(m, f)] > KEPT * m->cell)
            m->laid.open[f] = !leaf->face_hole[f];
    otx_arena_release(m->job->run->scratch, mark);
    return OSDTEX_OK;
}

static bool
in_singular_ring(const otx_material *m, int32_t leaf_face)
{
    const otx_level *level = m->solved.connection.level;
    const int32_t face = otx_material_solved_face(m, leaf_face);

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        if (m->solved.rings.singular[level->face_verts[i]])
            return true;
    return false;
}

void
otx_refill_clear(otx_material *m)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
        m->laid.open[f] = m->settings->fill == OTX_FILL_ON &&
                          !leaf->face_hole[f] &&
                          (in_singular_ring(m, f) ||
                           m->solved.distance[otx_material_solved_face(m, f)] <=
                               m->settings->clear * m->cell);
}

otx_status
otx_refill_choose(otx_material *m)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    double clean = 0.0, filled = 0.0, all = 0.0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        m->laid.open[f] |= m->settings->fill == OTX_FILL_ON &&
                           !leaf->face_hole[f] &&
                           (!is_unfolded(m, m->laid.cells, f) ||
                            !is_sound(m, m->laid.cells, f));
    if (m->settings->fill == OTX_FILL_ON)
        OTX_TRY(open_narrow(m));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const double distance =
            m->solved.distance[otx_material_solved_face(m, f)];
        const double area = leaf->face_hole[f] ? 0.0 : face_area(m, f);

        all += area;
        clean += distance > m->cell ? area : 0.0;
        filled += m->laid.open[f] ? area : 0.0;
    }
    m->tally.clean_share = clean / all;
    m->tally.filled_share = filled / all;
    otx_note(
        m->job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "%d of %d faces hold a dislocation, %d have been cancelled; %.1f %% of "
        "the area is farther than a cell from any, patches cover %.1f %%",
        (int)m->solved.phase.defect_count,
        (int)m->solved.connection.level->face_count,
        (int)m->solved.phase.cancelled, 100.0 * m->tally.clean_share,
        100.0 * m->tally.filled_share);
    return OSDTEX_OK;
}

/* -- patches ------------------------------------------------------------- */

otx_status
otx_refill_run(otx_material *m, otx_mapping *out)
{
    const otx_patch_given given = {
        .face_patch = m->laid.face_patch,
        .patch_count = m->laid.patch_count,
        .uvs = m->laid.uvs,
        .reach = REACH * m->cell * m->texels};
    otx_map_request request = *m->job->request;
    otx_job job = *m->job;
    otx_guide guide;

    OTX_TRY(otx_guide_from_field(
        job.run, &m->solved.field,
        m->analysis.angle - m->settings->turn * OTX_PI / 180.0, &guide));
    request.guide = &guide;
    request.first_face = -1;
    job.request = &request;
    return otx_method_fill(&job, &given, out);
}

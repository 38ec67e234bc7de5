/* material.c -- fields, periodic coordinates, UVs [Ray09, sec. 2].
 */
#include "method/material/coursing.h"

#include "analysis/exemplar_analysis.h"
#include "seam/unit.h"

#include <stdio.h>

/* What repeats in a picture that tiles is at least the picture. */
static otx_status
take_whole_picture(otx_material *m)
{
    const otx_exemplar *e = m->job->exemplars;
    const otx_vec2 sides[2] = {{e->lab.width, 0.0}, {0.0, e->lab.height}};

    otx_note(
        m->job->run, OSDTEX_SEVERITY_INFO, "map",
        otx_where_file(e->source_path),
        "the exemplar is %s and tiles: the whole picture is the cell of a "
        "lattice",
        otx_analysis_name(m->analysis.kind));
    return otx_analysis_force_lattice(
        m->job->run, &e->lab, sides, &m->analysis);
}

static otx_status
choose_lattice(otx_material *m)
{
    const otx_exemplar *e = m->job->exemplars;
    const otx_vec2 *g = m->analysis.generators;

    if (m->job->request->analysis)
        m->analysis = *m->job->request->analysis;
    else
        OTX_TRY(otx_exemplar_analysis(m->job->run, e, &m->analysis));
    if (m->analysis.kind != OTX_ANALYSIS_LATTICE && e->wrap_x && e->wrap_y &&
        !m->job->request->analysis && m->settings->courses != OTX_COURSING_ON)
        OTX_TRY(take_whole_picture(m));
    if (m->analysis.kind != OTX_ANALYSIS_LATTICE &&
        m->settings->courses != OTX_COURSING_ON)
        return otx_fail(
            m->job->run, OSDTEX_ERROR_SUPPORT, "map",
            otx_where_file(e->source_path),
            "the exemplar is %s: periodic coordinates need a lattice; give it "
            "with {generators}, make the picture tile with {tileable} make, "
            "say {set} courses=on for masonry, or take another method",
            otx_analysis_name(m->analysis.kind));
    m->cell = fmin(otx_vec2_length(g[0]), otx_vec2_length(g[1])) / m->texels;
    return OSDTEX_OK;
}

static otx_status
solve_field(otx_material *m)
{
    const int32_t asked = m->settings->symmetry;
    otx_direction_request request = {
        .symmetry = asked != 0                  ? asked
                    : m->analysis.symmetry >= 2 ? 2
                                                : 1,
    };

    m->solved.level = otx_phase_level(m->job->surface, m->cell);
    OTX_TRY(otx_connection_build(
        m->job->run, m->job->surface, m->solved.level, &m->solved.connection));
    OTX_TRY(otx_constraint_pins(
        m->job->run, m->job->request->constraints, &m->solved.connection,
        &request));
    if (request.symmetry == 4)
        request.symmetry = 2; /* coordinates do not change places */
    OTX_TRY(otx_nested_solve(
        m->job->run, &m->solved.connection, &request, &m->solved.field));
    if (m->courses.count > 0 && request.pin_count == 0 && !request.pull)
        otx_coursing_turn(m);
    OTX_TRY(otx_scale_solve(
        m->job->run, &m->solved.field,
        m->courses.count > 0 ? 0.0 : m->settings->octaves * log(2.0),
        &m->solved.log_scale));
    return otx_constraint_scale(
        m->job->run, m->job->request->constraints, &m->solved.connection,
        m->solved.log_scale);
}

/* Cells along and across the field: rows of the inverse of the generators,
 * turned so that the exemplar's direction lies along the field. */
static void
cell_gradients(const otx_material *m, otx_vec2 gradient[2])
{
    const otx_vec2 *g = m->analysis.generators;
    const double d = otx_vec2_cross(g[0], g[1]) / m->texels;
    const double turn = -m->analysis.angle + m->settings->turn * OTX_PI / 180.0;

    gradient[0] =
        otx_vec2_mul(otx_vec2_polar(turn), (otx_vec2){g[1].y / d, -g[1].x / d});
    gradient[1] =
        otx_vec2_mul(otx_vec2_polar(turn), (otx_vec2){-g[0].y / d, g[0].x / d});
}

static otx_status
solve_phases(otx_material *m)
{
    otx_phase_request request = {
        .field = &m->solved.field,
        .log_scale = m->solved.log_scale,
        .cancel = m->settings->cancel * m->cell};

    cell_gradients(m, request.gradient);
    if (m->courses.count > 0)
        request.gradient[0] = (otx_vec2){0, 0};
    OTX_TRY(otx_phase_solve(m->job->run, &request, &m->solved.phase));
    OTX_TRY(otx_rings_find(
        m->job->run, &m->solved.phase, &request, &m->solved.rings));
    OTX_TRY(otx_phase_distance(
        m->job->run, &m->solved.connection, m->solved.phase.defect,
        &m->solved.distance));
    return otx_phase_unwrap(m->job->run, &m->solved.phase, m->solved.distance);
}

static otx_status
lay_uvs(otx_material *m)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    const otx_vec2 *g = m->analysis.generators;

    m->laid.uvs = OTX_NEW(m->job->run->arena, otx_vec2, leaf->corner_count);
    m->laid.face_patch = OTX_NEW(m->job->run->arena, int32_t, leaf->face_count);
    m->laid.open = OTX_ZNEW(m->job->run->arena, uint8_t, leaf->face_count);
    OTX_TRY(otx_run_ok(m->job->run));
    OTX_TRY(otx_material_refine(
        m, m->job->run->arena, m->solved.phase.cells, &m->laid.cells));
    otx_refill_clear(m);
    if (m->courses.count > 0)
        OTX_TRY(otx_coursing_lay(m));
    OTX_TRY(otx_refill_choose(m));
    OTX_TRY(otx_label_windows(m, m->laid.open, m->laid.cells));
    OTX_TRY(otx_label_patches(
        m, m->laid.open, m->laid.cells, m->laid.face_patch,
        &m->laid.patch_count));
    for (int32_t i = 0; m->courses.count == 0 && i < leaf->corner_count; ++i)
        m->laid.uvs[i] = otx_vec2_add(
            m->analysis.centre, otx_vec2_add(
                                    otx_vec2_scale(m->laid.cells[i].x, g[0]),
                                    otx_vec2_scale(m->laid.cells[i].y, g[1])));
    return OSDTEX_OK;
}

/* What pictures of the cells need. */
static otx_status
show_lattice(otx_material *m, otx_mapping *out)
{
    otx_cell_map *map = OTX_NEW(m->job->run->arena, otx_cell_map, 1);
    otx_vec3 *defects =
        OTX_NEW(m->job->run->arena, otx_vec3, m->solved.phase.defect_count + 1);

    OTX_TRY(otx_run_ok(m->job->run));
    *map = (otx_cell_map){m->laid.cells, m->laid.open, defects, 0};
    for (int32_t f = 0; f < m->solved.connection.level->face_count; ++f)
        if (m->solved.phase.defect[f])
            defects[map->defect_count++] = m->solved.connection.centres[f];
    out->lattice = map;
    return OSDTEX_OK;
}

static void
report(const otx_material *m)
{
    otx_figures *f = m->job->figures;

    otx_figures_count(
        f, "lattice.faces", "faces", m->solved.connection.level->face_count);
    otx_figures_count(
        f, "lattice.singular_faces", "faces", m->solved.phase.defect_count);
    otx_figures_count(
        f, "lattice.singular_rings", "rings", m->solved.rings.count);
    otx_figures_count(
        f, "lattice.cancelled", "dislocations", m->solved.phase.cancelled);
    otx_figures_real(f, "lattice.clean_area_share", "", m->tally.clean_share);
    otx_figures_real(f, "lattice.filled_area_share", "", m->tally.filled_share);
    otx_figures_count(
        f, "lattice.blended_faces", "faces", m->tally.blended_faces);
    otx_figures_real(
        f, "lattice.blended_area_share", "", m->tally.blended_share);
    otx_figures_real(f, "lattice.gradient_error", "", m->solved.phase.error);
}

static otx_status
map(const otx_job *job, otx_mapping *out)
{
    otx_material m = {
        .job = job,
        .settings = job->settings,
        .texels = otx_unit_texels(job->exemplars, job->request->scale),
    };

    OTX_TRY(choose_lattice(&m));
    OTX_TRY(otx_coursing_choose(&m));
    if (m.settings->fill == OTX_FILL_BLEND)
        OTX_TRY(otx_blend_check(&m));
    otx_figures_stage(job->figures, "field");
    OTX_TRY(solve_field(&m));
    otx_figures_stage(job->figures, "phase");
    OTX_TRY(solve_phases(&m));
    OTX_TRY(lay_uvs(&m));
    OTX_TRY(otx_refill_run(&m, out));
    if (m.settings->fill == OTX_FILL_BLEND)
        OTX_TRY(otx_blend_run(&m, out));
    report(&m);
    return show_lattice(&m, out);
}

/* Fewest lattice cells that a surface shows when they are laid over it as a
 * whole: on fewer, defects are everywhere. */
static const double CELLS_MIN = 60.0;

static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    const otx_exemplar *e = job->exemplars;
    const double texels = otx_unit_texels(e, job->request->scale);
    otx_analysis a;
    double cells;

    if (job->request->analysis)
        a = *job->request->analysis;
    else
        OTX_TRY(otx_exemplar_analysis(job->run, e, &a));
    if (a.kind != OTX_ANALYSIS_LATTICE)
    {
        snprintf(
            out->why, sizeof out->why,
            "the exemplar is %s, and only a lattice can run through",
            otx_analysis_name(a.kind));
        return OSDTEX_OK;
    }
    cells = job->surface->area * texels * texels /
            otx_vec2_cross(a.generators[0], a.generators[1]);
    out->score = cells >= CELLS_MIN ? 0.8 : 0.0;
    snprintf(
        out->why, sizeof out->why,
        "the exemplar is a lattice, and the surface has room for %.0f of its "
        "cells, of %.0f that are needed at least%s",
        cells, CELLS_MIN,
        out->score > 0.0 ? "; limbs under two cells that it cannot follow get "
                           "guided patches"
                         : "");
    return OSDTEX_OK;
}

const otx_method otx_method_material = {
    .name = "material",
    .summary = "Lays a lattice over the whole surface along a direction field, "
               "so that rows and strands run through.",
    .source = "Ray, Levy, Wang, Turk, Vallet: Material Space Texturing, 2009",
    .options = otx_material_options,
    .option_count = OTX_MATERIAL_OPTION_COUNT,
    .settings_bytes = sizeof(otx_material_settings),
    .applicable = applicable,
    .map = map,
};

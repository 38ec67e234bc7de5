/* material.c -- fields, periodic coordinates, UVs [Ray09, sec. 2].
 */
#include "method/material/coursing.h"

#include "seam/unit.h"

#include <string.h>

static otx_status
choose_lattice(otx_material *m)
{
    const otx_vec2 *g = m->analysis.generators;

    if (m->request->analysis)
        m->analysis = *m->request->analysis;
    else
        OTX_TRY(otx_analysis_run(
            m->run, &m->exemplar->lab, m->exemplar->wrap_x, m->exemplar->wrap_y,
            &m->analysis));
    if (m->analysis.kind != OTX_ANALYSIS_LATTICE &&
        m->settings->courses != OTX_COURSING_ON)
        return otx_fail(
            m->run, OSDTEX_ERROR_SUPPORT, "map",
            otx_where_file(m->exemplar->source_path),
            "the exemplar is %s: periodic coordinates need a lattice; give it "
            "with {generators}, say {set} courses=on for masonry, or take "
            "another method",
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

    m->level = otx_phase_level(m->surface, m->cell);
    OTX_TRY(otx_connection_build(m->run, m->surface, m->level, &m->connection));
    OTX_TRY(otx_constraint_pins(
        m->run, m->request->constraints, &m->connection, &request));
    if (request.symmetry == 4)
        request.symmetry = 2; /* coordinates do not change places */
    OTX_TRY(otx_nested_solve(m->run, &m->connection, &request, &m->field));
    if (m->courses.count > 0 && request.pin_count == 0 && !request.pull)
        otx_coursing_turn(m);
    OTX_TRY(otx_scale_solve(
        m->run, &m->field,
        m->courses.count > 0 ? 0.0 : m->settings->octaves * log(2.0),
        &m->log_scale));
    return otx_constraint_scale(
        m->run, m->request->constraints, &m->connection, m->log_scale);
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
        .field = &m->field,
        .log_scale = m->log_scale,
        .cancel = m->settings->cancel * m->cell};

    cell_gradients(m, request.gradient);
    if (m->courses.count > 0)
        request.gradient[0] = (otx_vec2){0, 0};
    OTX_TRY(otx_phase_solve(m->run, &request, &m->phase));
    OTX_TRY(otx_rings_find(m->run, &m->phase, &request, &m->rings));
    OTX_TRY(otx_phase_distance(
        m->run, &m->connection, m->phase.defect, &m->distance));
    return otx_phase_unwrap(m->run, &m->phase, m->distance);
}

double
otx_material_density(const otx_material *m, int32_t leaf_face)
{
    const otx_level *level = m->connection.level;
    const int32_t face = otx_material_solved_face(m, leaf_face);
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += m->log_scale[level->face_verts[i]];
    return m->texels * exp(sum / otx_level_face_size(level, face));
}

/* Cell coordinates of the corners of one face's children. */
static void
share_out(
    const otx_level *level, const otx_level *finer, int32_t face,
    const otx_vec2 *from, otx_vec2 *to)
{
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const int32_t end = finer->face_first[level->face_child_first[face + 1]];
    otx_vec2 middle = {0, 0};

    for (int32_t k = 0; k < size; ++k)
        middle =
            otx_vec2_add(middle, otx_vec2_scale(1.0 / size, from[first + k]));
    for (int32_t i = finer->face_first[level->face_child_first[face]]; i < end;
         ++i)
    {
        const int32_t vertex = finer->face_verts[i];

        to[i] = middle;
        for (int32_t k = 0; k < size; ++k)
            if (vertex == level->face_verts[first + k])
                to[i] = from[first + k];
            else if (
                vertex == level->edge_child_vert[level->face_edges[first + k]])
                to[i] = otx_vec2_lerp(
                    from[first + k], from[first + (k + 1) % size], 0.5);
    }
}

otx_status
otx_material_refine(
    const otx_material *m, otx_arena *arena, otx_vec2 *from, otx_vec2 **out)
{
    *out = from;
    for (int32_t l = m->level; l + 1 < m->surface->level_count; ++l)
    {
        const otx_level *level = &m->surface->levels[l];
        const otx_level *finer = level + 1;
        otx_vec2 *cells = OTX_NEW(arena, otx_vec2, finer->corner_count);

        if (!cells)
            return otx_fail_memory(m->run, "map");
        for (int32_t f = 0; f < level->face_count; ++f)
            share_out(level, finer, f, *out, cells);
        *out = cells;
    }
    return OSDTEX_OK;
}

static otx_status
lay_uvs(otx_material *m)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    const otx_vec2 *g = m->analysis.generators;

    m->uvs = OTX_NEW(m->run->arena, otx_vec2, leaf->corner_count);
    m->face_patch = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    m->open = OTX_ZNEW(m->run->arena, uint8_t, leaf->face_count);
    if (!m->uvs || !m->face_patch || !m->open)
        return otx_fail_memory(m->run, "map");
    OTX_TRY(otx_material_refine(m, m->run->arena, m->phase.cells, &m->cells));
    otx_refill_clear(m);
    if (m->courses.count > 0)
        OTX_TRY(otx_coursing_lay(m));
    OTX_TRY(otx_refill_choose(m));
    OTX_TRY(otx_label_windows(m, m->open, m->cells));
    OTX_TRY(otx_label_patches(
        m, m->open, m->cells, m->face_patch, &m->patch_count));
    for (int32_t i = 0; m->courses.count == 0 && i < leaf->corner_count; ++i)
        m->uvs[i] = otx_vec2_add(
            m->analysis.centre, otx_vec2_add(
                                    otx_vec2_scale(m->cells[i].x, g[0]),
                                    otx_vec2_scale(m->cells[i].y, g[1])));
    return OSDTEX_OK;
}

/* What pictures of the cells need. */
static otx_status
show_lattice(otx_material *m, otx_mapping *out)
{
    otx_cell_map *map = OTX_NEW(m->run->arena, otx_cell_map, 1);
    otx_vec3 *defects =
        OTX_NEW(m->run->arena, otx_vec3, m->phase.defect_count + 1);

    if (!map || !defects)
        return otx_fail_memory(m->run, "map");
    *map = (otx_cell_map){m->cells, m->open, defects, 0};
    for (int32_t f = 0; f < m->connection.level->face_count; ++f)
        if (m->phase.defect[f])
            defects[map->defect_count++] = m->connection.centres[f];
    out->lattice = map;
    return OSDTEX_OK;
}

static otx_status
map(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    otx_material m = {
        .run = run,
        .surface = surface,
        .exemplar = exemplar,
        .request = request,
        .settings = settings,
        .stats = stats,
        .texels = otx_unit_texels(exemplar, request->scale),
    };

    OTX_TRY(choose_lattice(&m));
    OTX_TRY(otx_coursing_choose(&m));
    if (m.settings->fill == OTX_FILL_BLEND)
        OTX_TRY(otx_blend_check(&m));
    otx_map_stats_stage(stats, "field");
    OTX_TRY(solve_field(&m));
    otx_map_stats_stage(stats, "phase");
    OTX_TRY(solve_phases(&m));
    OTX_TRY(lay_uvs(&m));
    OTX_TRY(otx_refill_run(&m, out));
    if (m.settings->fill == OTX_FILL_BLEND)
        OTX_TRY(otx_blend_run(&m, out));
    return show_lattice(&m, out);
}

const otx_method otx_method_material = {
    .name = "material",
    .summary = "Lays a lattice over the whole surface along a direction field, "
               "so that rows and strands run through.",
    .source = "Ray, Levy, Wang, Turk, Vallet: Material Space Texturing, 2009",
    .options = otx_material_options,
    .option_count = OTX_MATERIAL_OPTION_COUNT,
    .settings_bytes = sizeof(otx_material_settings),
    .map = map,
};

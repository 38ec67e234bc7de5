/* field_view.c -- a field as lines and dots to be drawn. */
#include "api/field_view.h"

#include "field/singularity.h"
#include "field/streamline.h"

/* Of the cage's diagonal: how far lines are apart, how large dots are. */
static const double SPACING = 1.0 / 100.0;
static const double RADIUS = 1.0 / 70.0;

/* Of the spacing. */
static const double WIDTH = 0.28;
static const double PERIOD = 5.0;

static otx_status
take_lines(otx_run *run, const otx_direction *field, otx_overlay *out)
{
    otx_overlay_line *lines;
    otx_streamline_set set;

    OTX_TRY(otx_streamline_trace(
        run, field, out->line_width / WIDTH, out->line_width, &set));
    lines = OTX_NEW(run->arena, otx_overlay_line, set.count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < set.count; ++i)
        lines[i] = (otx_overlay_line){
            set.pieces[i].face,
            {set.pieces[i].ends[0], set.pieces[i].ends[1]},
            {set.pieces[i].along[0], set.pieces[i].along[1]}};
    out->lines = lines;
    out->line_count = set.count;
    return OSDTEX_OK;
}

static otx_status
take_dots(otx_run *run, const otx_direction *field, otx_overlay *out)
{
    const float *points = field->connection->surface->points;
    otx_singularity_list list;
    otx_overlay_dot *dots;

    OTX_TRY(otx_singularity_find(run, field, &list));
    dots = OTX_NEW(run->arena, otx_overlay_dot, list.count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < list.count; ++i)
        dots[i] = (otx_overlay_dot){
            otx_vec3_load(points, list.items[i].vertex), list.items[i].turns};
    out->dots = dots;
    out->dot_count = list.count;
    return OSDTEX_OK;
}

otx_status
otx_field_view(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    bool has_lines, otx_overlay *out)
{
    const double diagonal = surface->cage->diagonal;
    otx_connection connection;
    otx_direction field;

    *out = (otx_overlay){
        .line_width = WIDTH * SPACING * diagonal,
        .dot_radius = RADIUS * diagonal,
        .period = guide->symmetry == 1 ? PERIOD * SPACING * diagonal : 0.0,
    };
    OTX_TRY(otx_connection_build(
        run, surface, surface->level_count - 1, &connection));
    OTX_TRY(otx_direction_from_vectors(
        run, &connection, guide->symmetry, guide->directions, &field));
    if (has_lines)
        OTX_TRY(take_lines(run, &field, out));
    return take_dots(run, &field, out);
}

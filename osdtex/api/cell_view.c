/* cell_view.c -- the lattice on a surface as lines and dots to be drawn. */
#include "api/cell_view.h"

/* Of the cage's diagonal. */
static const double WIDTH = 1.0 / 500.0;
static const double RADIUS = 1.0 / 120.0;

typedef struct tracer
{
    const otx_surface *surface;
    const otx_cell_map *lattice;
    otx_overlay_line *lines; /* NULL: they are only counted */
    int32_t count;
} tracer;

static double
along(otx_vec2 cell, int axis)
{
    return axis == 0 ? cell.x : cell.y;
}

/* The piece of the line `value` of one coordinate in a triangle of a face. */
static void
cut_triangle(
    tracer *t, int32_t face, const int32_t corners[3], int axis, double value)
{
    const int32_t *verts = otx_surface_leaf(t->surface)->face_verts;
    otx_overlay_line line = {.face = face};
    int ends = 0;

    for (int k = 0; k < 3 && ends < 2; ++k)
    {
        const int32_t i = corners[k], j = corners[(k + 1) % 3];
        const double a = along(t->lattice->cells[i], axis) - value;
        const double b = along(t->lattice->cells[j], axis) - value;

        if ((a < 0.0) == (b < 0.0))
            continue;
        line.ends[ends++] = otx_vec3_mix(
            b / (b - a), otx_vec3_load(t->surface->points, verts[i]),
            -a / (b - a), otx_vec3_load(t->surface->points, verts[j]));
    }
    if (ends < 2)
        return;
    if (t->lines)
        t->lines[t->count] = line;
    ++t->count;
}

static void
cut_face(tracer *t, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(t->surface);
    const int32_t first = leaf->face_first[face];

    for (int axis = 0; axis < 2; ++axis)
        for (int32_t k = 1; k + 1 < otx_level_face_size(leaf, face); ++k)
        {
            const int32_t at[3] = {first, first + k, first + k + 1};
            double low = INFINITY, high = -INFINITY;

            for (int i = 0; i < 3; ++i)
            {
                low = fmin(low, along(t->lattice->cells[at[i]], axis));
                high = fmax(high, along(t->lattice->cells[at[i]], axis));
            }
            for (double v = ceil(low); v <= high; v += 1.0)
                cut_triangle(t, face, at, axis, v);
        }
}

static void
cut_all(tracer *t)
{
    const otx_level *leaf = otx_surface_leaf(t->surface);

    t->count = 0;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f] && !t->lattice->open[f])
            cut_face(t, f);
}

otx_status
otx_cell_view(
    otx_run *run, const otx_surface *surface, const otx_cell_map *lattice,
    otx_overlay *out)
{
    otx_overlay_dot *dots =
        OTX_NEW(run->arena, otx_overlay_dot, lattice->defect_count + 1);
    tracer t = {surface, lattice, NULL, 0};

    cut_all(&t);
    t.lines = OTX_NEW(run->arena, otx_overlay_line, t.count + 1);
    OTX_TRY(otx_run_ok(run));
    cut_all(&t);
    for (int32_t i = 0; i < lattice->defect_count; ++i)
        dots[i] = (otx_overlay_dot){lattice->defects[i], 1};
    *out = (otx_overlay){
        .line_count = t.count,
        .dot_count = lattice->defect_count,
        .lines = t.lines,
        .dots = dots,
        .line_width = WIDTH * surface->cage->diagonal,
        .dot_radius = RADIUS * surface->cage->diagonal};
    return OSDTEX_OK;
}

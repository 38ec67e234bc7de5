/* coverage.c -- how evenly a surface uses an exemplar. */
#include "mapping/coverage.h"

#include "image/view.h"

enum
{
    CELLS = 32,     /* of the exemplar's longer side */
    PIECES_MAX = 64 /* of a triangle's side */
};

bool
otx_coverage_begin(
    otx_arena *arena, const otx_exemplar *exemplar, otx_coverage *out)
{
    const double width = exemplar->match.width;
    const double height = exemplar->match.height;

    out->exemplar = exemplar;
    out->cell = fmax(width, height) / CELLS;
    out->cells_x = (int32_t)ceil(width / out->cell);
    out->cells_y = (int32_t)ceil(height / out->cell);
    out->cells = OTX_ZNEW(arena, double, out->cells_x *(int64_t)out->cells_y);
    return out->cells != NULL;
}

/* Cell of a coordinate along one axis. */
static int32_t
cell_at(double texel, int32_t size, bool wrap, double cell, int32_t count)
{
    const double inside = wrap ? otx_view_wrap(texel, size) : texel;
    const double index = floor(inside / cell);

    if (!(index > 0.0))
        return 0;
    return index < count - 1 ? (int32_t)index : count - 1;
}

static void
add_point(otx_coverage *c, otx_vec2 texel, double area)
{
    const int32_t x = cell_at(
        texel.x, c->exemplar->match.width, c->exemplar->wrap_x, c->cell,
        c->cells_x);
    const int32_t y = cell_at(
        texel.y, c->exemplar->match.height, c->exemplar->wrap_y, c->cell,
        c->cells_y);

    c->cells[(size_t)y * (size_t)c->cells_x + (size_t)x] += area;
}

/* As points at the centroids of n * n equal pieces about half a cell wide. */
void
otx_coverage_add(otx_coverage *coverage, const otx_vec2 q[3], double area)
{
    const otx_vec2 u = otx_vec2_sub(q[1], q[0]), v = otx_vec2_sub(q[2], q[0]);
    const double side = fmax(otx_vec2_length(u), otx_vec2_length(v));
    const double wanted = ceil(2.0 * side / coverage->cell);
    const int32_t n =
        wanted < PIECES_MAX ? (wanted > 1.0 ? (int32_t)wanted : 1) : PIECES_MAX;
    const double piece = area / ((double)n * n);

    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = 0; i + j < n; ++j)
            for (int32_t half = 1; half <= (i + j + 1 < n ? 2 : 1); ++half)
                add_point(
                    coverage,
                    otx_vec2_add(
                        q[0], otx_vec2_add(
                                  otx_vec2_scale((i + half / 3.0) / n, u),
                                  otx_vec2_scale((j + half / 3.0) / n, v))),
                    piece);
}

double
otx_coverage_evenness(const otx_coverage *c)
{
    const size_t count = (size_t)c->cells_x * (size_t)c->cells_y;
    double total = 0.0, entropy = 0.0;

    for (size_t i = 0; i < count; ++i)
        total += c->cells[i];
    for (size_t i = 0; i < count; ++i)
        if (c->cells[i] > 0.0)
            entropy -= c->cells[i] / total * log(c->cells[i] / total);
    return total > 0.0 ? exp(entropy) / (double)count : 0.0;
}

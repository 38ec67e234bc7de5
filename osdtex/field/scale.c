/* scale.c -- how large the texture is to be.
 *
 * The Laplacian on vertices has the weight distance across / length along each
 * edge: the inverse of that on faces. */
#include "field/scale.h"

#include "math/sparse.h"

/* Keeps the Laplacian of a closed surface definite; relative to its weights. */
static const double GROUND = 1e-8;

/* Of a boundary edge: its inner side where values are interpolated; next to
 * nothing for the correction, since no turn is known there, but enough to
 * hold on to a corner that has no other edges. */
static const double BORDER_INTERPOLATED = 0.5;
static const double BORDER_CORRECTED = 1e-3;

static double
vertex_weight(const otx_connection *c, int32_t edge, double border)
{
    return c->inner[edge] ? 1.0 / c->weights[edge] : border;
}

static bool
is_used(const otx_connection *c, int32_t edge)
{
    const int32_t *faces = c->level->edge_faces + 2 * (size_t)edge;

    return !c->level->face_hole[faces[0]] ||
           (faces[1] >= 0 && !c->level->face_hole[faces[1]]);
}

/* Adds the Laplacian to `entries`; rows of -1 are left out. */
static int64_t
add_laplacian(
    const otx_connection *c, const int32_t *row, double border,
    otx_sparse_entry *entries)
{
    int64_t count = 0;

    for (int32_t e = 0; e < c->level->edge_count; ++e)
    {
        const int32_t *v = c->level->edge_verts + 2 * (size_t)e;
        const int32_t a = row[v[0]], b = row[v[1]];
        const double w = vertex_weight(c, e, border);

        if (!is_used(c, e))
            continue;
        if (a >= 0)
            entries[count++] = (otx_sparse_entry){a, a, w, 0.0};
        if (b >= 0)
            entries[count++] = (otx_sparse_entry){b, b, w, 0.0};
        if (a >= 0 && b >= 0)
            entries[count++] =
                (otx_sparse_entry){a > b ? a : b, a > b ? b : a, -w, 0.0};
    }
    return count;
}

static otx_status
factor_laplacian(
    otx_run *run, const otx_connection *c, const int32_t *row, int32_t size,
    double border, otx_sparse **out)
{
    otx_sparse_entry *entries = OTX_NEW(
        run->scratch, otx_sparse_entry,
        3 * (int64_t)c->level->edge_count + size);
    otx_vec3 *places = OTX_NEW(run->scratch, otx_vec3, size);
    int64_t count;
    otx_status status;

    OTX_TRY(otx_run_ok(run));
    count = add_laplacian(c, row, border, entries);
    for (int32_t i = 0; i < size; ++i)
        entries[count++] = (otx_sparse_entry){i, i, GROUND, 0.0};
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        if (row[v] >= 0)
            places[row[v]] = otx_vec3_load(c->surface->points, v);
    status = otx_sparse_factor(
        run->scratch, OTX_SPARSE_REAL, size, places, entries, count, out);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(run, "field");
    if (status != OSDTEX_OK)
        return otx_fail(
            run, status, "field", OTX_NOWHERE,
            "the scale field has no solution: the surface has positions that "
            "are not finite");
    return OSDTEX_OK;
}

/* What locked neighbours say to the free vertices, beside GROUND's pull. */
static void
add_locked(
    const otx_connection *c, const int32_t *row, const double *values,
    double border, double *out)
{
    for (int32_t e = 0; e < c->level->edge_count; ++e)
    {
        const int32_t *v = c->level->edge_verts + 2 * (size_t)e;

        if (!is_used(c, e))
            continue;
        for (int k = 0; k < 2; ++k)
            if (row[v[k]] >= 0 && row[v[1 - k]] < 0)
                out[row[v[k]]] +=
                    vertex_weight(c, e, border) * values[v[1 - k]];
    }
}

/* -- correction for curvature -------------------------------------------- */

/* Divergence of J w: along the half-edge a -> b of the face on its left,
 * f_b - f_a = (|e| / |e*|) * (turn from the left face to the right one). */
static void
add_divergence(const otx_direction *field, double *out)
{
    const otx_connection *c = field->connection;

    /* The edge's weight, |e*| / |e|, cancels. */
    for (int32_t e = 0; e < c->level->edge_count; ++e)
    {
        const int32_t face = c->level->edge_faces[2 * (size_t)e];
        int32_t corner, a, b;
        double flow;

        if (!c->inner[e])
            continue;
        corner = otx_connection_corner(c, e, face);
        a = c->level->face_verts[corner];
        b = c->level->edge_verts[2 * (size_t)e] == a
                ? c->level->edge_verts[2 * (size_t)e + 1]
                : c->level->edge_verts[2 * (size_t)e];
        flow = otx_direction_turn(field, e);
        out[b] += flow;
        out[a] -= flow;
    }
}

/* Mean of f at the corners of a face. */
static double
face_mean(const otx_level *level, const double *f, int32_t face)
{
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += f[level->face_verts[i]];
    return sum / otx_level_face_size(level, face);
}

/* The shift that makes the mean of e^2(f + shift) one. */
static double
density_shift(const otx_connection *c, const double *f)
{
    double sum = 0.0;

    for (int32_t i = 0; i < c->level->face_count; ++i)
        if (c->areas[i] > 0.0)
            sum += c->areas[i] * exp(2.0 * face_mean(c->level, f, i));
    return sum > 0.0 ? -0.5 * log(sum / c->area) : 0.0;
}

/* Solves for f at the vertices whose row is not -1. */
static otx_status
solve_correction(
    otx_run *run, const otx_direction *field, const int32_t *row, int32_t size,
    double *f)
{
    const otx_connection *c = field->connection;
    double *divergence = OTX_ZNEW(run->scratch, double, c->level->vert_count);
    double *x = OTX_NEW(run->scratch, double, size);
    otx_sparse *lhs;

    OTX_TRY(otx_run_ok(run));
    if (size == 0)
        return OSDTEX_OK;
    add_divergence(field, divergence);
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        if (row[v] >= 0)
            x[row[v]] = divergence[v];
    OTX_TRY(factor_laplacian(run, c, row, size, BORDER_CORRECTED, &lhs));
    add_locked(c, row, f, BORDER_CORRECTED, x);
    OTX_TRY(otx_sparse_solve(lhs, x, x));
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        if (row[v] >= 0)
            f[v] = x[row[v]];
    return OSDTEX_OK;
}

/* Numbers the free vertices; how many there are. */
static int32_t
number_rows(int32_t *row, const uint8_t *effect, int32_t count)
{
    int32_t size = 0;

    for (int32_t v = 0; v < count; ++v)
        row[v] = !effect || effect[v] ? size++ : -1;
    return size;
}

static double
limited(double f, double limit)
{
    return limit > 0.0 ? limit * tanh(f / limit) : 0.0;
}

double
otx_scale_value(const otx_scale_correction *c, int32_t vertex)
{
    return limited(c->raw[vertex] + c->shift_before, c->limit) + c->shift_after;
}

otx_status
otx_scale_edit(
    otx_run *run, const otx_direction *field, const uint8_t *effect,
    otx_scale_correction *correction)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = field->connection->level->vert_count;
    int32_t *row = OTX_NEW(run->scratch, int32_t, count);

    OTX_TRY(otx_run_ok(run));
    if (!(correction->limit > 0.0))
        return OSDTEX_OK;
    OTX_TRY(solve_correction(
        run, field, row, number_rows(row, effect, count), correction->raw));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_scale_correct(
    otx_run *run, const otx_direction *field, double limit,
    otx_scale_correction *out)
{
    const otx_connection *c = field->connection;
    const int32_t count = c->level->vert_count;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double *f = OTX_NEW(run->scratch, double, count);

    *out = (otx_scale_correction){
        .raw = OTX_ZNEW(run->arena, double, count), .limit = limit};
    OTX_TRY(otx_run_ok(run));
    if (!(limit > 0.0))
        return OSDTEX_OK;
    OTX_TRY(otx_scale_edit(run, field, NULL, out));
    out->shift_before = density_shift(c, out->raw);
    for (int32_t v = 0; v < count; ++v)
        f[v] = otx_scale_value(out, v);
    out->shift_after = density_shift(c, f);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_scale_solve(
    otx_run *run, const otx_direction *field, double limit, double **out)
{
    otx_scale_correction correction;

    OTX_TRY(otx_scale_correct(run, field, limit, &correction));
    for (int32_t v = 0; v < field->connection->level->vert_count; ++v)
        correction.raw[v] = otx_scale_value(&correction, v);
    *out = correction.raw;
    return OSDTEX_OK;
}

/* -- locked values ------------------------------------------------------- */

static otx_status
apply_locks(
    otx_run *run, const otx_connection *c, const otx_scale_lock *locks,
    int32_t lock_count, double *values, int32_t *row)
{
    for (int32_t i = 0; i < lock_count; ++i)
    {
        const int32_t v = locks[i].vertex;

        if (v < 0 || v >= c->level->vert_count || !isfinite(locks[i].value))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
                "constraint %d is not finite or names a vertex that is not "
                "there",
                (int)i + 1);
        values[v] = locks[i].value;
        row[v] = -1;
    }
    return OSDTEX_OK;
}

otx_status
otx_scale_smooth(
    otx_run *run, const otx_connection *c, const otx_scale_lock *locks,
    int32_t lock_count, double low, double high, double otherwise,
    const uint8_t *effect, double *values)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = c->level->vert_count;
    int32_t *row = OTX_NEW(run->scratch, int32_t, count);
    double *x = OTX_NEW(run->scratch, double, count);
    int32_t size = 0;
    otx_sparse *lhs;

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < count; ++v)
        row[v] = effect && !effect[v] ? -1 : 0;
    OTX_TRY(apply_locks(run, c, locks, lock_count, values, row));
    for (int32_t v = 0; v < count; ++v)
        if (row[v] >= 0)
        {
            row[v] = size;
            x[size++] = GROUND * otherwise;
        }
    if (size > 0)
    {
        OTX_TRY(factor_laplacian(run, c, row, size, BORDER_INTERPOLATED, &lhs));
        add_locked(c, row, values, BORDER_INTERPOLATED, x);
        OTX_TRY(otx_sparse_solve(lhs, x, x));
    }
    for (int32_t v = 0; v < count; ++v)
        values[v] = fmin(fmax(row[v] >= 0 ? x[row[v]] : values[v], low), high);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* phase_fit.c -- periodic coordinates once their whole cells are known.
 *
 * The matrix is the same for both coordinates and is factored once. */
#include "periodic/phase_fit.h"

#include "math/sparse.h"

/* Weight of the edges of a face that is a defect: its strain is not to be
 * spread. */
static const double SOFT = 0.1;

/* Holds the free constant of a component; relative to the weights. */
static const double GROUND = 1e-7;

/* An edge between two vertices, whose turns count by `sense`. */
typedef struct spring
{
    int32_t v[2];
    int sense[2];
    double weight;
} spring;

static bool
is_defect(const otx_phase_solver *s, int32_t face)
{
    return otx_phase_touches_singular(s, face) ||
           otx_phase_charge(s, face, 0) != 0 ||
           otx_phase_charge(s, face, 1) != 0;
}

static spring
spring_of(const otx_phase_solver *s, const uint8_t *soft, int32_t edge)
{
    const int32_t *faces = s->c->level->edge_faces + 2 * (size_t)edge;
    spring out;
    int32_t at[2];

    otx_phase_edge_corners(s->c, edge, at);
    for (int k = 0; k < 2; ++k)
    {
        out.v[k] = s->c->level->face_verts[at[k]];
        out.sense[k] = s->sense[at[k]];
    }
    out.weight = otx_phase_edge_weight(s->c, edge);
    if (soft[faces[0]] || (faces[1] >= 0 && soft[faces[1]]))
        out.weight *= SOFT;
    return out;
}

/* Both coordinates have the same matrix. */
static otx_status
factor(const otx_phase_solver *s, const uint8_t *soft, otx_sparse **out)
{
    const otx_level *level = s->c->level;
    const int64_t edges = level->edge_count;
    otx_arena *scratch = s->run->scratch;
    otx_sparse_entry *entries =
        OTX_NEW(scratch, otx_sparse_entry, 3 * edges + level->vert_count);
    otx_vec3 *places = OTX_NEW(scratch, otx_vec3, level->vert_count);
    int64_t count = 0;

    if (!entries || !places)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t e = 0; e < edges; ++e)
    {
        const spring p = spring_of(s, soft, e);
        const bool down = p.v[1] > p.v[0];

        for (int k = 0; k < 2; ++k)
            entries[count++] =
                (otx_sparse_entry){p.v[k], p.v[k], p.weight, 0.0};
        entries[count++] = (otx_sparse_entry){
            p.v[down], p.v[!down], -p.weight * p.sense[0] * p.sense[1], 0.0};
    }
    for (int32_t v = 0; v < level->vert_count; ++v)
    {
        entries[count++] = (otx_sparse_entry){v, v, GROUND, 0.0};
        places[v] = otx_vec3_load(s->c->surface->points, v);
    }
    return otx_sparse_factor(
        scratch, OTX_SPARSE_REAL, level->vert_count, places, entries, count,
        out);
}

static otx_status
solve_turns(
    otx_phase_solver *s, const uint8_t *soft, otx_sparse *lhs, double *x,
    int axis)
{
    const otx_level *level = s->c->level;
    double *turn = s->turn[axis], *step = s->step[axis];

    for (int32_t v = 0; v < level->vert_count; ++v)
        x[v] = GROUND * turn[v];
    /* Steps become whole cells while the turns change. */
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const spring p = spring_of(s, soft, e);

        step[e] = round(
            step[e] - (p.sense[1] * turn[p.v[1]] - p.sense[0] * turn[p.v[0]]));
        for (int k = 0; k < 2; ++k)
            x[p.v[k]] += (k == 0 ? -1.0 : 1.0) * p.sense[k] * p.weight *
                         (s->wish[axis][e] - step[e]);
    }
    OTX_TRY(otx_sparse_solve(lhs, x, turn));
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const spring p = spring_of(s, soft, e);

        step[e] += p.sense[1] * turn[p.v[1]] - p.sense[0] * turn[p.v[0]];
    }
    return OSDTEX_OK;
}

static otx_status
fit(otx_phase_solver *s)
{
    const otx_level *level = s->c->level;
    uint8_t *soft = OTX_ZNEW(s->run->scratch, uint8_t, level->face_count);
    double *x = OTX_NEW(s->run->scratch, double, level->vert_count);
    otx_sparse *lhs;

    if (!soft || !x)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t f = 0; f < level->face_count; ++f)
        soft[f] = !level->face_hole[f] && is_defect(s, f);
    OTX_TRY(factor(s, soft, &lhs));
    for (int axis = 0; axis < 2; ++axis)
        OTX_TRY(solve_turns(s, soft, lhs, x, axis));
    return OSDTEX_OK;
}

otx_status
otx_phase_fit(otx_phase_solver *s)
{
    const otx_arena_mark mark = otx_arena_here(s->run->scratch);
    const otx_status status = fit(s);

    otx_arena_release(s->run->scratch, mark);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(s->run, "field");
    if (status != OSDTEX_OK)
        return otx_fail(
            s->run, status, "field", OTX_NOWHERE,
            "the periodic coordinates cannot be solved for: the surface has "
            "positions that are not finite");
    return OSDTEX_OK;
}

/* phase.c -- periodic coordinates that follow a direction field.
 *
 * Senses are first made equal wherever they can be. Where all are, the systems
 * are complex; else they are real, of two unknowns to a vertex, at three times
 * the cost, since conjugation is not linear over the complex numbers. */
#include "periodic/phase.h"

#include "math/sparse.h"
#include "periodic/dislocation.h"
#include "periodic/phase_check.h"
#include "periodic/phase_fit.h"

#include <assert.h>

enum
{
    EIGEN_ROUNDS = 14,
    UNIT_ROUNDS = 4
};

/* Length over which one round smooths, in cells. */
static const double SMOOTHING = 40.0;

/* A sum of steps that is this far from a whole number is not one. */
static const double WHOLE = 1e-3;

/* Edges along a cell, and those on a level of more faces than LARGE. */
static const double EDGES = 4.0, EDGES_OF_LARGE = 2.5;
static const int32_t LARGE = 40000;

typedef otx_phase_solver solver;

/* -- senses -------------------------------------------------------------- */

/* 1 when two faces show the same sense across an inner edge, else -1. */
static int
match_of(const solver *s, int32_t edge)
{
    const int32_t *faces = s->c->level->edge_faces + 2 * (size_t)edge;

    return cos(s->angles[faces[1]] - s->angles[faces[0]] - s->c->turns[edge]) <
                   0.0
               ? -1
               : 1;
}

/* Turns faces around, outwards from one of each component, until neighbours
 * agree but across cuts between singularities or round handles. */
static otx_status
comb(solver *s)
{
    const otx_level *level = s->c->level;
    int32_t *queue = OTX_NEW(s->run->scratch, int32_t, level->face_count);
    uint8_t *seen = OTX_ZNEW(s->run->scratch, uint8_t, level->face_count);
    int32_t head = 0, tail = 0;

    OTX_TRY(otx_run_ok(s->run));
    for (int32_t seed = 0; seed < level->face_count; ++seed)
    {
        if (!seen[seed])
            queue[tail++] = seed;
        seen[seed] = 1;
        while (head < tail)
        {
            const int32_t face = queue[head++];

            for (int32_t i = level->face_first[face];
                 i < level->face_first[face + 1]; ++i)
            {
                const int32_t e = level->face_edges[i];
                const int32_t *faces = level->edge_faces + 2 * (size_t)e;
                const int32_t other = faces[faces[0] == face];

                if (!s->c->inner[e] || seen[other])
                    continue;
                if (match_of(s, e) < 0)
                    s->angles[other] += OTX_PI;
                seen[other] = 1;
                queue[tail++] = other;
            }
        }
    }
    return OSDTEX_OK;
}

static void
match_edges(solver *s)
{
    s->one_sense = true;
    for (int32_t e = 0; e < s->c->level->edge_count; ++e)
    {
        s->phase->match[e] = (int8_t)(s->c->inner[e] ? match_of(s, e) : 1);
        s->one_sense &= s->phase->match[e] > 0;
    }
}

/* The corner of the same vertex in the face across one of its two edges: the
 * edge that starts at `corner`, or the one that ends there; -1 at a border. */
static int32_t
next_corner(
    const otx_connection *c, int32_t face, int32_t corner, bool outgoing,
    int32_t *next_face, int32_t *edge)
{
    const otx_level *level = c->level;
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const int32_t vertex = level->face_verts[corner];
    const int32_t *faces;
    int32_t at;

    *edge =
        level->face_edges
            [outgoing ? corner : first + (corner - first + size - 1) % size];
    if (!c->inner[*edge])
        return -1;
    faces = level->edge_faces + 2 * (size_t)*edge;
    *next_face = faces[0] == face ? faces[1] : faces[0];
    at = otx_connection_corner(c, *edge, *next_face);
    if (level->face_verts[at] == vertex)
        return at;
    ++at;
    return at == level->face_first[*next_face + 1]
               ? level->face_first[*next_face]
               : at;
}

/* Gives senses to the corners around a vertex, from one of them both ways. */
static void
sense_around(solver *s, int32_t face, int32_t corner)
{
    s->sense[corner] = 1;
    for (int way = 0; way < 2; ++way)
    {
        int32_t f = face, at = corner;

        for (;;)
        {
            int32_t next_face, edge;
            const int32_t next =
                next_corner(s->c, f, at, way == 0, &next_face, &edge);

            if (next < 0 || s->sense[next] != 0)
                break;
            s->sense[next] = (int8_t)(s->sense[at] * s->phase->match[edge]);
            f = next_face;
            at = next;
        }
    }
}

static otx_status
choose_senses(solver *s)
{
    const otx_level *level = s->c->level;

    if (s->request->field->symmetry > 1)
        OTX_TRY(comb(s));
    match_edges(s);
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t i = level->face_first[f]; i < level->face_first[f + 1];
             ++i)
            if (s->sense[i] == 0)
                sense_around(s, f, i);
    return OSDTEX_OK;
}

/* -- steps asked for ----------------------------------------------------- */

/* Cells along half-edge `corner` of `face`, in the face's sense, times
 * e^-log_scale. */
static double
face_wish(const solver *s, int32_t face, int32_t corner, int axis)
{
    const otx_vec2 g = otx_vec2_mul(
        otx_vec2_polar(s->angles[face]), s->request->gradient[axis]);

    return otx_vec2_dot(g, s->c->sides[corner]);
}

static void
make_wishes(solver *s, int axis)
{
    const otx_level *level = s->c->level;

    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * (size_t)e;
        const int32_t *verts = level->edge_verts + 2 * (size_t)e;
        const double scale =
            exp(0.5 * (s->request->log_scale[verts[0]] +
                       s->request->log_scale[verts[1]]));
        /* Of an edge beside a hole, the side that is there. */
        const int32_t f = faces[1] >= 0 && level->face_hole[faces[0]];
        double wish = face_wish(
            s, faces[f], otx_connection_corner(s->c, e, faces[f]), axis);

        if (f == 1)
            wish = -wish;
        if (s->c->inner[e])
            wish =
                0.5 * (wish - s->phase->match[e] *
                                  face_wish(
                                      s, faces[1],
                                      otx_connection_corner(s->c, e, faces[1]),
                                      axis));
        s->wish[axis][e] = scale * wish;
    }
}

/* -- phases -------------------------------------------------------------- */

/* The 2 x 2 block -w S_j R S_i at row j, column i; S conjugates. */
static int64_t
add_block(
    int32_t j, int32_t i, double w, double angle, int sj, int si,
    otx_sparse_entry *entries)
{
    const double c = cos(angle), n = sin(angle);
    const double block[2][2] = {{c, -n * si}, {n * sj, c * sj * si}};
    int64_t count = 0;

    for (int32_t p = 0; p < 2; ++p)
        for (int32_t q = 0; q < 2; ++q)
        {
            const int32_t row = 2 * j + p, column = 2 * i + q;

            entries[count++] = (otx_sparse_entry){
                row > column ? row : column, row > column ? column : row,
                -w * block[p][q], 0.0};
        }
    return count;
}

/* The entries of one edge between the vertices v, whose senses at its first
 * face are given. */
static int64_t
add_edge(
    const solver *s, int axis, int32_t edge, const int32_t v[2],
    const int sense[2], otx_sparse_entry *entries)
{
    const double w = otx_phase_edge_weight(s->c, edge);
    const double angle = 2.0 * OTX_PI * s->wish[axis][edge];
    const int32_t width = s->one_sense ? 1 : 2;
    int64_t count = 0;

    for (int k = 0; k < 2; ++k)
        for (int32_t p = 0; p < width; ++p)
            entries[count++] =
                (otx_sparse_entry){width * v[k] + p, width * v[k] + p, w, 0.0};
    if (!s->one_sense)
        return count +
               add_block(
                   v[1], v[0], w, angle, sense[1], sense[0], entries + count);
    /* Row v1, column v0: -w e^(i angle), or its conjugate in row v0. */
    entries[count++] =
        v[1] > v[0]
            ? (otx_sparse_entry){v[1], v[0], -w * cos(angle), -w * sin(angle)}
            : (otx_sparse_entry){v[0], v[1], -w * cos(angle), w * sin(angle)};
    return count;
}

static otx_status
factor(solver *s, int axis, otx_arena *arena, otx_sparse **out)
{
    const otx_level *level = s->c->level;
    const int64_t edges = level->edge_count;
    const int64_t size = (s->one_sense ? 1 : 2) * (int64_t)level->vert_count;
    otx_sparse_entry *entries =
        OTX_NEW(arena, otx_sparse_entry, 8 * edges + size);
    otx_vec3 *places = OTX_NEW(arena, otx_vec3, size);
    int64_t count = 0;

    if (!entries || !places)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t e = 0; e < edges; ++e)
    {
        int32_t at[2];

        otx_phase_edge_corners(s->c, e, at);
        count += add_edge(
            s, axis, e,
            (const int32_t[2]){
                level->face_verts[at[0]], level->face_verts[at[1]]},
            (const int[2]){s->sense[at[0]], s->sense[at[1]]}, entries + count);
    }
    for (int32_t i = 0; i < size; ++i)
        entries[count++] = (otx_sparse_entry){
            i, i, s->tau * s->mass[s->one_sense ? i : i / 2], 0.0};
    for (int32_t i = 0; i < size; ++i)
        places[i] =
            otx_vec3_load(s->c->surface->points, s->one_sense ? i : i / 2);
    return otx_sparse_factor(
        arena, s->one_sense ? OTX_SPARSE_COMPLEX : OTX_SPARSE_REAL,
        (int32_t)size, places, entries, count, out);
}

static void
normalise(const solver *s, double *z)
{
    for (int32_t v = 0; v < s->c->level->vert_count; ++v)
    {
        const double length = hypot(z[2 * v], z[2 * v + 1]);
        const bool fine = length > 0.0 && isfinite(length);

        z[2 * v] = fine ? z[2 * v] / length : 1.0;
        z[2 * v + 1] = fine ? z[2 * v + 1] / length : 0.0;
    }
}

/* Cells, in (-1/2, 1/2]. */
static double
vertex_phase(const solver *s, int axis, int32_t vertex)
{
    const double *z = s->z[axis] + 2 * (size_t)vertex;

    return atan2(z[1], z[0]) / (2.0 * OTX_PI);
}

/* What the phases make of the wishes: the nearest step that fits them. */
static void
read_steps(solver *s, int axis)
{
    for (int32_t v = 0; v < s->c->level->vert_count; ++v)
        s->turn[axis][v] = vertex_phase(s, axis, v);
    for (int32_t e = 0; e < s->c->level->edge_count; ++e)
    {
        const double wish = s->wish[axis][e];
        double turn[2];
        int32_t at[2];

        otx_phase_edge_corners(s->c, e, at);
        for (int k = 0; k < 2; ++k)
        {
            const int32_t v = s->c->level->face_verts[at[k]];

            turn[k] = s->sense[at[k]] * s->turn[axis][v];
        }
        s->step[axis][e] = turn[1] - turn[0];
        s->step[axis][e] += round(wish - s->step[axis][e]);
    }
}

static otx_status
solve_axis(void *context, int64_t axis, otx_worker *worker)
{
    solver *s = context;
    const int32_t size = 2 * s->c->level->vert_count;
    double *z = s->z[axis];
    double *mass = OTX_NEW(worker->scratch, double, size);
    otx_sparse *lhs;

    if (!mass)
        return OSDTEX_ERROR_MEMORY;
    make_wishes(s, (int)axis);
    if (otx_vec2_length(s->request->gradient[axis]) == 0.0)
    {
        for (int32_t i = 0; i < size; ++i)
            z[i] = i % 2 == 0 ? 1.0 : 0.0;
        read_steps(s, (int)axis);
        return OSDTEX_OK;
    }
    OTX_TRY(factor(s, (int)axis, worker->scratch, &lhs));
    for (int32_t i = 0; i < size; ++i)
    {
        mass[i] = s->mass[s->one_sense ? i % (size / 2) : i / 2];
        z[i] = i % 2 == 0 ? 1.0 : 0.0;
    }
    OTX_TRY(otx_sparse_smallest(worker->scratch, lhs, mass, EIGEN_ROUNDS, z));
    for (int round = 0; round < UNIT_ROUNDS; ++round)
    {
        normalise(s, z);
        for (int32_t i = 0; i < size; ++i)
            z[i] *= s->tau * s->mass[i / 2];
        OTX_TRY(otx_sparse_solve(lhs, z, z));
    }
    read_steps(s, (int)axis);
    return OSDTEX_OK;
}

/* -- cells of faces ------------------------------------------------------ */

static void
lay_face(solver *s, int32_t face)
{
    const otx_level *level = s->c->level;
    const int32_t first = level->face_first[face];
    const int32_t vertex = level->face_verts[first];
    const otx_vec2 start = {
        s->sense[first] * s->turn[0][vertex],
        s->sense[first] * s->turn[1][vertex]};
    otx_vec2 at = start;

    for (int32_t i = first; i < level->face_first[face + 1]; ++i)
    {
        s->phase->cells[i] = at;
        s->phase->parts[i] = (otx_vec2){
            s->sense[i] * s->turn[0][level->face_verts[i]],
            s->sense[i] * s->turn[1][level->face_verts[i]]};
        at.x += otx_phase_face_step(s, face, i, 0);
        at.y += otx_phase_face_step(s, face, i, 1);
    }
    at = otx_vec2_sub(at, start);
    s->phase->defect[face] =
        !level->face_hole[face] && !(fabs(at.x) < WHOLE && fabs(at.y) < WHOLE);
}

/* Vertices around which the senses do not close, which are the field's
 * singularities of half a turn. */
static void
find_singular(solver *s)
{
    const otx_level *level = s->c->level;

    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const int32_t *faces = level->edge_faces + 2 * (size_t)e;
        int32_t at[2];

        if (!s->c->inner[e])
            continue;
        otx_phase_edge_corners(s->c, e, at);
        for (int k = 0; k < 2; ++k)
        {
            const int32_t v = level->face_verts[at[k]];
            int32_t other = level->face_first[faces[1]];

            while (level->face_verts[other] != v)
                ++other;
            if (s->sense[at[k]] * s->phase->match[e] != s->sense[other])
                s->singular[v] = 1;
        }
    }
}

/* They spoil all faces around them. */
static void
mark_singular(solver *s)
{
    const otx_level *level = s->c->level;

    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t i = level->face_first[f]; i < level->face_first[f + 1];
             ++i)
            if (s->singular[level->face_verts[i]] && !level->face_hole[f])
                s->phase->defect[f] = 1;
}

/* -- the whole ----------------------------------------------------------- */

static otx_status
allocate(solver *s)
{
    const otx_level *level = s->c->level;
    otx_arena *arena = s->run->arena, *scratch = s->run->scratch;

    s->phase->match = OTX_NEW(arena, int8_t, level->edge_count);
    s->phase->cells = OTX_NEW(arena, otx_vec2, level->corner_count);
    s->phase->parts = OTX_NEW(arena, otx_vec2, level->corner_count);
    s->phase->defect = OTX_NEW(arena, uint8_t, level->face_count);
    s->angles = OTX_NEW(scratch, double, level->face_count);
    s->sense = OTX_ZNEW(scratch, int8_t, level->corner_count);
    s->mass = OTX_ZNEW(scratch, double, level->vert_count);
    s->singular = OTX_ZNEW(arena, uint8_t, level->vert_count);
    s->phase->turned = s->singular;
    for (int k = 0; k < 2; ++k)
    {
        s->wish[k] = OTX_NEW(arena, double, level->edge_count);
        s->phase->wish[k] = s->wish[k];
        s->step[k] = OTX_NEW(scratch, double, level->edge_count);
        s->z[k] = OTX_NEW(scratch, double, 2 * (int64_t)level->vert_count);
        s->turn[k] = OTX_NEW(scratch, double, level->vert_count);
        OTX_TRY(otx_run_ok(s->run));
    }
    OTX_TRY(otx_run_ok(s->run));
    return OSDTEX_OK;
}

/* Angles, and the area around each vertex; a trace where there is none. */
static void
measure(solver *s)
{
    const otx_level *level = s->c->level;
    const otx_vec2 *g = s->request->gradient;
    const double cell =
        1.0 / fmax(otx_vec2_length(g[0]), otx_vec2_length(g[1]));

    s->tau = 1.0 / (SMOOTHING * cell * SMOOTHING * cell);
    for (int32_t v = 0; v < level->vert_count; ++v)
        s->mass[v] = 1e-9 * s->c->area / level->vert_count;
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(level, f);

        s->angles[f] = otx_direction_angle(s->request->field, f);
        for (int32_t i = 0; i < size; ++i)
            s->mass[level->face_verts[level->face_first[f] + i]] +=
                s->c->areas[f] / size;
    }
}

static void
measure_error(solver *s)
{
    double off = 0.0, all = 0.0;

    for (int axis = 0; axis < 2; ++axis)
        for (int32_t e = 0; e < s->c->level->edge_count; ++e)
        {
            const double w = otx_phase_edge_weight(s->c, e);
            const double wish = s->wish[axis][e];
            const double d = s->step[axis][e] - wish;

            off += w * d * d;
            all += w * wish * wish;
        }
    s->phase->error = all > 0.0 ? sqrt(off / all) : 0.0;
}

static otx_status
solve(solver *s)
{
    otx_status status;

    OTX_TRY(allocate(s));
    measure(s);
    OTX_TRY(choose_senses(s));
    status = otx_pool_for(s->run->pool, 2, solve_axis, s);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(s->run, "field");
    if (status != OSDTEX_OK)
        return otx_fail(
            s->run, status, "field", OTX_NOWHERE,
            "the periodic coordinates have no solution: the surface has "
            "positions that are not finite");
    find_singular(s);
    if (s->request->cancel > 0.0)
        OTX_TRY(otx_dislocation_cancel(s));
    OTX_TRY(otx_phase_fit(s));
    for (int32_t f = 0; f < s->c->level->face_count; ++f)
        lay_face(s, f);
    mark_singular(s);
    for (int32_t f = 0; f < s->c->level->face_count; ++f)
        s->phase->defect_count += s->phase->defect[f];
    measure_error(s);
    return otx_progress(s->run, "field", 1.0);
}

int32_t
otx_phase_level(const otx_surface *surface, double cell)
{
    int32_t level = surface->level_count - 1;
    double edge = surface->mean_edge_length;

    for (; level > 1; --level)
    {
        const bool large = surface->levels[level].face_count > LARGE;

        edge *= 2.0;
        if (edge * (large ? EDGES_OF_LARGE : EDGES) > cell)
            break;
    }
    return level;
}

otx_status
otx_phase_solve(otx_run *run, const otx_phase_request *request, otx_phase *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    solver s = {
        .run = run,
        .request = request,
        .c = request->field->connection,
        .phase = out};
    otx_status status;

    *out = (otx_phase){.connection = s.c};
    status = solve(&s);
    otx_arena_release(run->scratch, mark);
    assert(status != OSDTEX_OK || !otx_phase_check(out));
    return status;
}

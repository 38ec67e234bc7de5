/* direction_solve.c -- the smoothest direction field, or the one that is asked
 * for. */
#include "field/direction.h"

#include "math/sparse.h"

enum
{
    /* Of Lanczos' method. More are nearer the smallest eigenvector and farther
     * from the start; on a torus, where several are equal, their mixture has
     * singularities that the start does not have. */
    EIGEN_ROUNDS = 4,
    UNIT_ROUNDS = 40 /* of smoothing and normalising, at most */
};

/* Largest change of a unit number at which the rounds end. */
static const double SETTLED = 1e-4;

/* tau = SMOOTHING / area: the reciprocal square of the length over which one
 * round smooths, about the radius of a sphere of that area. */
static const double SMOOTHING = 4.0 * OTX_PI;

/* A part along a face that is shorter than this says nothing. */
static const double UPRIGHT = 1e-3;

typedef struct solver
{
    otx_run *run;
    const otx_connection *c;
    const otx_direction_request *request;
    otx_direction *field;
    int32_t *row;    /* [face_count] unknown of a face, -1 locked */
    int32_t *faces;  /* [size] face of an unknown */
    int32_t size;    /* unknowns */
    double tau;      /* 1 / length^2 */
    double *mass;    /* [size] areas */
    double *pull;    /* [2 size] what pins, locked faces and pull add */
    double *z;       /* [2 size] */
    otx_sparse *lhs; /* Laplacian + tau mass + pull */
} solver;

/* -- assembling ---------------------------------------------------------- */

/* Locks the pinned faces to their vectors. */
static void
lock_pins(solver *s)
{
    for (int32_t p = 0; p < s->request->pin_count; ++p)
    {
        const otx_direction_pin *pin = &s->request->pins[p];
        const otx_vec2 flat =
            otx_connection_project(s->c, pin->face, otx_vec3_unit(pin->vector));

        s->row[pin->face] = -1;
        s->field->powers[pin->face] = otx_direction_unit(
            otx_direction_power(flat, s->request->symmetry), (otx_vec2){1, 0});
    }
}

static otx_status
number_unknowns(solver *s, const uint8_t *effect)
{
    const int32_t count = s->c->level->face_count;

    s->row = OTX_NEW(s->run->scratch, int32_t, count);
    s->faces = OTX_NEW(s->run->scratch, int32_t, count);
    OTX_TRY(otx_run_ok(s->run));
    for (int32_t f = 0; f < count; ++f)
        s->row[f] =
            s->c->level->face_hole[f] || (effect && !effect[f]) ? -1 : 0;
    lock_pins(s);
    for (int32_t f = 0; f < count; ++f)
        if (s->row[f] >= 0)
        {
            s->faces[s->size] = f;
            s->row[f] = s->size++;
        }
    s->mass = OTX_NEW(s->run->scratch, double, s->size + 1);
    s->pull = OTX_ZNEW(s->run->scratch, double, 2 * s->size + 2);
    s->z = OTX_ZNEW(s->run->scratch, double, 2 * s->size + 2);
    OTX_TRY(otx_run_ok(s->run));
    return OSDTEX_OK;
}

/* Adds the term of one edge, to unknown rows or to the right side. */
static int64_t
add_edge(solver *s, int32_t edge, otx_sparse_entry *entries)
{
    const int32_t *faces = s->c->level->edge_faces + 2 * (size_t)edge;
    const int32_t f = s->row[faces[0]], g = s->row[faces[1]];
    const double w = s->c->weights[edge];
    const otx_vec2 r = otx_vec2_polar(s->request->symmetry * s->c->turns[edge]);
    int64_t count = 0;

    if (f >= 0)
        entries[count++] = (otx_sparse_entry){f, f, w, 0.0};
    if (g >= 0)
        entries[count++] = (otx_sparse_entry){g, g, w, 0.0};
    if (f >= 0 && g >= 0)
        /* Row g has -w r, row f its conjugate; the lower one is stored. */
        entries[count++] = g > f ? (otx_sparse_entry){g, f, -w * r.x, -w * r.y}
                                 : (otx_sparse_entry){f, g, -w * r.x, w * r.y};
    else if (f >= 0 || g >= 0)
    {
        const otx_vec2 from = s->field->powers[faces[f >= 0]];
        const otx_vec2 turn = f >= 0 ? (otx_vec2){r.x, -r.y} : r;
        const otx_vec2 z = otx_vec2_mul(turn, from);
        double *to = s->pull + 2 * (size_t)(f >= 0 ? f : g);

        to[0] += w * z.x;
        to[1] += w * z.y;
    }
    return count;
}

/* The diagonal of an unknown, and what attracts it: as strongly as it is sure.
 */
static otx_sparse_entry
add_face(solver *s, int32_t row)
{
    const otx_direction_request *q = s->request;
    const int32_t face = s->faces[row];
    const double area = fmax(s->c->areas[face], 1e-12 * s->c->area);
    double weight = 0.0;

    s->mass[row] = area;
    if (q->pull)
    {
        const otx_vec2 z = q->pull[face];

        weight = area / (q->pull_length * q->pull_length);
        s->pull[2 * row] += weight * z.x;
        s->pull[2 * row + 1] += weight * z.y;
        weight *= otx_vec2_length(z);
    }
    return (otx_sparse_entry){row, row, weight + s->tau * area, 0.0};
}

static otx_status
factor(solver *s)
{
    const int32_t edges = s->c->level->edge_count;
    otx_sparse_entry *entries = OTX_NEW(
        s->run->scratch, otx_sparse_entry, 3 * (int64_t)edges + s->size);
    otx_vec3 *places = OTX_NEW(s->run->scratch, otx_vec3, s->size);
    int64_t count = 0;
    otx_status status;

    OTX_TRY(otx_run_ok(s->run));
    s->tau = SMOOTHING / s->c->area;
    for (int32_t e = 0; e < edges; ++e)
        if (s->c->inner[e])
            count += add_edge(s, e, entries + count);
    for (int32_t i = 0; i < s->size; ++i)
        entries[count++] = add_face(s, i);
    for (int32_t i = 0; i < s->size; ++i)
        places[i] = s->c->centres[s->faces[i]];
    status = otx_sparse_factor(
        s->run->scratch, OTX_SPARSE_COMPLEX, s->size, places, entries, count,
        &s->lhs);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(s->run, "field");
    if (status != OSDTEX_OK)
        return otx_fail(
            s->run, status, "field", OTX_NOWHERE,
            "the direction field has no solution: the surface has faces "
            "without area or with positions that are not finite");
    return OSDTEX_OK;
}

/* -- solving ------------------------------------------------------------- */

static otx_vec2
leaning(const solver *s, int32_t face)
{
    const otx_vec3 lean = s->request->lean;
    const otx_vec3 up = otx_vec3_dot(lean, lean) > 0.0 ? otx_vec3_unit(lean)
                                                       : (otx_vec3){0, 1, 0};
    otx_vec2 flat = otx_connection_project(s->c, face, up);

    /* A little of another axis, where the first is upright. */
    flat = otx_vec2_add(
        flat, otx_vec2_scale(
                  0.01, otx_connection_project(
                            s->c, face, (otx_vec3){up.y, up.z, up.x})));
    return otx_direction_power(flat, s->request->symmetry);
}

/* Lets pins and pull have their say before the first rounds: what they reach
 * follows them, the rest keeps the smoothest field. */
static otx_status
follow_pull(solver *s)
{
    double pulled = 0.0;

    for (int32_t i = 0; i < 2 * s->size; ++i)
        pulled = fmax(pulled, fabs(s->pull[i]));
    if (!(pulled > 0.0))
        return OSDTEX_OK;
    for (int32_t i = 0; i < 2 * s->size; ++i)
        s->z[i] = 1e-3 * s->tau * s->mass[i / 2] * s->z[i] + s->pull[i];
    return otx_sparse_solve(s->lhs, s->z, s->z);
}

/* A start for the rounds below: the smoothest field, or, for an edit, what is
 * there. */
static otx_status
begin(solver *s, bool edit)
{
    otx_status status;

    for (int32_t i = 0; i < s->size; ++i)
    {
        const otx_vec2 z =
            edit ? s->field->powers[s->faces[i]] : leaning(s, s->faces[i]);

        s->z[2 * i] = z.x;
        s->z[2 * i + 1] = z.y;
    }
    if (edit)
        return OSDTEX_OK;
    status = otx_sparse_smallest(
        s->run->scratch, s->lhs, s->mass, EIGEN_ROUNDS, s->z);
    if (status != OSDTEX_OK)
        return otx_fail(
            s->run, status, "field", OTX_NOWHERE,
            "the direction field did not converge");
    return follow_pull(s);
}

/* Makes all numbers unit; how much the most changed one moved from `old`. */
static double
normalise(solver *s, double *old)
{
    double most = 0.0;

    for (int32_t i = 0; i < s->size; ++i)
    {
        const otx_vec2 z = otx_direction_unit(
            (otx_vec2){s->z[2 * i], s->z[2 * i + 1]},
            otx_direction_unit(leaning(s, s->faces[i]), (otx_vec2){1, 0}));

        most = fmax(most, fabs(z.x - old[2 * i]));
        most = fmax(most, fabs(z.y - old[2 * i + 1]));
        old[2 * i] = s->z[2 * i] = z.x;
        old[2 * i + 1] = s->z[2 * i + 1] = z.y;
    }
    return most;
}

static otx_status
smooth(solver *s)
{
    for (int32_t i = 0; i < 2 * s->size; ++i)
        s->z[i] = s->tau * s->mass[i / 2] * s->z[i] + s->pull[i];
    return otx_sparse_solve(s->lhs, s->z, s->z);
}

static otx_status
solve(solver *s, const uint8_t *effect)
{
    double *old;

    OTX_TRY(number_unknowns(s, effect));
    if (s->size == 0)
        return OSDTEX_OK;
    OTX_TRY(factor(s));
    OTX_TRY(begin(s, effect != NULL));
    old = OTX_ZNEW(s->run->scratch, double, 2 * (int64_t)s->size);
    OTX_TRY(otx_run_ok(s->run));
    normalise(s, old);
    for (int round = 0; round < UNIT_ROUNDS; ++round)
    {
        if (smooth(s) != OSDTEX_OK)
            return otx_fail_memory(s->run, "field");
        if (normalise(s, old) < SETTLED)
            break;
        OTX_TRY(otx_progress(s->run, "field", (round + 1.0) / UNIT_ROUNDS));
    }
    for (int32_t i = 0; i < s->size; ++i)
        s->field->powers[s->faces[i]] =
            (otx_vec2){s->z[2 * i], s->z[2 * i + 1]};
    return OSDTEX_OK;
}

static otx_status
check(otx_run *run, const otx_direction_request *q)
{
    if (q->symmetry != 1 && q->symmetry != 2 && q->symmetry != 4)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "a direction field has symmetry 1, 2 or 4, not %d",
            (int)q->symmetry);
    if (!isfinite(otx_vec3_length(q->lean)) ||
        (q->pull && !(q->pull_length > 0.0)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "the length over which what attracts a direction field gives way "
            "is positive");
    return OSDTEX_OK;
}

/* NULL where a pin can be held. */
static const char *
fault_of_pin(const otx_connection *c, const otx_direction_pin *pin)
{
    if (pin->face < 0 || pin->face >= c->level->face_count)
        return "names a face that is not there";
    if (c->level->face_hole[pin->face])
        return "lies on a hole";
    if (!isfinite(pin->vector.x) || !isfinite(pin->vector.y) ||
        !isfinite(pin->vector.z))
        return "has a vector that is not finite";
    if (!(otx_vec2_length(otx_connection_project(
              c, pin->face, otx_vec3_unit(pin->vector))) > UPRIGHT))
        return "has a vector that stands upright on the surface; give one "
               "along it";
    return NULL;
}

otx_status
otx_direction_check(
    otx_run *run, const otx_connection *c, const otx_direction_request *q)
{
    OTX_TRY(check(run, q));
    for (int32_t p = 0; p < q->pin_count; ++p)
    {
        const int32_t face = q->pins[p].face;
        const bool known = face >= 0 && face < c->level->face_count;
        const char *fault = fault_of_pin(c, &q->pins[p]);

        if (fault)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, "field",
                (otx_where){
                    c->surface->cage->path, 0,
                    known ? c->level->face_cage[face] : -1, -1},
                "direction constraint %d %s", (int)p + 1, fault);
    }
    return OSDTEX_OK;
}

otx_status
otx_direction_solve(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request, otx_direction *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = connection->level->face_count;
    solver s = {.run = run, .c = connection, .request = request, .field = out};
    otx_status status;

    OTX_TRY(otx_direction_check(run, connection, request));
    *out = (otx_direction){
        connection, request->symmetry, OTX_NEW(run->arena, otx_vec2, count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
        out->powers[f] = (otx_vec2){1, 0};
    status = solve(&s, NULL);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_direction_edit(
    otx_run *run, const otx_direction_request *request, const uint8_t *effect,
    otx_direction *field)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    solver s = {
        .run = run, .c = field->connection, .request = request, .field = field};
    otx_status status;

    OTX_TRY(otx_direction_check(run, field->connection, request));
    if (request->symmetry != field->symmetry)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "an edit keeps the symmetry of the field");
    status = solve(&s, effect);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* Takes over what vectors say; marks the faces to which they say nothing. */
static int32_t
take_vectors(
    const otx_direction *field, const otx_vec3 *vectors, uint8_t *silent)
{
    const otx_connection *c = field->connection;
    int32_t count = 0;

    for (int32_t f = 0; f < c->level->face_count; ++f)
    {
        const otx_vec2 flat =
            otx_connection_project(c, f, otx_vec3_unit(vectors[f]));
        /* Written so that NaN is silent too. */
        const bool speaks = otx_vec2_length(flat) > UPRIGHT;

        field->powers[f] = speaks
                               ? otx_direction_unit(
                                     otx_direction_power(flat, field->symmetry),
                                     (otx_vec2){1, 0})
                               : (otx_vec2){1, 0};
        silent[f] = !speaks && !c->level->face_hole[f];
        count += silent[f];
    }
    return count;
}

otx_status
otx_direction_from_vectors(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const otx_vec3 *vectors, otx_direction *out)
{
    const otx_direction_request request = {.symmetry = symmetry};
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = connection->level->face_count;
    uint8_t *silent = OTX_NEW(run->scratch, uint8_t, count);

    OTX_TRY(check(run, &request));
    *out = (otx_direction){
        connection, symmetry, OTX_NEW(run->arena, otx_vec2, count)};
    OTX_TRY(otx_run_ok(run));
    if (take_vectors(out, vectors, silent) > 0)
        OTX_TRY(otx_direction_edit(run, &request, silent, out));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* rigid.c -- triangles, their Laplacian, and a small solver.
 *
 * Cotangents are clamped to a positive range so that the Laplacian stays
 * positive semi-definite on sliver triangles; a developable chart keeps zero
 * energy under any positive weights, so clamping costs accuracy only where
 * there is distortion to distribute anyway. */
#include "flatten/rigid.h"

#include "base/csr.h"
#include "flatten/stretch.h"

#include <string.h>

static const double COT_MINIMUM = 0.05;
static const double COT_MAXIMUM = 20.0;

enum
{
    ROWS = 2048 /* of a block: sums are made in blocks, whoever makes them */
};

/* Half the cotangent of the angle at `apex`, clamped. */
static double
half_cotangent(otx_vec2 apex, otx_vec2 a, otx_vec2 b)
{
    const otx_vec2 u = otx_vec2_sub(a, apex), v = otx_vec2_sub(b, apex);
    const double cross = otx_vec2_cross(u, v);
    const double cot = cross > 0.0 ? otx_vec2_dot(u, v) / cross : COT_MAXIMUM;

    return 0.5 * fmin(fmax(cot, COT_MINIMUM), COT_MAXIMUM);
}

static void
make_triangle(const otx_rigid_mesh *mesh, otx_rigid_triangle *t)
{
    double texels = mesh->density ? 0.0 : mesh->texels;
    otx_vec3 p[3];

    for (int i = 0; mesh->density && i < 3; ++i)
        texels +=
            mesh->texels / 3.0 * (double)mesh->density[mesh->verts[t->v[i]]];
    for (int i = 0; i < 3; ++i)
        p[i] = otx_vec3_scale(
            texels, otx_vec3_load(mesh->points, mesh->verts[t->v[i]]));
    otx_stretch_layout(p, t->q);
    for (int i = 0; i < 3; ++i)
        t->w[i] = half_cotangent(t->q[(i + 2) % 3], t->q[i], t->q[(i + 1) % 3]);
}

static void
make_triangles(const otx_rigid_mesh *mesh, otx_rigid *r)
{
    for (int32_t f = 0; f < mesh->face_count; ++f)
        for (int32_t c = mesh->first[f] + 1; c + 1 < mesh->first[f + 1]; ++c)
        {
            otx_rigid_triangle *t = &r->triangles[r->triangle_count++];

            t->v[0] = mesh->corners[mesh->first[f]];
            t->v[1] = mesh->corners[c];
            t->v[2] = mesh->corners[c + 1];
            make_triangle(mesh, t);
        }
}

static void
make_rows(otx_rigid *r)
{
    for (int32_t t = 0; t < r->triangle_count; ++t)
        for (int i = 0; i < 3; ++i)
            otx_csr_count(r->row, r->triangles[t].v[i], 2);
    otx_csr_sum(r->row, r->vert_count);
    for (int32_t t = 0; t < r->triangle_count; ++t)
        for (int i = 0; i < 3; ++i)
        {
            const otx_rigid_triangle *d = &r->triangles[t];
            const int32_t a = d->v[i], b = d->v[(i + 1) % 3];
            const int32_t ab = otx_csr_place(r->row, a);
            const int32_t ba = otx_csr_place(r->row, b);

            r->column[ab] = b;
            r->column[ba] = a;
            r->weight[ab] = r->weight[ba] = d->w[i];
            r->diagonal[a] += d->w[i];
            r->diagonal[b] += d->w[i];
        }
}

/* An edge of two triangles stands twice in its row: once is half the work of
 * every product. */
static void
merge_rows(otx_rigid *r)
{
    int32_t end = 0;

    for (int32_t v = 0; v < r->vert_count; ++v)
    {
        const int32_t first = end;
        const int32_t old = r->row[v];

        r->row[v] = first;
        for (int32_t e = old; e < r->row[v + 1]; ++e)
        {
            int32_t at = first;

            while (at < end && r->column[at] != r->column[e])
                ++at;
            if (at == end)
            {
                r->column[end] = r->column[e];
                r->weight[end++] = r->weight[e];
            }
            else
                r->weight[at] += r->weight[e];
        }
    }
    r->row[r->vert_count] = end;
}

otx_status
otx_rigid_build(otx_arena *arena, const otx_rigid_mesh *mesh, otx_rigid *out)
{
    const int64_t corners = mesh->first[mesh->face_count];
    const int64_t n = mesh->vert_count;

    *out = (otx_rigid){.vert_count = mesh->vert_count};
    out->triangles = OTX_NEW(arena, otx_rigid_triangle, corners);
    out->row = OTX_ZNEW(arena, int32_t, n + 2);
    out->column = OTX_NEW(arena, int32_t, 6 * corners);
    out->weight = OTX_NEW(arena, double, 6 * corners);
    out->diagonal = OTX_ZNEW(arena, double, n);
    if (!out->triangles || !out->row || !out->column || !out->weight ||
        !out->diagonal)
        return OSDTEX_ERROR_MEMORY;
    make_triangles(mesh, out);
    make_rows(out);
    merge_rows(out);
    return OSDTEX_OK;
}

/* The rotation that carries the edges of q nearest to those of flat, as a unit
 * complex number; zero when there is none. */
static otx_vec2
best_rotation(const otx_rigid_triangle *t, const otx_vec2 *flat)
{
    otx_vec2 turn = {0, 0};
    double length;

    for (int k = 0; k < 3; ++k)
    {
        const int m = (k + 1) % 3;
        const otx_vec2 q = otx_vec2_sub(t->q[k], t->q[m]);
        const otx_vec2 u = otx_vec2_sub(flat[t->v[k]], flat[t->v[m]]);

        turn = otx_vec2_add(
            turn,
            otx_vec2_scale(t->w[k], otx_vec2_mul((otx_vec2){q.x, -q.y}, u)));
    }
    length = otx_vec2_length(turn);
    return length > 0.0 ? otx_vec2_scale(1.0 / length, turn) : turn;
}

/* Of edge (k, k + 1): what corner k gains and the other loses. */
static otx_vec2
edge_pull(const otx_rigid_triangle *t, otx_vec2 turn, int k)
{
    return otx_vec2_scale(
        t->w[k], otx_vec2_mul(turn, otx_vec2_sub(t->q[k], t->q[(k + 1) % 3])));
}

void
otx_rigid_pull(const otx_rigid *rigid, const otx_vec2 *flat, otx_vec2 *b)
{
    for (int32_t v = 0; v < rigid->vert_count; ++v)
        b[v] = (otx_vec2){0, 0};
    for (int32_t i = 0; i < rigid->triangle_count; ++i)
    {
        const otx_rigid_triangle *t = &rigid->triangles[i];
        const otx_vec2 turn = best_rotation(t, flat);

        for (int k = 0; k < 3; ++k)
        {
            const int m = (k + 1) % 3;
            const otx_vec2 pull = edge_pull(t, turn, k);

            b[t->v[k]] = otx_vec2_add(b[t->v[k]], pull);
            b[t->v[m]] = otx_vec2_sub(b[t->v[m]], pull);
        }
    }
}

otx_status
otx_rigid_fans_build(
    otx_arena *arena, const otx_rigid *rigid, otx_rigid_fans *out)
{
    const int32_t n = rigid->vert_count, corners = 3 * rigid->triangle_count;

    out->first = OTX_ZNEW(arena, int32_t, (int64_t)n + 2);
    out->corners = OTX_NEW(arena, int32_t, corners);
    out->turns = OTX_NEW(arena, otx_vec2, rigid->triangle_count);
    if (!out->first || !out->corners || !out->turns)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t c = 0; c < corners; ++c)
        otx_csr_count(out->first, rigid->triangles[c / 3].v[c % 3], 1);
    otx_csr_sum(out->first, n);
    for (int32_t c = 0; c < corners; ++c)
        out->corners[otx_csr_place(
            out->first, rigid->triangles[c / 3].v[c % 3])] = c;
    return OSDTEX_OK;
}

void
otx_rigid_fans_turn(
    const otx_rigid *rigid, const otx_vec2 *flat, int32_t first, int32_t end,
    otx_rigid_fans *fans)
{
    for (int32_t i = first; i < end; ++i)
        fans->turns[i] = best_rotation(&rigid->triangles[i], flat);
}

/* A corner has the edge that starts and the one that ends there; the order is
 * that in which otx_rigid_pull adds them. */
void
otx_rigid_fans_pull(
    const otx_rigid *rigid, const otx_rigid_fans *fans, int32_t first,
    int32_t end, otx_vec2 *b)
{
    for (int32_t v = first; v < end; ++v)
    {
        otx_vec2 sum = {0, 0};

        for (int32_t i = fans->first[v]; i < fans->first[v + 1]; ++i)
        {
            const int32_t triangle = fans->corners[i] / 3;
            const int k = fans->corners[i] % 3;
            const otx_rigid_triangle *t = &rigid->triangles[triangle];
            const otx_vec2 turn = fans->turns[triangle];

            if (k > 0)
                sum = otx_vec2_sub(sum, edge_pull(t, turn, k - 1));
            sum = otx_vec2_add(sum, edge_pull(t, turn, k));
            if (k == 0)
                sum = otx_vec2_sub(sum, edge_pull(t, turn, 2));
        }
        b[v] = sum;
    }
}

void
otx_rigid_apply(
    const otx_rigid *rigid, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    for (int32_t v = first; v < end; ++v)
    {
        otx_vec2 sum = otx_vec2_scale(rigid->diagonal[v], x[v]);

        for (int32_t e = rigid->row[v]; e < rigid->row[v + 1]; ++e)
        {
            sum.x -= rigid->weight[e] * x[rigid->column[e]].x;
            sum.y -= rigid->weight[e] * x[rigid->column[e]].y;
        }
        out[v] = sum;
    }
}

/* -- conjugate gradients ------------------------------------------------- */

typedef struct solver
{
    const otx_rigid_system *system;
    otx_vec2 *x, *r, *z, *p, *ap;
    double step, turn;
    double *sums; /* of the blocks */
} solver;

static int32_t
end_of(const solver *s, int64_t block)
{
    const int64_t end = (block + 1) * ROWS;

    return end < s->system->count ? (int32_t)end : s->system->count;
}

/* ap = A p, and p . ap */
static otx_status
apply_block(void *context, int64_t block, otx_worker *worker)
{
    const solver *s = context;
    const int32_t first = (int32_t)block * ROWS, end = end_of(s, block);
    double sum = 0.0;

    (void)worker;
    s->system->apply(s->system->context, s->p, first, end, s->ap);
    for (int32_t v = first; v < end; ++v)
        sum += otx_vec2_dot(s->p[v], s->ap[v]);
    s->sums[block] = sum;
    return OSDTEX_OK;
}

/* A step along p; what is left, z = r / diagonal, and r . z */
static otx_status
step_block(void *context, int64_t block, otx_worker *worker)
{
    const solver *s = context;
    const otx_vec2 *diagonal = s->system->diagonal;
    double sum = 0.0;

    (void)worker;
    for (int32_t v = (int32_t)block * ROWS; v < end_of(s, block); ++v)
    {
        s->x[v] = otx_vec2_add(s->x[v], otx_vec2_scale(s->step, s->p[v]));
        s->r[v] = otx_vec2_sub(s->r[v], otx_vec2_scale(s->step, s->ap[v]));
        s->z[v] =
            (otx_vec2){s->r[v].x / diagonal[v].x, s->r[v].y / diagonal[v].y};
        sum += otx_vec2_dot(s->r[v], s->z[v]);
    }
    s->sums[block] = sum;
    return OSDTEX_OK;
}

/* p = z + turn p */
static otx_status
turn_block(void *context, int64_t block, otx_worker *worker)
{
    const solver *s = context;

    (void)worker;
    for (int32_t v = (int32_t)block * ROWS; v < end_of(s, block); ++v)
        s->p[v] = otx_vec2_add(s->z[v], otx_vec2_scale(s->turn, s->p[v]));
    return OSDTEX_OK;
}

static int64_t
block_count(const otx_rigid_system *system)
{
    return ((int64_t)system->count + ROWS - 1) / ROWS;
}

/* Runs a body over all blocks; the sum of their sums, in order. */
static double
over_blocks(solver *s, otx_pool_body body)
{
    const int64_t blocks = block_count(s->system);
    double sum = 0.0;

    /* Bodies do not fail. */
    if (s->system->pool && blocks > 1)
        otx_pool_for(s->system->pool, blocks, body, s);
    else
        for (int64_t b = 0; b < blocks; ++b)
            body(s, b, NULL);
    for (int64_t b = 0; b < blocks; ++b)
        sum += s->sums[b];
    return sum;
}

/* A Laplacian does not see translations; starting from x, conjugate gradients
 * leave them as they are. */
static otx_status
iterate(solver *s)
{
    const double tolerance = s->system->tolerance;
    double first, rz;

    /* The residual of x as the step of length 1 from b along x. */
    memcpy(s->p, s->x, (size_t)s->system->count * sizeof *s->p);
    over_blocks(s, apply_block);
    memset(s->p, 0, (size_t)s->system->count * sizeof *s->p);
    s->step = 1.0;
    first = rz = over_blocks(s, step_block);
    s->turn = 0.0;
    for (int32_t i = 0; i < s->system->rounds; ++i)
    {
        double next;

        if (!(rz > tolerance * tolerance * first) || !(rz > 1e-18))
            return OSDTEX_OK;
        OTX_TRY(
            s->system->pool ? otx_pool_look(s->system->pool)
                            : otx_worker_look(s->system->worker));
        over_blocks(s, turn_block);
        s->step = rz / over_blocks(s, apply_block);
        next = over_blocks(s, step_block);
        s->turn = next / rz;
        rz = next;
    }
    return OSDTEX_OK;
}

otx_status
otx_rigid_solve(
    otx_arena *scratch, const otx_rigid_system *system, const otx_vec2 *b,
    otx_vec2 *x)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    const size_t bytes = (size_t)system->count * sizeof *b;
    solver s = {
        .system = system,
        .x = x,
        .r = OTX_NEW(scratch, otx_vec2, system->count),
        .z = OTX_NEW(scratch, otx_vec2, system->count),
        .p = OTX_NEW(scratch, otx_vec2, system->count),
        .ap = OTX_NEW(scratch, otx_vec2, system->count),
        .sums = OTX_ZNEW(scratch, double, block_count(system))};

    if (!s.r || !s.z || !s.p || !s.ap || !s.sums)
        return OSDTEX_ERROR_MEMORY;
    memcpy(s.r, b, bytes);
    OTX_TRY(iterate(&s));
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

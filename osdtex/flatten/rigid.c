/* rigid.c -- triangles, their Laplacian, and a small solver.
 *
 * Cotangents are clamped to a positive range so that the Laplacian stays
 * positive semi-definite on sliver triangles; a developable chart keeps zero
 * energy under any positive weights, so clamping costs accuracy only where
 * there is distortion to distribute anyway. */
#include "flatten/rigid.h"

#include "flatten/stretch.h"

static const double COT_MINIMUM = 0.05;
static const double COT_MAXIMUM = 20.0;

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
    otx_vec3 p[3];

    for (int i = 0; i < 3; ++i)
        p[i] = otx_vec3_scale(
            mesh->texels, otx_vec3_load(mesh->points, mesh->verts[t->v[i]]));
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

/* Counts, sums, fills; filling shifts the offsets, which are put back. */
static void
make_rows(otx_rigid *r)
{
    const int32_t n = r->vert_count;

    for (int32_t t = 0; t < r->triangle_count; ++t)
        for (int i = 0; i < 3; ++i)
            r->row[r->triangles[t].v[i] + 1] += 2;
    for (int32_t v = 0; v < n; ++v)
        r->row[v + 1] += r->row[v];
    for (int32_t t = 0; t < r->triangle_count; ++t)
        for (int i = 0; i < 3; ++i)
        {
            const otx_rigid_triangle *d = &r->triangles[t];
            const int32_t a = d->v[i], b = d->v[(i + 1) % 3];

            r->column[r->row[a]] = b;
            r->weight[r->row[a]++] = d->w[i];
            r->column[r->row[b]] = a;
            r->weight[r->row[b]++] = d->w[i];
            r->diagonal[a] += d->w[i];
            r->diagonal[b] += d->w[i];
        }
    for (int32_t v = n; v > 0; --v)
        r->row[v] = r->row[v - 1];
    r->row[0] = 0;
}

otx_status
otx_rigid_build(otx_arena *arena, const otx_rigid_mesh *mesh, otx_rigid *out)
{
    const int64_t corners = mesh->first[mesh->face_count];
    const int64_t n = mesh->vert_count;

    *out = (otx_rigid){.vert_count = mesh->vert_count};
    out->triangles = OTX_NEW(arena, otx_rigid_triangle, corners);
    out->row = OTX_ZNEW(arena, int32_t, n + 1);
    out->column = OTX_NEW(arena, int32_t, 6 * corners);
    out->weight = OTX_NEW(arena, double, 6 * corners);
    out->diagonal = OTX_ZNEW(arena, double, n);
    if (!out->triangles || !out->row || !out->column || !out->weight ||
        !out->diagonal)
        return OSDTEX_ERROR_MEMORY;
    make_triangles(mesh, out);
    make_rows(out);
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
            const otx_vec2 pull = otx_vec2_scale(
                t->w[k], otx_vec2_mul(turn, otx_vec2_sub(t->q[k], t->q[m])));

            b[t->v[k]] = otx_vec2_add(b[t->v[k]], pull);
            b[t->v[m]] = otx_vec2_sub(b[t->v[m]], pull);
        }
    }
}

void
otx_rigid_apply(const otx_rigid *rigid, const otx_vec2 *x, otx_vec2 *out)
{
    for (int32_t v = 0; v < rigid->vert_count; ++v)
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

static double
dot(const otx_vec2 *a, const otx_vec2 *b, int32_t n)
{
    double sum = 0.0;

    for (int32_t v = 0; v < n; ++v)
        sum += otx_vec2_dot(a[v], b[v]);
    return sum;
}

/* z = r / diagonal; returns r . z */
static double
precondition(const otx_rigid_system *s, const otx_vec2 *r, otx_vec2 *z)
{
    for (int32_t v = 0; v < s->count; ++v)
        z[v] = (otx_vec2){r[v].x / s->diagonal[v].x, r[v].y / s->diagonal[v].y};
    return dot(r, z, s->count);
}

/* A Laplacian does not see translations; starting from x, conjugate gradients
 * leave them as they are. */
static void
iterate(
    const otx_rigid_system *s, otx_vec2 *x, otx_vec2 *r, otx_vec2 *z,
    otx_vec2 *p, otx_vec2 *ap)
{
    const double first = precondition(s, r, z);
    double rz = first;

    for (int32_t v = 0; v < s->count; ++v)
        p[v] = z[v];
    for (int32_t i = 0; i < s->rounds; ++i)
    {
        double step, next;

        if (!(rz > s->tolerance * s->tolerance * first) || !(rz > 1e-18))
            return;
        s->apply(s->context, p, ap);
        step = rz / dot(p, ap, s->count);
        for (int32_t v = 0; v < s->count; ++v)
        {
            x[v] = otx_vec2_add(x[v], otx_vec2_scale(step, p[v]));
            r[v] = otx_vec2_sub(r[v], otx_vec2_scale(step, ap[v]));
        }
        next = precondition(s, r, z);
        for (int32_t v = 0; v < s->count; ++v)
            p[v] = otx_vec2_add(z[v], otx_vec2_scale(next / rz, p[v]));
        rz = next;
    }
}

otx_status
otx_rigid_solve(
    otx_arena *scratch, const otx_rigid_system *system, const otx_vec2 *b,
    otx_vec2 *x)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    otx_vec2 *r = OTX_NEW(scratch, otx_vec2, system->count);
    otx_vec2 *z = OTX_NEW(scratch, otx_vec2, system->count);
    otx_vec2 *p = OTX_NEW(scratch, otx_vec2, system->count);
    otx_vec2 *ap = OTX_NEW(scratch, otx_vec2, system->count);

    if (!r || !z || !p || !ap)
        return OSDTEX_ERROR_MEMORY;
    system->apply(system->context, x, ap);
    for (int32_t v = 0; v < system->count; ++v)
        r[v] = otx_vec2_sub(b[v], ap[v]);
    iterate(system, x, r, z, p, ap);
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

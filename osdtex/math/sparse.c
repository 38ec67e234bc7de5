/* sparse.c -- sparse symmetric systems by Cholesky factors. */
#include "math/sparse.h"

#include "math/dissect.h"

#include <math.h>
#include <string.h>
#include <suitesparse/cholmod.h>

enum
{
    PLACED_MIN = 4096 /* unknowns: minimum degree does as well on fewer */
};

struct otx_sparse
{
    otx_sparse_kind kind;
    int32_t size;
    cholmod_common common;
    cholmod_factor *factor;
    /* Reused from solve to solve. */
    cholmod_dense *b, *x, *y, *e;
};

static void
destroy(void *object)
{
    otx_sparse *s = object;

    cholmod_free_dense(&s->b, &s->common);
    cholmod_free_dense(&s->x, &s->common);
    cholmod_free_dense(&s->y, &s->common);
    cholmod_free_dense(&s->e, &s->common);
    cholmod_free_factor(&s->factor, &s->common);
    cholmod_finish(&s->common);
}

/* Doubles of one number. */
static size_t
width(const otx_sparse *s)
{
    return s->kind == OTX_SPARSE_COMPLEX ? 2 : 1;
}

static int
xtype(const otx_sparse *s)
{
    return s->kind == OTX_SPARSE_COMPLEX ? CHOLMOD_COMPLEX : CHOLMOD_REAL;
}

static otx_status
status_of(const otx_sparse *s)
{
    if (s->common.status == CHOLMOD_OUT_OF_MEMORY)
        return OSDTEX_ERROR_MEMORY;
    if (s->common.status == CHOLMOD_TOO_LARGE)
        return OSDTEX_ERROR_LIMIT;
    return s->common.status == CHOLMOD_OK ? OSDTEX_OK : OSDTEX_ERROR_NUMERIC;
}

static void
start(otx_sparse *s)
{
    cholmod_start(&s->common);
    s->common.supernodal = CHOLMOD_SIMPLICIAL;
    s->common.print = 0;
    /* Minimum degree alone: the choice by trial would also try METIS, whose
     * time is several times that of the factorisation of a surface mesh. */
    s->common.nmethods = 1;
    s->common.method[0].ordering = CHOLMOD_AMD;
    s->common.postorder = 1;
    s->common.final_ll = 0;
}

static otx_status
check(int32_t size, const otx_sparse_entry *entries, int64_t count)
{
    if (size < 1 || count < 1)
        return OSDTEX_ERROR_ARGUMENT;
    if (count > INT32_MAX)
        return OSDTEX_ERROR_LIMIT;
    for (int64_t i = 0; i < count; ++i)
    {
        const otx_sparse_entry *e = &entries[i];

        if (e->column < 0 || e->row < e->column || e->row >= size)
            return OSDTEX_ERROR_ARGUMENT;
        if (!isfinite(e->re) || !isfinite(e->im))
            return OSDTEX_ERROR_NUMERIC;
    }
    return OSDTEX_OK;
}

/* The lower triangle as CHOLMOD's columns; NULL on failure. */
static cholmod_sparse *
assemble(otx_sparse *s, const otx_sparse_entry *entries, size_t count)
{
    const size_t n = (size_t)s->size, w = width(s);
    cholmod_triplet *t =
        cholmod_allocate_triplet(n, n, count, -1, xtype(s), &s->common);
    cholmod_sparse *a;

    if (!t)
        return NULL;
    for (size_t i = 0; i < count; ++i)
    {
        ((int *)t->i)[i] = entries[i].row;
        ((int *)t->j)[i] = entries[i].column;
        ((double *)t->x)[w * i] = entries[i].re;
        /* The diagonal of a Hermitian matrix is real. */
        if (w == 2)
            ((double *)t->x)[2 * i + 1] =
                entries[i].row == entries[i].column ? 0.0 : entries[i].im;
    }
    t->nnz = count;
    a = cholmod_triplet_to_sparse(t, count, &s->common);
    cholmod_free_triplet(&t, &s->common);
    return a;
}

/* LDL^H goes through where pivots are negative; D says so. */
static bool
is_positive(const otx_sparse *s)
{
    const double *x = s->factor->x;
    const int *column = s->factor->p;

    for (int32_t j = 0; j < s->size; ++j)
        if (!(x[width(s) * (size_t)column[j]] > 0.0))
            return false;
    return true;
}

/* Neighbours of all rows, both ways, from the columns of the lower triangle;
 * false when memory is out. */
static bool
list_neighbours(
    otx_arena *arena, const cholmod_sparse *a, int32_t **first,
    int32_t **neighbour)
{
    const int32_t n = (int32_t)a->ncol;
    const int *p = a->p, *row = a->i;
    int32_t *at = OTX_ZNEW(arena, int32_t, n + 2);
    int32_t *list = OTX_NEW(arena, int32_t, 2 * (int64_t)p[n]);

    *first = at;
    *neighbour = list;
    if (!at || !list)
        return false;
    /* Counted two places on, so that filling in leaves the starts behind. */
    for (int32_t j = 0; j < n; ++j)
        for (int32_t k = p[j]; k < p[j + 1]; ++k)
        {
            ++at[row[k] + 2];
            ++at[j + 2];
        }
    for (int32_t j = 2; j <= n + 1; ++j)
        at[j] += at[j - 1];
    for (int32_t j = 0; j < n; ++j)
        for (int32_t k = p[j]; k < p[j + 1]; ++k)
        {
            list[at[row[k] + 1]++] = j;
            list[at[j + 1]++] = row[k];
        }
    return true;
}

/* Orders by the places of the unknowns, and by minimum degree within what
 * they are cut into. */
static otx_status
analyse_placed(
    otx_sparse *s, otx_arena *scratch, cholmod_sparse *a,
    const otx_vec3 *places)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    int32_t *group = OTX_NEW(scratch, int32_t, s->size);
    int32_t *order = OTX_NEW(scratch, int32_t, s->size);
    int32_t *first, *neighbour;

    if (!group || !order || !list_neighbours(scratch, a, &first, &neighbour) ||
        !otx_dissect(scratch, s->size, places, first, neighbour, group))
        return OSDTEX_ERROR_MEMORY;
    if (cholmod_camd(a, NULL, 0, group, order, &s->common))
    {
        s->common.method[0].ordering = CHOLMOD_GIVEN;
        s->factor = cholmod_analyze_p(a, order, NULL, 0, &s->common);
    }
    otx_arena_release(scratch, mark);
    return status_of(s);
}

static otx_status
analyse(
    otx_sparse *s, otx_arena *scratch, cholmod_sparse *a,
    const otx_vec3 *places)
{
    if (places && s->size >= PLACED_MIN)
        return analyse_placed(s, scratch, a, places);
    s->factor = cholmod_analyze(a, &s->common);
    return status_of(s);
}

static otx_status
factor(
    otx_sparse *s, otx_arena *scratch, const otx_vec3 *places,
    const otx_sparse_entry *entries, size_t count)
{
    otx_status status;
    cholmod_sparse *a = assemble(s, entries, count);

    if (!a)
        return status_of(s);
    status = analyse(s, scratch, a, places);
    if (status == OSDTEX_OK)
        cholmod_factorize(a, s->factor, &s->common);
    cholmod_free_sparse(&a, &s->common);
    OTX_TRY(status);
    OTX_TRY(status_of(s));
    if (s->factor->minor < (size_t)s->size || !is_positive(s))
        return OSDTEX_ERROR_NUMERIC;
    s->b = cholmod_allocate_dense(
        (size_t)s->size, 1, (size_t)s->size, xtype(s), &s->common);
    return s->b ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

otx_status
otx_sparse_factor(
    otx_arena *arena, otx_sparse_kind kind, int32_t size,
    const otx_vec3 *places, const otx_sparse_entry *entries,
    int64_t entry_count, otx_sparse **out)
{
    otx_sparse *s;

    *out = NULL;
    OTX_TRY(check(size, entries, entry_count));
    s = OTX_ZNEW(arena, otx_sparse, 1);
    if (!s)
        return OSDTEX_ERROR_MEMORY;
    s->kind = kind;
    s->size = size;
    start(s);
    if (!otx_arena_defer(arena, destroy, s))
    {
        destroy(s);
        return OSDTEX_ERROR_MEMORY;
    }
    OTX_TRY(factor(s, arena, places, entries, (size_t)entry_count));
    *out = s;
    return OSDTEX_OK;
}

otx_status
otx_sparse_solve(otx_sparse *s, const double *b, double *x)
{
    const size_t bytes = (size_t)s->size * width(s) * sizeof *b;

    memcpy(s->b->x, b, bytes);
    if (!cholmod_solve2(
            CHOLMOD_A, s->factor, s->b, NULL, &s->x, NULL, &s->y, &s->e,
            &s->common))
        return status_of(s);
    memcpy(x, s->x->x, bytes);
    return OSDTEX_OK;
}

/* -- smallest eigenvector ------------------------------------------------- */

enum
{
    LANCZOS_MAX = 24,
    JACOBI_SWEEPS = 16
};

/* The basis that inverse iterations from one start span, orthonormal under M,
 * in which the inverse is tridiagonal. */
typedef struct lanczos
{
    otx_sparse *sparse;
    const double *mass;
    size_t length;                  /* doubles of a vector */
    double *basis[LANCZOS_MAX + 1]; /* each [length] */
    double diagonal[LANCZOS_MAX];   /* of the tridiagonal matrix */
    double beside[LANCZOS_MAX + 1]; /* [k] couples k - 1 and k */
    int32_t count;
} lanczos;

static double
mass_of(const lanczos *l, size_t i)
{
    return l->mass ? l->mass[i / width(l->sparse)] : 1.0;
}

/* x -= <q, x>_M q. Returns the real part of the product. */
static double
take_out(const lanczos *l, const double *q, double *x)
{
    const size_t w = width(l->sparse);
    double re = 0.0, im = 0.0;

    for (size_t i = 0; i < l->length; i += w)
    {
        const double m = mass_of(l, i);

        re += m * (w == 1 ? q[i] * x[i] : q[i] * x[i] + q[i + 1] * x[i + 1]);
        im += w == 1 ? 0.0 : m * (q[i] * x[i + 1] - q[i + 1] * x[i]);
    }
    for (size_t i = 0; i < l->length; i += w)
    {
        x[i] -= re * q[i];
        if (w == 1)
            continue;
        x[i] += im * q[i + 1];
        x[i + 1] -= re * q[i + 1] + im * q[i];
    }
    return re;
}

/* Scales x to length one under M; what its length was. */
static double
make_unit(const lanczos *l, double *x)
{
    double sum = 0.0;

    for (size_t i = 0; i < l->length; ++i)
        sum += mass_of(l, i) * x[i] * x[i];
    sum = sqrt(sum);
    for (size_t i = 0; sum > 0.0 && i < l->length; ++i)
        x[i] /= sum;
    return sum;
}

/* The next vector of the basis; `more` is false when there is none. */
static otx_status
extend(lanczos *l, bool *more)
{
    const int32_t k = l->count;
    double *next = l->basis[k + 1];

    for (size_t i = 0; i < l->length; ++i)
        next[i] = mass_of(l, i) * l->basis[k][i];
    OTX_TRY(otx_sparse_solve(l->sparse, next, next));
    l->diagonal[k] = take_out(l, l->basis[k], next);
    /* Against all, once more: rounding would bring the first ones back. */
    for (int32_t j = k; j >= 0; --j)
        take_out(l, l->basis[j], next);
    l->beside[k + 1] = make_unit(l, next);
    if (!isfinite(l->diagonal[k]) || !isfinite(l->beside[k + 1]))
        return OSDTEX_ERROR_NUMERIC;
    ++l->count;
    *more = l->beside[k + 1] > 1e-12 * l->diagonal[k];
    return OSDTEX_OK;
}

/* Rotates rows and columns p and q so that a[p][q] becomes 0 [Golub13, sec.
 * 8.5]; `v` collects the rotations. */
static void
rotate(
    double a[LANCZOS_MAX][LANCZOS_MAX], double v[LANCZOS_MAX][LANCZOS_MAX],
    int32_t n, int32_t p, int32_t q)
{
    const double tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double t = (tau < 0.0 ? -1.0 : 1.0) / (fabs(tau) + hypot(1.0, tau));
    const double c = 1.0 / hypot(1.0, t), s = c * t;

    for (int32_t i = 0; i < n; ++i)
    {
        const double x = a[i][p], y = a[i][q], z = v[i][p];

        a[i][p] = c * x - s * y;
        a[i][q] = s * x + c * y;
        v[i][p] = c * z - s * v[i][q];
        v[i][q] = s * z + c * v[i][q];
    }
    for (int32_t i = 0; i < n; ++i)
    {
        const double x = a[p][i], y = a[q][i];

        a[p][i] = c * x - s * y;
        a[q][i] = s * x + c * y;
    }
}

/* Coefficients of the eigenvector of the largest eigenvalue of the
 * tridiagonal matrix, the first not negative. */
static void
largest(const lanczos *l, double out[LANCZOS_MAX])
{
    double a[LANCZOS_MAX][LANCZOS_MAX] = {{0}}, v[LANCZOS_MAX][LANCZOS_MAX];
    const int32_t n = l->count;
    int32_t best = 0;

    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = 0; j < n; ++j)
        {
            a[i][j] = i == j       ? l->diagonal[i]
                      : i == j + 1 ? l->beside[i]
                      : j == i + 1 ? l->beside[j]
                                   : 0.0;
            v[i][j] = i == j;
        }
    for (int32_t sweep = 0; sweep < JACOBI_SWEEPS; ++sweep)
        for (int32_t p = 0; p < n; ++p)
            for (int32_t q = p + 1; q < n; ++q)
                if (a[p][q] != 0.0)
                    rotate(a, v, n, p, q);
    for (int32_t i = 1; i < n; ++i)
        if (a[i][i] > a[best][best])
            best = i;
    for (int32_t i = 0; i < n; ++i)
        out[i] = v[0][best] < 0.0 ? -v[i][best] : v[i][best];
}

otx_status
otx_sparse_smallest(
    otx_arena *scratch, otx_sparse *s, const double *mass, int32_t rounds,
    double *x)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    lanczos l = {
        .sparse = s, .mass = mass, .length = width(s) * (size_t)s->size};
    double share[LANCZOS_MAX];
    bool more = true;

    if (rounds > LANCZOS_MAX)
        rounds = LANCZOS_MAX;
    for (int32_t k = 0; k <= rounds; ++k)
    {
        l.basis[k] = OTX_NEW(scratch, double, (int64_t)l.length);
        if (!l.basis[k])
            return OSDTEX_ERROR_MEMORY;
    }
    memcpy(l.basis[0], x, l.length * sizeof *x);
    if (!(make_unit(&l, l.basis[0]) > 0.0))
        return OSDTEX_ERROR_NUMERIC;
    while (more && l.count < rounds)
        OTX_TRY(extend(&l, &more));
    largest(&l, share);
    memset(x, 0, l.length * sizeof *x);
    for (int32_t k = 0; k < l.count; ++k)
        for (size_t i = 0; i < l.length; ++i)
            x[i] += share[k] * l.basis[k][i];
    otx_arena_release(scratch, mark);
    return isfinite(make_unit(&l, x)) ? OSDTEX_OK : OSDTEX_ERROR_NUMERIC;
}

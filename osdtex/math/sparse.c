/* sparse.c -- sparse symmetric systems by Cholesky factors. */
#include "math/sparse.h"

#include <math.h>
#include <string.h>
#include <suitesparse/cholmod.h>

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

static otx_status
factor(otx_sparse *s, const otx_sparse_entry *entries, size_t count)
{
    cholmod_sparse *a = assemble(s, entries, count);

    if (!a)
        return status_of(s);
    s->factor = cholmod_analyze(a, &s->common);
    if (s->factor)
        cholmod_factorize(a, s->factor, &s->common);
    cholmod_free_sparse(&a, &s->common);
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
    const otx_sparse_entry *entries, int64_t entry_count, otx_sparse **out)
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
    OTX_TRY(factor(s, entries, (size_t)entry_count));
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

/* x M x, and x becomes M x. */
static double
weigh(const otx_sparse *s, const double *mass, double *x)
{
    const size_t w = width(s);
    double sum = 0.0;

    for (size_t i = 0; i < w * (size_t)s->size; ++i)
    {
        const double m = mass ? mass[i / w] : 1.0;

        sum += m * x[i] * x[i];
        x[i] *= m;
    }
    return sum;
}

otx_status
otx_sparse_smallest(
    otx_sparse *s, const double *mass, int32_t rounds, double *x)
{
    const size_t n = width(s) * (size_t)s->size;

    for (int32_t round = 0; round <= rounds; ++round)
    {
        double length;

        if (round > 0)
            OTX_TRY(otx_sparse_solve(s, x, x));
        length = sqrt(weigh(s, mass, x));
        if (!(length > 0.0) || !isfinite(length))
            return OSDTEX_ERROR_NUMERIC;
        for (size_t i = 0; i < n; ++i)
            x[i] /= length;
    }
    for (size_t i = 0; mass && i < n; ++i)
        x[i] /= mass[i / width(s)];
    return OSDTEX_OK;
}

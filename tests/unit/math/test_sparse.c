/* test_sparse.c -- factors against dense arithmetic and known spectra. */
#include "math/sparse.h"
#include "support.h"

#include "base/random.h"

#include <math.h>

enum
{
    N = 40
};

/* A random Hermitian, diagonally dominant matrix, twice: entries and dense. */
static int64_t
make(bool complex, otx_sparse_entry *entries, double dense[N][N][2])
{
    int64_t count = 0;

    memset(dense, 0, sizeof(double[N][N][2]));
    for (int32_t i = 0; i < N; ++i)
        for (int32_t j = 0; j <= i; ++j)
        {
            const uint64_t at = (uint64_t)(i * N + j);
            const double re = otx_random_unit(1, 0, at) - 0.5;
            const double im =
                complex && i != j ? otx_random_unit(1, 1, at) - 0.5 : 0.0;

            if (i != j && otx_random_unit(1, 2, at) > 0.2)
                continue;
            entries[count++] = (otx_sparse_entry){i, j, i == j ? 10.0 : re, im};
            dense[i][j][0] = dense[j][i][0] = i == j ? 10.0 : re;
            dense[i][j][1] = im;
            dense[j][i][1] = i == j ? 0.0 : -im;
        }
    return count;
}

static void
solves(bool complex)
{
    otx_run *run = test_run_create();
    static double dense[N][N][2];
    otx_sparse_entry entries[N * N];
    const int64_t count = make(complex, entries, dense);
    const int32_t w = complex ? 2 : 1;
    double b[2 * N], x[2 * N];
    otx_sparse *s;

    for (int32_t i = 0; i < w * N; ++i)
        b[i] = otx_random_unit(2, 0, (uint64_t)i);
    assert_int_equal(
        otx_sparse_factor(
            run->arena, complex ? OTX_SPARSE_COMPLEX : OTX_SPARSE_REAL, N, NULL,
            entries, count, &s),
        OSDTEX_OK);
    assert_int_equal(otx_sparse_solve(s, b, x), OSDTEX_OK);
    for (int32_t i = 0; i < N; ++i)
    {
        double re = -b[w * i], im = complex ? -b[w * i + 1] : 0.0;

        for (int32_t j = 0; j < N; ++j)
        {
            const double xr = x[w * j], xi = complex ? x[w * j + 1] : 0.0;

            re += dense[i][j][0] * xr - dense[i][j][1] * xi;
            im += dense[i][j][0] * xi + dense[i][j][1] * xr;
        }
        assert_true(fabs(re) < 1e-12 && fabs(im) < 1e-12);
    }
    test_run_destroy(run);
}

static void
solves_real(void **state)
{
    (void)state;
    solves(false);
}

static void
solves_complex(void **state)
{
    (void)state;
    solves(true);
}

/* The path graph's Laplacian: eigenvalue 2 - 2 cos(pi / (N + 1)), a sine. */
static void
finds_the_smallest_eigenvector(void **state)
{
    otx_run *run = test_run_create();
    otx_sparse_entry entries[2 * N];
    double x[N], length = sqrt((N + 1) / 2.0);
    int64_t count = 0;
    otx_sparse *s;

    (void)state;
    for (int32_t i = 0; i < N; ++i)
    {
        entries[count++] = (otx_sparse_entry){i, i, 2.0, 0.0};
        if (i > 0)
            entries[count++] = (otx_sparse_entry){i, i - 1, -1.0, 0.0};
        x[i] = 1.0;
    }
    assert_int_equal(
        otx_sparse_factor(
            run->arena, OTX_SPARSE_REAL, N, NULL, entries, count, &s),
        OSDTEX_OK);
    assert_int_equal(
        otx_sparse_smallest(run->scratch, s, NULL, 12, x), OSDTEX_OK);
    for (int32_t i = 0; i < N; ++i)
        assert_true(
            fabs(x[i] - sin(OTX_PI * (i + 1) / (N + 1)) / length) < 1e-9);
    test_run_destroy(run);
}

/* Ordering by places changes the time, not the solution. */
static void
places_change_nothing(void **state)
{
    enum
    {
        SIDE = 80,
        COUNT = SIDE * SIDE
    };
    otx_run *run = test_run_create();
    otx_sparse_entry *entries =
        OTX_NEW(run->arena, otx_sparse_entry, 3 * COUNT);
    otx_vec3 *places = OTX_NEW(run->arena, otx_vec3, COUNT);
    double *b = OTX_NEW(run->arena, double, COUNT);
    double *x[2];
    int64_t count = 0;

    (void)state;
    for (int32_t i = 0; i < COUNT; ++i)
    {
        places[i] = (otx_vec3){i % SIDE, i / SIDE, 0};
        b[i] = otx_random_unit(3, 0, (uint64_t)i);
        entries[count++] = (otx_sparse_entry){i, i, 4.1, 0.0};
        if (i % SIDE > 0)
            entries[count++] = (otx_sparse_entry){i, i - 1, -1.0, 0.0};
        if (i >= SIDE)
            entries[count++] = (otx_sparse_entry){i, i - SIDE, -1.0, 0.0};
    }
    for (int k = 0; k < 2; ++k)
    {
        otx_sparse *s;

        x[k] = OTX_NEW(run->arena, double, COUNT);
        assert_int_equal(
            otx_sparse_factor(
                run->arena, OTX_SPARSE_REAL, COUNT, k == 0 ? places : NULL,
                entries, count, &s),
            OSDTEX_OK);
        assert_int_equal(otx_sparse_solve(s, b, x[k]), OSDTEX_OK);
    }
    for (int32_t i = 0; i < COUNT; ++i)
        assert_true(fabs(x[0][i] - x[1][i]) < 1e-10);
    test_run_destroy(run);
}

static void
refuses_bad_entries(void **state)
{
    otx_run *run = test_run_create();
    const otx_sparse_entry above = {0, 1, 1.0, 0.0};
    const otx_sparse_entry outside = {2, 0, 1.0, 0.0};
    const otx_sparse_entry nan = {0, 0, NAN, 0.0};
    const otx_sparse_entry negative[2] = {{0, 0, 1, 0}, {1, 1, -1, 0}};
    otx_sparse *s;

    (void)state;
    assert_int_equal(
        otx_sparse_factor(run->arena, OTX_SPARSE_REAL, 2, NULL, &above, 1, &s),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        otx_sparse_factor(
            run->arena, OTX_SPARSE_REAL, 2, NULL, &outside, 1, &s),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        otx_sparse_factor(run->arena, OTX_SPARSE_REAL, 1, NULL, &nan, 1, &s),
        OSDTEX_ERROR_NUMERIC);
    /* LDL' exists, but the matrix is not positive definite. */
    assert_int_equal(
        otx_sparse_factor(
            run->arena, OTX_SPARSE_REAL, 2, NULL, negative, 2, &s),
        OSDTEX_ERROR_NUMERIC);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_real),
        cmocka_unit_test(solves_complex),
        cmocka_unit_test(finds_the_smallest_eigenvector),
        cmocka_unit_test(places_change_nothing),
        cmocka_unit_test(refuses_bad_entries),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

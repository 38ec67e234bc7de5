/* sparse.h -- sparse symmetric systems by Cholesky factors.
 *
 * A thin shell over CHOLMOD's simplicial LDL^H [Chen08]: entries in, factor
 * once, solve many times. Matrices are Hermitian, given by their lower
 * triangle; real ones are the same with imaginary parts that are not read.
 *
 * Only the simplicial code is used: the supernodal code has another licence.
 * It runs in one thread, and its result depends on its input alone. Factors
 * are made and used in any one thread at a time; several may be at work at
 * once. Their memory is CHOLMOD's own and does not count in the allocator.
 *
 * [Chen08] Chen, Davis, Hager, Rajamanickam: Algorithm 887: CHOLMOD. TOMS 35.
 * [Lanczos50] Lanczos: An iteration method for the solution of the eigenvalue
 * problem. J. Res. Nat. Bur. Standards 45.
 * [Golub13] Golub, Van Loan: Matrix computations, 4th edition.
 */
#ifndef OTX_MATH_SPARSE_H
#define OTX_MATH_SPARSE_H

#include "base/run.h"
#include "math/vec.h"

typedef enum otx_sparse_kind
{
    OTX_SPARSE_REAL,
    OTX_SPARSE_COMPLEX /* vectors hold pairs (re, im) */
} otx_sparse_kind;

/* An entry of the lower triangle: row >= column. Equal places add up. */
typedef struct otx_sparse_entry
{
    int32_t row, column;
    double re, im;
} otx_sparse_entry;

typedef struct otx_sparse otx_sparse;

/* Factors the positive definite matrix of `size` rows that the entries make
 * up. Lives in `arena` and is destroyed with it. May run in a thread of the
 * pool: reports nothing.
 *
 *   places  [size] where the unknowns lie, by which large systems of surfaces
 *           are ordered; NULL: unknown
 *
 * ARGUMENT for an entry out of place, NUMERIC when the matrix is not positive
 * definite or a value is not finite, LIMIT past 2^31 entries, MEMORY. */
otx_status otx_sparse_factor(
    otx_arena *arena, otx_sparse_kind kind, int32_t size,
    const otx_vec3 *places, const otx_sparse_entry *entries,
    int64_t entry_count, otx_sparse **out);

/* Solves A x = b. The vectors have `size` numbers (pairs when complex) and may
 * be the same. MEMORY. */
otx_status otx_sparse_solve(otx_sparse *sparse, const double *b, double *x);

/* Turns x into the generalised eigenvector A x = l M x of the smallest
 * eigenvalue, |x|_M = 1, as far as the space that `rounds` inverse iterations
 * from x span holds it [Lanczos50]: a dozen rounds do what took a hundred
 * iterations. Among equal eigenvalues the one nearest the start is found.
 *
 *   scratch  rounds + 1 vectors, given back
 *   mass     [size] diagonal of M, > 0; NULL: ones
 *   rounds   1 .. 24
 *   x        in: the start, not zero */
otx_status otx_sparse_smallest(
    otx_arena *scratch, otx_sparse *sparse, const double *mass, int32_t rounds,
    double *x);

#endif

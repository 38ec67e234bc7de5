/* elastic_system.c -- the normal equations of a round, and their solution.
 *
 * A seam couples the ends of its two sides, eight numbers in all; its normal
 * matrix is summed once a round and applied as one block, so that a step of
 * conjugate gradients costs the same however finely the seam was sampled. */
#include "relax/elastic_state.h"

#include "base/csr.h"

#include <string.h>

enum
{
    CG_ROUNDS = 15
};

/* Steps are shortened anyway: 30 rounds to 1e-3 left seams 0.2 % lower. */
static const double CG_TOLERANCE = 1e-2;
static const double DAMPING = 1e-2; /* of the diagonal */

/* Normal equations of one seam: unknowns a0 a1 b0 b1, x and y of each. */
typedef struct seam_block
{
    double h[8][8]; /* upper triangle */
    double g[8];
} seam_block;

/* ---- what seams add ---- */

static otx_seam_side
side_of(const otx_elastic_view *from, const otx_vec2 *at, const int32_t ends[2])
{
    const otx_exemplar *e = from->exemplar;

    return (otx_seam_side){
        otx_view_of(from->image, e->wrap_x, e->wrap_y),
        {(double)from->image->width / e->match.width,
         (double)from->image->height / e->match.height},
        {at[ends[0]], at[ends[1]]}};
}

otx_elastic_flanks
otx_elastic_flanks_of(const otx_elastic *e, const otx_sheet_seam *seam)
{
    const otx_elastic_view *a =
        &e->pictures.views[e->pictures.source[seam->a[0]]];
    const otx_elastic_view *b =
        &e->pictures.views[e->pictures.source[seam->b[0]]];
    const double sa = a->exemplar->match_sigma, sb = b->exemplar->match_sigma;
    const double sq = a == b ? sa * sa : 0.5 * (sa * sa + sb * sb);

    return (otx_elastic_flanks){
        side_of(a, e->sheet.at, seam->a), side_of(b, e->sheet.at, seam->b),
        sq > 0.0 ? 1.0 / sq : 0.0};
}

/* Adds one residual with its row of the Jacobian, to the upper triangle. */
static void
add_row(seam_block *block, const double row[8], double residual, double weight)
{
    for (int i = 0; i < 8; ++i)
    {
        block->g[i] += weight * row[i] * residual;
        for (int j = i; j < 8; ++j)
            block->h[i][j] += weight * row[i] * row[j];
    }
}

static void
add_samples(const otx_elastic *e, const otx_sheet_seam *seam, seam_block *block)
{
    const int32_t n = otx_seam_sample_count(seam->length);
    const otx_elastic_flanks by = otx_elastic_flanks_of(e, seam);
    const double weight = by.weight * seam->length / n;

    for (int32_t i = 0; i < n; ++i)
    {
        const double t = (i + 0.5) / n;
        double a[3], b[3];
        otx_vec2 da[3], db[3];

        otx_difference_look(&by.a, t, a, da);
        otx_difference_look(&by.b, t, b, db);
        for (int c = 0; c < 3; ++c)
        {
            const double row[8] = {(1.0 - t) * da[c].x,  (1.0 - t) * da[c].y,
                                   t * da[c].x,          t * da[c].y,
                                   -(1.0 - t) * db[c].x, -(1.0 - t) * db[c].y,
                                   -t * db[c].x,         -t * db[c].y};

            add_row(block, row, a[c] - b[c], weight);
        }
    }
}

static void
linearise(otx_elastic *e, int64_t index)
{
    seam_block block = {0};

    add_samples(e, &e->sheet.seams[index], &block);
    for (int end = 0; end < 4; ++end)
    {
        const int32_t at = e->ends.of[4 * index + end];
        const int x = 2 * end, y = x + 1;

        e->ends.shares[at] = (otx_elastic_share){
            {block.g[x], block.g[y]}, {block.h[x][x], block.h[y][y]}};
        for (int i = x; i <= y; ++i)
            for (int j = 0; j < 8; ++j)
                e->ends.items[at].row[i - x][j] =
                    (float)(i < j ? block.h[i][j] : block.h[j][i]);
    }
}

static otx_status
linearise_seams(void *context, int64_t index, otx_worker *worker)
{
    otx_elastic *e = context;
    const int64_t first = index * OTX_ELASTIC_SEAMS;
    const int64_t end = first + OTX_ELASTIC_SEAMS;

    (void)worker;
    for (int64_t i = first; i < end && i < e->sheet.seam_count; ++i)
        linearise(e, i);
    return OSDTEX_OK;
}

/* ---- the linear system ---- */

/* Makes the equations of what may not move 0 = 0. */
static void
hold_rim(const otx_sheet *s, int32_t first, int32_t end, otx_vec2 *out)
{
    for (int32_t v = first; v < end; ++v)
        if (s->fixed[v])
            out[v] = (otx_vec2){0.0, 0.0};
}

static otx_vec2
end_product(const otx_elastic_end *end, const otx_vec2 *x)
{
    otx_vec2 sum = {0.0, 0.0};

    for (int i = 0; i < 4; ++i)
    {
        const otx_vec2 p = x[end->v[i]];

        sum.x += (double)end->row[0][2 * i] * p.x +
                 (double)end->row[0][2 * i + 1] * p.y;
        sum.y += (double)end->row[1][2 * i] * p.x +
                 (double)end->row[1][2 * i + 1] * p.y;
    }
    return sum;
}

static void
apply(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    const otx_elastic *e = context;
    const double stiffness = e->options->stiffness;

    otx_rigid_apply(&e->sheet.rigid, x, first, end, out);
    for (int32_t v = first; v < end; ++v)
    {
        otx_vec2 sum = {
            stiffness * out[v].x + DAMPING * e->system.diagonal[v].x * x[v].x,
            stiffness * out[v].y + DAMPING * e->system.diagonal[v].y * x[v].y};

        for (int32_t i = e->ends.first[v]; i < e->ends.first[v + 1]; ++i)
            sum = otx_vec2_add(sum, end_product(&e->ends.items[i], x));
        out[v] = sum;
    }
    hold_rim(&e->sheet, first, end, out);
}

static otx_status
prepare_rows(void *context, int64_t index, otx_worker *worker)
{
    otx_elastic *e = context;
    const otx_sheet *s = &e->sheet;
    const double stiffness = e->options->stiffness;
    const int32_t first = (int32_t)index * OTX_ELASTIC_ROWS;
    const int32_t end =
        otx_elastic_block_end(first, OTX_ELASTIC_ROWS, s->count);

    (void)worker;
    for (int32_t v = first; v < end; ++v)
    {
        const double d = stiffness * s->rigid.diagonal[v] + 1e-9;
        otx_vec2 b = otx_vec2_scale(
            stiffness, otx_vec2_sub(e->system.b[v], e->system.step[v]));
        otx_vec2 diagonal = {d, d};

        for (int32_t i = e->ends.first[v]; i < e->ends.first[v + 1]; ++i)
        {
            b = otx_vec2_sub(b, e->ends.shares[i].g);
            diagonal = otx_vec2_add(diagonal, e->ends.shares[i].diagonal);
        }
        e->system.b[v] = b;
        e->system.diagonal[v] = diagonal;
    }
    hold_rim(s, first, end, e->system.b);
    return OSDTEX_OK;
}

/* Right-hand side stiffness (b - L u) - J^T r, and the diagonal. Pulls and
 * products are those that the energy was measured with. */
static void
prepare_system(otx_elastic *e)
{
    otx_elastic_over_blocks(e, e->sheet.count, OTX_ELASTIC_ROWS, prepare_rows);
}

otx_status
otx_elastic_find_step(otx_elastic *e, otx_vec2 **step)
{
    const otx_sheet *s = &e->sheet;
    const int64_t tasks =
        (s->seam_count + OTX_ELASTIC_SEAMS - 1) / OTX_ELASTIC_SEAMS;
    const otx_rigid_system system = {
        .count = s->count,
        .apply = apply,
        .context = e,
        .diagonal = e->system.diagonal,
        .rounds = CG_ROUNDS,
        .tolerance = CG_TOLERANCE,
        .pool = e->run->pool};

    OTX_TRY(otx_pool_for(e->run->pool, tasks, linearise_seams, e));
    prepare_system(e);
    *step = OTX_ZNEW(e->run->scratch, otx_vec2, s->count);
    OTX_TRY(otx_run_ok(e->run));
    return otx_loop_result(
        e->run, "relax",
        otx_rigid_solve(e->run->scratch, &system, e->system.b, *step));
}

/* ---- which seams end where ---- */

void
otx_elastic_list_ends(otx_elastic *e)
{
    const otx_sheet *s = &e->sheet;
    int32_t v[4];

    for (int32_t i = 0; i < s->seam_count; ++i)
    {
        otx_elastic_variables(&s->seams[i], v);
        for (int k = 0; k < 4; ++k)
            otx_csr_count(e->ends.first, v[k], 1);
    }
    otx_csr_sum(e->ends.first, s->count);
    for (int32_t i = 0; i < s->seam_count; ++i)
    {
        otx_elastic_variables(&s->seams[i], v);
        for (int k = 0; k < 4; ++k)
        {
            const int32_t at = otx_csr_place(e->ends.first, v[k]);

            e->ends.of[4 * (int64_t)i + k] = at;
            memcpy(e->ends.items[at].v, v, sizeof v);
        }
    }
}

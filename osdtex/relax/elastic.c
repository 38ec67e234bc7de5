/* elastic.c -- Gauss-Newton on seams and sheets.
 *
 * A seam couples the ends of its two sides, eight numbers in all; its normal
 * matrix is summed once a round and applied as one block, so that a step of
 * conjugate gradients costs the same however finely the seam was sampled. */
#include "relax/elastic.h"

#include "flatten/stretch.h"
#include "image/pyramid.h"
#include "relax/sheet.h"
#include "surface/distance.h"

#include <string.h>

enum
{
    CG_ROUNDS = 15,
    SEAMS_PER_TASK = 256,
    FACES_PER_TASK = 1024,
    ROWS_PER_TASK = 2048,
    TAKE_BACK_ROUNDS = 64
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

/* What one end of a seam adds to its variable's right-hand side (taken away)
 * and diagonal. */
typedef struct seam_share
{
    otx_vec2 g, diagonal;
} seam_share;

/* The rows of one end of a seam, and the variables that they are applied to.
 * Ends lie in the order of their own variables, so that a product reads memory
 * from front to back. */
typedef struct seam_end
{
    float row[2][8];
    int32_t v[4];
} seam_end;

/* An exemplar at the level of its pyramid that is worked on. */
typedef struct view
{
    const otx_exemplar *exemplar;
    const otx_image *image;
} view;

typedef struct elastic
{
    otx_run *run;
    const otx_surface *surface;
    const otx_exemplar *exemplars;
    int32_t exemplar_count;
    const otx_elastic_options *options;
    otx_sheet sheet;
    otx_rigid_fans fans;
    uint8_t *source; /* [count] the exemplar of each variable */
    otx_pyramid *pyramids;
    view *views;
    double *energies;   /* [seam_count] */
    int32_t *end_first; /* [count + 1] offsets into ends */
    seam_end *ends;
    seam_share *shares; /* like ends */
    int32_t *end_at;    /* [4 * seam_count] where each end of a seam lies */
    otx_vec2 *step, *b, *diagonal, *moved;
    double *terms;   /* [count] of the rigid energy */
    double energy;   /* before the round */
    uint8_t *held;   /* variables taken back this round */
    double *sigma;   /* [face_count] badness of each face before the round */
    double *badness; /* [face_count] and now */
} elastic;

/* -- colours and their gradients ----------------------------------------- */

static int32_t
fold(int32_t i, int32_t n, bool wrap)
{
    if (i >= 0 && i < n)
        return i;
    if (wrap)
    {
        i %= n;
        return i < 0 ? i + n : i;
    }
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

/* Bilinear colour and its derivative by the texel position at full
 * resolution. */
static void
sample(const view *from, otx_vec2 texel, double color[3], otx_vec2 slope[3])
{
    const otx_exemplar *e = from->exemplar;
    const otx_image *image = from->image;
    const double sx = (double)image->width / e->match.width;
    const double sy = (double)image->height / e->match.height;
    const double x = texel.x * sx - 0.5, y = texel.y * sy - 0.5;
    const double fx = floor(x), fy = floor(y);
    const double u = x - fx, v = y - fy;
    const int32_t x0 = fold((int32_t)fx, image->width, e->wrap_x);
    const int32_t x1 = fold((int32_t)fx + 1, image->width, e->wrap_x);
    const int32_t y0 = fold((int32_t)fy, image->height, e->wrap_y);
    const int32_t y1 = fold((int32_t)fy + 1, image->height, e->wrap_y);
    const float *p00 = otx_image_at(image, x0, y0);
    const float *p10 = otx_image_at(image, x1, y0);
    const float *p01 = otx_image_at(image, x0, y1);
    const float *p11 = otx_image_at(image, x1, y1);

    for (int c = 0; c < 3; ++c)
    {
        const double low = p00[c] + u * (p10[c] - p00[c]);
        const double high = p01[c] + u * (p11[c] - p01[c]);

        color[c] = low + v * (high - low);
        slope[c].x =
            sx * ((1.0 - v) * (p10[c] - p00[c]) + v * (p11[c] - p01[c]));
        slope[c].y = sy * (high - low);
    }
}

static int32_t
sample_count(double length)
{
    const int32_t n = (int32_t)ceil(length);

    return n < 2 ? 2 : n;
}

/* What the two sides of a seam show. */
typedef struct flanks
{
    const view *a, *b;
    double weight; /* 1 / sigma^2, of the mean of both sides' sigma^2 */
} flanks;

static flanks
flanks_of(const elastic *e, const otx_sheet_seam *seam)
{
    const view *a = &e->views[e->source[seam->a[0]]];
    const view *b = &e->views[e->source[seam->b[0]]];
    const double sa = a->exemplar->match_sigma, sb = b->exemplar->match_sigma;
    const double sq = a == b ? sa * sa : 0.5 * (sa * sa + sb * sb);

    return (flanks){a, b, sq > 0.0 ? 1.0 / sq : 0.0};
}

/* Squared colour difference along a seam, per texel of length. */
static double
seam_energy(const elastic *e, const otx_sheet_seam *seam, const otx_vec2 *at)
{
    const int32_t n = sample_count(seam->length);
    const flanks by = flanks_of(e, seam);
    double sum = 0.0;

    for (int32_t i = 0; i < n; ++i)
    {
        const double t = (i + 0.5) / n;
        double a[3], b[3];
        otx_vec2 unused[3];

        sample(
            by.a, otx_vec2_lerp(at[seam->a[0]], at[seam->a[1]], t), a, unused);
        sample(
            by.b, otx_vec2_lerp(at[seam->b[0]], at[seam->b[1]], t), b, unused);
        for (int c = 0; c < 3; ++c)
            sum += (a[c] - b[c]) * (a[c] - b[c]);
    }
    return sum * by.weight * seam->length / n;
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
add_samples(const elastic *e, const otx_sheet_seam *seam, seam_block *block)
{
    const otx_vec2 *at = e->sheet.at;
    const int32_t n = sample_count(seam->length);
    const flanks by = flanks_of(e, seam);
    const double weight = by.weight * seam->length / n;

    for (int32_t i = 0; i < n; ++i)
    {
        const double t = (i + 0.5) / n;
        double a[3], b[3];
        otx_vec2 da[3], db[3];

        sample(by.a, otx_vec2_lerp(at[seam->a[0]], at[seam->a[1]], t), a, da);
        sample(by.b, otx_vec2_lerp(at[seam->b[0]], at[seam->b[1]], t), b, db);
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
linearise(elastic *e, int64_t index)
{
    seam_block block = {0};

    add_samples(e, &e->sheet.seams[index], &block);
    for (int end = 0; end < 4; ++end)
    {
        const int32_t at = e->end_at[4 * index + end];
        const int x = 2 * end, y = x + 1;

        e->shares[at] = (seam_share){
            {block.g[x], block.g[y]}, {block.h[x][x], block.h[y][y]}};
        for (int i = x; i <= y; ++i)
            for (int j = 0; j < 8; ++j)
                e->ends[at].row[i - x][j] =
                    (float)(i < j ? block.h[i][j] : block.h[j][i]);
    }
}

static otx_status
linearise_seams(void *context, int64_t index, otx_worker *worker)
{
    elastic *e = context;
    const int64_t first = index * SEAMS_PER_TASK;
    const int64_t end = first + SEAMS_PER_TASK;

    (void)worker;
    for (int64_t i = first; i < end && i < e->sheet.seam_count; ++i)
        linearise(e, i);
    return OSDTEX_OK;
}

static otx_status
measure_seams(void *context, int64_t index, otx_worker *worker)
{
    const elastic *e = context;
    const int64_t first = index * SEAMS_PER_TASK;
    const int64_t end = first + SEAMS_PER_TASK;

    (void)worker;
    for (int64_t i = first; i < end && i < e->sheet.seam_count; ++i)
        e->energies[i] = seam_energy(e, &e->sheet.seams[i], e->sheet.at);
    return OSDTEX_OK;
}

/* Sum over the seams, in order. */
static otx_status
total_seam_energy(elastic *e, double *out)
{
    const int64_t tasks =
        (e->sheet.seam_count + SEAMS_PER_TASK - 1) / SEAMS_PER_TASK;

    OTX_TRY(otx_pool_for(e->run->pool, tasks, measure_seams, e));
    *out = 0.0;
    for (int32_t i = 0; i < e->sheet.seam_count; ++i)
        *out += e->energies[i];
    return OSDTEX_OK;
}

/* -- rigidity ------------------------------------------------------------ */

/* Runs a body over blocks of `size` of `count`. Bodies do not fail. */
static void
over_blocks(elastic *e, int32_t count, int32_t size, otx_pool_body body)
{
    otx_pool_for(e->run->pool, ((int64_t)count + size - 1) / size, body, e);
}

static int32_t
block_end(int64_t first, int32_t size, int32_t count)
{
    return first + size < count ? (int32_t)first + size : count;
}

static otx_status
turn_faces(void *context, int64_t index, otx_worker *worker)
{
    elastic *e = context;
    const otx_rigid *rigid = &e->sheet.rigid;
    const int64_t first = index * FACES_PER_TASK;

    (void)worker;
    otx_rigid_fans_turn(
        rigid, e->sheet.at, (int32_t)first,
        block_end(first, FACES_PER_TASK, rigid->triangle_count), &e->fans);
    return OSDTEX_OK;
}

/* Pulls into b, products with the Laplacian into step. */
static otx_status
measure_rows(void *context, int64_t index, otx_worker *worker)
{
    elastic *e = context;
    const int32_t first = (int32_t)index * ROWS_PER_TASK;
    const int32_t end = block_end(first, ROWS_PER_TASK, e->sheet.count);

    (void)worker;
    otx_rigid_fans_pull(&e->sheet.rigid, &e->fans, first, end, e->b);
    otx_rigid_apply(&e->sheet.rigid, e->sheet.at, first, end, e->step);
    for (int32_t v = first; v < end; ++v)
        e->terms[v] = otx_vec2_dot(
            e->sheet.at[v],
            otx_vec2_sub(e->step[v], otx_vec2_scale(2.0, e->b[v])));
    return OSDTEX_OK;
}

/* Of the seams, and sum of u . (L u - 2 b) up to a constant that depends only
 * on the surface, with the best rotations. */
static otx_status
total_energy(elastic *e, double *out)
{
    double sum = 0.0;

    OTX_TRY(total_seam_energy(e, out));
    over_blocks(e, e->sheet.rigid.triangle_count, FACES_PER_TASK, turn_faces);
    over_blocks(e, e->sheet.count, ROWS_PER_TASK, measure_rows);
    for (int32_t v = 0; v < e->sheet.count; ++v)
        sum += e->terms[v];
    *out += e->options->stiffness * sum;
    return OSDTEX_OK;
}

/* -- the linear system --------------------------------------------------- */

static void
seam_variables(const otx_sheet_seam *seam, int32_t v[4])
{
    v[0] = seam->a[0];
    v[1] = seam->a[1];
    v[2] = seam->b[0];
    v[3] = seam->b[1];
}

/* Makes the equations of what may not move 0 = 0. */
static void
hold_rim(const otx_sheet *s, int32_t first, int32_t end, otx_vec2 *out)
{
    for (int32_t v = first; v < end; ++v)
        if (s->fixed[v])
            out[v] = (otx_vec2){0.0, 0.0};
}

static otx_vec2
end_product(const seam_end *end, const otx_vec2 *x)
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
    const elastic *e = context;
    const double stiffness = e->options->stiffness;

    otx_rigid_apply(&e->sheet.rigid, x, first, end, out);
    for (int32_t v = first; v < end; ++v)
    {
        otx_vec2 sum = {
            stiffness * out[v].x + DAMPING * e->diagonal[v].x * x[v].x,
            stiffness * out[v].y + DAMPING * e->diagonal[v].y * x[v].y};

        for (int32_t i = e->end_first[v]; i < e->end_first[v + 1]; ++i)
            sum = otx_vec2_add(sum, end_product(&e->ends[i], x));
        out[v] = sum;
    }
    hold_rim(&e->sheet, first, end, out);
}

static otx_status
prepare_rows(void *context, int64_t index, otx_worker *worker)
{
    elastic *e = context;
    const otx_sheet *s = &e->sheet;
    const double stiffness = e->options->stiffness;
    const int32_t first = (int32_t)index * ROWS_PER_TASK;
    const int32_t end = block_end(first, ROWS_PER_TASK, s->count);

    (void)worker;
    for (int32_t v = first; v < end; ++v)
    {
        const double d = stiffness * s->rigid.diagonal[v] + 1e-9;
        otx_vec2 b =
            otx_vec2_scale(stiffness, otx_vec2_sub(e->b[v], e->step[v]));
        otx_vec2 diagonal = {d, d};

        for (int32_t i = e->end_first[v]; i < e->end_first[v + 1]; ++i)
        {
            b = otx_vec2_sub(b, e->shares[i].g);
            diagonal = otx_vec2_add(diagonal, e->shares[i].diagonal);
        }
        e->b[v] = b;
        e->diagonal[v] = diagonal;
    }
    hold_rim(s, first, end, e->b);
    return OSDTEX_OK;
}

/* Right-hand side stiffness (b - L u) - J^T r, and the diagonal. Pulls and
 * products are those that the energy was measured with. */
static void
prepare_system(elastic *e)
{
    over_blocks(e, e->sheet.count, ROWS_PER_TASK, prepare_rows);
}

/* -- steps that are allowed ---------------------------------------------- */

/* The larger of stretch and its inverse over the fan of a face; INFINITY when
 * a triangle of it is flipped. */
static double
face_badness(const elastic *e, int32_t face)
{
    const otx_sheet *s = &e->sheet;
    const int32_t first = s->first[face];
    double worst = 1.0;

    for (int32_t c = first + 1; c + 1 < s->first[face + 1]; ++c)
    {
        const int32_t v[3] = {
            s->corners[first], s->corners[c], s->corners[c + 1]};
        const int32_t leaf[3] = {
            s->verts[v[0]], s->verts[v[1]], s->verts[v[2]]};
        const double texels =
            e->options->texels * otx_surface_density(e->surface, leaf, 3);
        otx_vec3 p[3];
        otx_vec2 uv[3];
        double sigma[2];

        for (int i = 0; i < 3; ++i)
        {
            p[i] = otx_vec3_scale(
                texels, otx_vec3_load(e->surface->points, leaf[i]));
            uv[i] = s->at[v[i]];
        }
        otx_stretch_singular(p, uv, sigma);
        worst = sigma[1] > 0.0 ? fmax(worst, fmax(sigma[0], 1.0 / sigma[1]))
                               : INFINITY;
    }
    return worst;
}

/* Whether a variable of the face was taken back in the last round. */
static bool
was_touched(const elastic *e, int32_t face, int32_t round)
{
    const otx_sheet *s = &e->sheet;

    for (int32_t c = s->first[face]; c < s->first[face + 1]; ++c)
        if (e->held[s->corners[c]] == round)
            return true;
    return false;
}

typedef struct judgement
{
    elastic *e;
    int32_t round; /* 0: all faces, else those that the round touched */
    double *out;   /* [face_count] */
} judgement;

static otx_status
judge_faces(void *context, int64_t index, otx_worker *worker)
{
    const judgement *j = context;
    const int64_t first = index * FACES_PER_TASK;
    const int64_t end = first + FACES_PER_TASK;

    (void)worker;
    for (int64_t f = first; f < end && f < j->e->sheet.face_count; ++f)
        if (j->round == 0 || was_touched(j->e, (int32_t)f, j->round))
            j->out[f] = face_badness(j->e, (int32_t)f);
    return OSDTEX_OK;
}

static otx_status
judge(elastic *e, int32_t round, double *out)
{
    judgement j = {e, round, out};

    return otx_pool_for(
        e->run->pool,
        (e->sheet.face_count + FACES_PER_TASK - 1) / FACES_PER_TASK,
        judge_faces, &j);
}

/* Takes back the variables of the faces that the step made worse than the
 * limit; how many. */
static int64_t
take_back_once(elastic *e, int32_t round)
{
    otx_sheet *s = &e->sheet;
    int64_t refused = 0;

    for (int32_t f = 0; f < s->face_count; ++f)
    {
        if (e->badness[f] <= e->options->stretch ||
            e->badness[f] <= e->sigma[f])
            continue;
        for (int32_t c = s->first[f]; c < s->first[f + 1]; ++c)
        {
            const int32_t v = s->corners[c];

            if (e->held[v])
                continue;
            e->held[v] = (uint8_t)round;
            s->at[v] = e->moved[v];
            ++refused;
        }
    }
    return refused;
}

/* Taking back may spoil a neighbour, so it is repeated; after the last round
 * everything is taken back, and the state is the one before. */
static otx_status
take_back(elastic *e, int64_t *refused)
{
    otx_sheet *s = &e->sheet;

    for (int32_t round = 1; round <= TAKE_BACK_ROUNDS; ++round)
    {
        int64_t now;

        OTX_TRY(judge(e, round - 1, e->badness));
        now = take_back_once(e, round);
        *refused += now;
        if (now == 0)
            return OSDTEX_OK;
    }
    memcpy(s->at, e->moved, (size_t)s->count * sizeof *s->at);
    return OSDTEX_OK;
}

static double
inside(double x, bool wrap, double size)
{
    return wrap ? x : fmin(fmax(x, 0.5), size - 0.5);
}

/* Moves by `share` of the step, from `moved` (the state before). */
static otx_status
move(elastic *e, double share, double longest, int64_t *refused)
{
    otx_sheet *s = &e->sheet;

    memset(e->held, 0, (size_t)s->count);
    for (int32_t v = 0; v < s->count; ++v)
    {
        const otx_exemplar *from = &e->exemplars[e->source[v]];
        const double length = otx_vec2_length(e->step[v]);
        const double scale =
            length > longest ? share * longest / length : share;
        const otx_vec2 p =
            otx_vec2_add(e->moved[v], otx_vec2_scale(scale, e->step[v]));

        s->at[v].x = inside(p.x, from->wrap_x, from->match.width);
        s->at[v].y = inside(p.y, from->wrap_y, from->match.height);
    }
    return take_back(e, refused);
}

/* One Gauss-Newton step, halved until the energy falls; left out when it does
 * not. The energy and the badness of faces are known, and are again when the
 * step was taken. */
static otx_status
round_of(elastic *e, int32_t level, bool *improved, otx_elastic_stats *stats)
{
    otx_sheet *s = &e->sheet;
    const otx_arena_mark mark = otx_arena_here(e->run->scratch);
    const int64_t tasks = (s->seam_count + SEAMS_PER_TASK - 1) / SEAMS_PER_TASK;
    const otx_rigid_system system = {
        s->count, apply, e, e->diagonal, CG_ROUNDS, CG_TOLERANCE, e->run->pool};
    double *badness = e->badness;
    double after, share = 1.0;
    otx_vec2 *step;

    OTX_TRY(otx_pool_for(e->run->pool, tasks, linearise_seams, e));
    prepare_system(e);
    step = OTX_ZNEW(e->run->scratch, otx_vec2, s->count);
    if (!step)
        return otx_fail_memory(e->run, "relax");
    if (otx_rigid_solve(e->run->scratch, &system, e->b, step) != OSDTEX_OK)
        return otx_fail_memory(e->run, "relax");
    memcpy(e->moved, s->at, (size_t)s->count * sizeof *s->at);
    e->badness = e->sigma;
    e->sigma = badness;
    *improved = false;
    for (int32_t attempt = 0; attempt < 4 && !*improved; ++attempt)
    {
        memcpy(e->step, step, (size_t)s->count * sizeof *step);
        OTX_TRY(move(e, share, 2.0 * (1 << level), &stats->refused));
        OTX_TRY(total_energy(e, &after));
        *improved = after < e->energy;
        share *= 0.5;
    }
    if (!*improved)
        memcpy(s->at, e->moved, (size_t)s->count * sizeof *s->at);
    else
    {
        e->energy = after;
        ++stats->rounds;
    }
    otx_arena_release(e->run->scratch, mark);
    return OSDTEX_OK;
}

/* Puts all exemplars to a level of their pyramids, or to their last one. */
static void
look_at(elastic *e, int32_t level)
{
    for (int32_t k = 0; k < e->exemplar_count; ++k)
    {
        const otx_pyramid *p = &e->pyramids[k];

        e->views[k] = (view){
            &e->exemplars[k],
            &p->levels[level < p->count ? level : p->count - 1]};
    }
}

static otx_status
run_levels(elastic *e, otx_elastic_stats *stats)
{
    const otx_elastic_options *o = e->options;
    const int32_t levels =
        o->levels < e->pyramids[0].count ? o->levels : e->pyramids[0].count;
    int32_t done = 0;

    for (int32_t level = levels - 1; level >= 0; --level)
    {
        const int32_t until = o->rounds * (levels - level) / levels;
        bool improved = true;

        look_at(e, level);
        if (done < until)
        {
            OTX_TRY(total_energy(e, &e->energy));
            OTX_TRY(judge(e, 0, e->badness));
        }
        for (; done < until && improved; ++done)
        {
            OTX_TRY(otx_progress(
                e->run, "relax", (double)done / (double)o->rounds));
            OTX_TRY(round_of(e, level, &improved, stats));
        }
        done = until;
    }
    return OSDTEX_OK;
}

/* Makes the sheets' present shapes the ones that rigidity holds. */
static otx_status
keep_shape(elastic *e)
{
    otx_sheet *s = &e->sheet;
    otx_arena *arena = e->run->scratch;
    float *points = OTX_ZNEW(arena, float, 3 * (int64_t)s->count);
    int32_t *verts = OTX_NEW(arena, int32_t, s->count);
    const otx_rigid_mesh mesh = {s->face_count, s->count, s->first, s->corners,
                                 verts,         points,   1.0,      NULL};

    if (!points || !verts)
        return otx_fail_memory(e->run, "relax");
    for (int32_t v = 0; v < s->count; ++v)
    {
        verts[v] = v;
        points[3 * (size_t)v] = (float)s->at[v].x;
        points[3 * (size_t)v + 1] = (float)s->at[v].y;
    }
    if (otx_rigid_build(arena, &mesh, &s->rigid) != OSDTEX_OK)
        return otx_fail_memory(e->run, "relax");
    return OSDTEX_OK;
}

/* Counts, sums, fills; filling shifts the offsets, which are put back. */
static void
list_ends(elastic *e)
{
    const otx_sheet *s = &e->sheet;
    int32_t v[4];

    for (int32_t i = 0; i < s->seam_count; ++i)
    {
        seam_variables(&s->seams[i], v);
        for (int k = 0; k < 4; ++k)
            ++e->end_first[v[k] + 1];
    }
    for (int32_t i = 0; i < s->count; ++i)
        e->end_first[i + 1] += e->end_first[i];
    for (int32_t i = 0; i < s->seam_count; ++i)
    {
        seam_variables(&s->seams[i], v);
        for (int k = 0; k < 4; ++k)
        {
            const int32_t at = e->end_first[v[k]]++;

            e->end_at[4 * (int64_t)i + k] = at;
            memcpy(e->ends[at].v, v, sizeof v);
        }
    }
    for (int32_t i = s->count; i > 0; --i)
        e->end_first[i] = e->end_first[i - 1];
    e->end_first[0] = 0;
}

static otx_status
build_pyramids(elastic *e)
{
    otx_arena *arena = e->run->scratch;

    e->pyramids = OTX_NEW(arena, otx_pyramid, e->exemplar_count);
    e->views = OTX_NEW(arena, view, e->exemplar_count);
    if (!e->pyramids || !e->views)
        return otx_fail_memory(e->run, "relax");
    for (int32_t k = 0; k < e->exemplar_count; ++k)
        OTX_TRY(otx_pyramid_build(
            e->run, arena, &e->exemplars[k].match, &e->pyramids[k]));
    look_at(e, 0);
    return OSDTEX_OK;
}

static void
list_sources(elastic *e)
{
    const uint8_t *of = e->options->patch_exemplar;

    for (int32_t v = 0; v < e->sheet.count; ++v)
        e->source[v] = of ? of[e->sheet.patches[v]] : 0;
}

static bool
has_contrast(const elastic *e)
{
    for (int32_t k = 0; k < e->exemplar_count; ++k)
        if (e->exemplars[k].match_sigma > 0.0)
            return true;
    return false;
}

static otx_status
allocate(elastic *e)
{
    otx_arena *arena = e->run->scratch;
    const int32_t n = e->sheet.count;

    e->energies = OTX_NEW(arena, double, e->sheet.seam_count);
    e->terms = OTX_NEW(arena, double, n);
    e->step = OTX_NEW(arena, otx_vec2, n);
    e->b = OTX_NEW(arena, otx_vec2, n);
    e->diagonal = OTX_NEW(arena, otx_vec2, n);
    e->moved = OTX_NEW(arena, otx_vec2, n);
    e->held = OTX_NEW(arena, uint8_t, n);
    e->source = OTX_NEW(arena, uint8_t, n);
    e->sigma = OTX_NEW(arena, double, e->sheet.face_count);
    e->badness = OTX_NEW(arena, double, e->sheet.face_count);
    e->end_first = OTX_ZNEW(arena, int32_t, (int64_t)n + 1);
    e->ends = OTX_NEW(arena, seam_end, 4 * (int64_t)e->sheet.seam_count);
    e->shares = OTX_NEW(arena, seam_share, 4 * (int64_t)e->sheet.seam_count);
    e->end_at = OTX_NEW(arena, int32_t, 4 * (int64_t)e->sheet.seam_count);
    if (!e->badness || !e->end_first || !e->ends || !e->end_at ||
        !e->energies || !e->shares || !e->terms || !e->step || !e->b ||
        !e->diagonal || !e->moved || !e->held || !e->sigma || !e->source ||
        otx_rigid_fans_build(arena, &e->sheet.rigid, &e->fans) != OSDTEX_OK)
        return otx_fail_memory(e->run, "relax");
    list_ends(e);
    list_sources(e);
    return OSDTEX_OK;
}

otx_status
otx_elastic_run(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_elastic_options *options, const int32_t *face_patch,
    otx_vec2 *uvs, otx_elastic_stats *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    elastic e = {
        .run = run,
        .surface = surface,
        .exemplars = exemplars,
        .exemplar_count = options->patch_exemplar ? options->exemplar_count : 1,
        .options = options,
    };
    uint8_t *inside = NULL;

    *out = (otx_elastic_stats){0};
    if (options->reach > 0.0)
        OTX_TRY(otx_distance_mark(
            run, surface, face_patch, options->reach / options->texels,
            &inside));
    OTX_TRY(otx_sheet_build(
        run, surface, options->texels, face_patch, inside, uvs, &e.sheet));
    if (options->keep_shape)
        OTX_TRY(keep_shape(&e));
    OTX_TRY(build_pyramids(&e));
    OTX_TRY(allocate(&e));
    OTX_TRY(total_seam_energy(&e, &out->seam_before));
    if (e.sheet.seam_count > 0 && has_contrast(&e))
        OTX_TRY(run_levels(&e, out));
    look_at(&e, 0);
    OTX_TRY(total_seam_energy(&e, &out->seam_after));
    otx_sheet_store(&e.sheet, uvs);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

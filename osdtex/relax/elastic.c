/* elastic.c -- Gauss-Newton on seams and sheets, level by level. */
#include "relax/elastic_state.h"

#include "surface/distance.h"

#include <string.h>

/* ---- energies ---- */

/* Squared colour difference along a seam, per texel of length. */
static double
seam_energy(const otx_elastic *e, const otx_sheet_seam *seam)
{
    const int32_t n = otx_seam_sample_count(seam->length);
    const otx_elastic_flanks by = otx_elastic_flanks_of(e, seam);

    return otx_difference_sum(&by.a, &by.b, n) * by.weight * seam->length / n;
}

static otx_status
measure_seams(void *context, int64_t index, otx_worker *worker)
{
    const otx_elastic *e = context;
    const int64_t first = index * OTX_ELASTIC_SEAMS;
    const int64_t end = first + OTX_ELASTIC_SEAMS;

    (void)worker;
    for (int64_t i = first; i < end && i < e->sheet.seam_count; ++i)
        e->energy.seams[i] = seam_energy(e, &e->sheet.seams[i]);
    return OSDTEX_OK;
}

/* Sum over the seams, in order. */
static otx_status
total_seam_energy(otx_elastic *e, double *out)
{
    const int64_t tasks =
        (e->sheet.seam_count + OTX_ELASTIC_SEAMS - 1) / OTX_ELASTIC_SEAMS;

    OTX_TRY(otx_pool_for(e->run->pool, tasks, measure_seams, e));
    *out = 0.0;
    for (int32_t i = 0; i < e->sheet.seam_count; ++i)
        *out += e->energy.seams[i];
    return OSDTEX_OK;
}

static otx_status
turn_faces(void *context, int64_t index, otx_worker *worker)
{
    otx_elastic *e = context;
    const otx_rigid *rigid = &e->sheet.rigid;
    const int64_t first = index * OTX_ELASTIC_FACES;

    (void)worker;
    otx_rigid_fans_turn(
        rigid, e->sheet.at, (int32_t)first,
        otx_elastic_block_end(first, OTX_ELASTIC_FACES, rigid->triangle_count),
        &e->fans);
    return OSDTEX_OK;
}

/* Pulls into b, products with the Laplacian into step. */
static otx_status
measure_rows(void *context, int64_t index, otx_worker *worker)
{
    otx_elastic *e = context;
    const int32_t first = (int32_t)index * OTX_ELASTIC_ROWS;
    const int32_t end =
        otx_elastic_block_end(first, OTX_ELASTIC_ROWS, e->sheet.count);

    (void)worker;
    otx_rigid_fans_pull(&e->sheet.rigid, &e->fans, first, end, e->system.b);
    otx_rigid_apply(&e->sheet.rigid, e->sheet.at, first, end, e->system.step);
    for (int32_t v = first; v < end; ++v)
        e->energy.terms[v] = otx_vec2_dot(
            e->sheet.at[v],
            otx_vec2_sub(
                e->system.step[v], otx_vec2_scale(2.0, e->system.b[v])));
    return OSDTEX_OK;
}

/* Of the seams, and sum of u . (L u - 2 b) up to a constant that depends only
 * on the surface, with the best rotations. */
static otx_status
total_energy(otx_elastic *e, double *out)
{
    double sum = 0.0;

    OTX_TRY(total_seam_energy(e, out));
    otx_elastic_over_blocks(
        e, e->sheet.rigid.triangle_count, OTX_ELASTIC_FACES, turn_faces);
    otx_elastic_over_blocks(e, e->sheet.count, OTX_ELASTIC_ROWS, measure_rows);
    for (int32_t v = 0; v < e->sheet.count; ++v)
        sum += e->energy.terms[v];
    *out += e->options->stiffness * sum;
    return OSDTEX_OK;
}

/* ---- rounds ---- */

/* One Gauss-Newton step, halved until the energy falls; left out when it does
 * not. The energy and the badness of faces are known, and are again when the
 * step was taken. */
static otx_status
round_of(
    otx_elastic *e, int32_t level, bool *improved, otx_elastic_stats *stats)
{
    otx_sheet *s = &e->sheet;
    const otx_arena_mark mark = otx_arena_here(e->run->scratch);
    double *badness = e->guard.badness;
    double after, share = 1.0;
    otx_vec2 *step;

    OTX_TRY(otx_elastic_find_step(e, &step));
    memcpy(e->guard.from, s->at, (size_t)s->count * sizeof *s->at);
    e->guard.badness = e->guard.before;
    e->guard.before = badness;
    *improved = false;
    for (int32_t attempt = 0; attempt < 4 && !*improved; ++attempt)
    {
        memcpy(e->system.step, step, (size_t)s->count * sizeof *step);
        OTX_TRY(
            otx_elastic_move(e, share, 2.0 * (1 << level), &stats->refused));
        OTX_TRY(total_energy(e, &after));
        *improved = after < e->energy.total;
        share *= 0.5;
    }
    if (!*improved)
        memcpy(s->at, e->guard.from, (size_t)s->count * sizeof *s->at);
    else
    {
        e->energy.total = after;
        ++stats->rounds;
    }
    otx_arena_release(e->run->scratch, mark);
    return OSDTEX_OK;
}

/* Puts all exemplars to a level of their pyramids, or to their last one. */
static void
look_at(otx_elastic *e, int32_t level)
{
    for (int32_t k = 0; k < e->pictures.count; ++k)
    {
        const otx_pyramid *p = &e->pictures.pyramids[k];

        e->pictures.views[k] = (otx_elastic_view){
            &e->pictures.exemplars[k],
            &p->levels[level < p->count ? level : p->count - 1]};
    }
}

static otx_status
run_levels(otx_elastic *e, otx_elastic_stats *stats)
{
    const otx_elastic_options *o = e->options;
    const int32_t levels = o->levels < e->pictures.pyramids[0].count
                               ? o->levels
                               : e->pictures.pyramids[0].count;
    int32_t done = 0;

    for (int32_t level = levels - 1; level >= 0; --level)
    {
        const int32_t until = o->rounds * (levels - level) / levels;
        bool improved = true;

        look_at(e, level);
        if (done < until)
        {
            OTX_TRY(total_energy(e, &e->energy.total));
            OTX_TRY(otx_elastic_judge(e));
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
keep_shape(otx_elastic *e)
{
    otx_sheet *s = &e->sheet;
    otx_arena *arena = e->run->scratch;
    float *points = OTX_ZNEW(arena, float, 3 * (int64_t)s->count);
    int32_t *verts = OTX_NEW(arena, int32_t, s->count);
    const otx_rigid_mesh mesh = {s->face_count, s->count, s->first, s->corners,
                                 verts,         points,   1.0,      NULL};

    OTX_TRY(otx_run_ok(e->run));
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

static otx_status
build_pyramids(otx_elastic *e)
{
    otx_arena *arena = e->run->scratch;

    e->pictures.pyramids = OTX_NEW(arena, otx_pyramid, e->pictures.count);
    e->pictures.views = OTX_NEW(arena, otx_elastic_view, e->pictures.count);
    OTX_TRY(otx_run_ok(e->run));
    for (int32_t k = 0; k < e->pictures.count; ++k)
        OTX_TRY(otx_pyramid_build(
            e->run, arena, &e->pictures.exemplars[k].match,
            &e->pictures.pyramids[k]));
    look_at(e, 0);
    return OSDTEX_OK;
}

static void
list_sources(otx_elastic *e)
{
    const uint8_t *of = e->options->patch_exemplar;

    for (int32_t v = 0; v < e->sheet.count; ++v)
        e->pictures.source[v] = of ? of[e->sheet.patches[v]] : 0;
}

static bool
has_contrast(const otx_elastic *e)
{
    for (int32_t k = 0; k < e->pictures.count; ++k)
        if (e->pictures.exemplars[k].match_sigma > 0.0)
            return true;
    return false;
}

static otx_status
allocate(otx_elastic *e)
{
    otx_arena *arena = e->run->scratch;
    const int32_t n = e->sheet.count;

    e->energy.seams = OTX_NEW(arena, double, e->sheet.seam_count);
    e->energy.terms = OTX_NEW(arena, double, n);
    e->system.step = OTX_NEW(arena, otx_vec2, n);
    e->system.b = OTX_NEW(arena, otx_vec2, n);
    e->system.diagonal = OTX_NEW(arena, otx_vec2, n);
    e->guard.from = OTX_NEW(arena, otx_vec2, n);
    e->guard.held = OTX_NEW(arena, uint8_t, n);
    e->pictures.source = OTX_NEW(arena, uint8_t, n);
    e->guard.before = OTX_NEW(arena, double, e->sheet.face_count);
    e->guard.badness = OTX_NEW(arena, double, e->sheet.face_count);
    e->ends.first = OTX_ZNEW(arena, int32_t, (int64_t)n + 2);
    e->ends.items =
        OTX_NEW(arena, otx_elastic_end, 4 * (int64_t)e->sheet.seam_count);
    e->ends.shares =
        OTX_NEW(arena, otx_elastic_share, 4 * (int64_t)e->sheet.seam_count);
    e->ends.of = OTX_NEW(arena, int32_t, 4 * (int64_t)e->sheet.seam_count);
    OTX_TRY(otx_run_ok(e->run));
    if (otx_rigid_fans_build(arena, &e->sheet.rigid, &e->fans) != OSDTEX_OK)
        return otx_fail_memory(e->run, "relax");
    otx_elastic_list_ends(e);
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
    otx_elastic e = {
        .run = run,
        .surface = surface,
        .options = options,
        .pictures =
            {.exemplars = exemplars,
             .count = options->patch_exemplar ? options->exemplar_count : 1},
    };
    const otx_sheet_part *part = NULL;
    otx_sheet_part chosen = {options->inside, options->still};
    uint8_t *near = NULL;

    *out = (otx_elastic_stats){0};
    if (options->reach > 0.0 && !options->inside)
    {
        OTX_TRY(otx_distance_mark(
            run, surface, face_patch, options->reach / options->texels, &near));
        chosen = (otx_sheet_part){near, NULL};
    }
    if (chosen.inside)
        part = &chosen;
    OTX_TRY(otx_sheet_build(
        run, surface, options->texels, face_patch, part, uvs, &e.sheet));
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

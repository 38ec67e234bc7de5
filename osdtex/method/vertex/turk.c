/* turk.c -- passes over the meshes, from coarse to fine [Turk01, sec. 5.2]. */
#include "method/vertex/turk.h"

#include "base/random.h"
#include "method/vertex/neighbourhood.h"

#include <string.h>

/* Of the search: without it a vertex takes a third of a millisecond. */
#define SLACK 1.0f

enum
{
    STAGE_COLOR = 0x74756b02, /* of random numbers */
    ASK = 256 /* vertices between two questions whether to stop */
};

static void
paint(const otx_turk *t, int32_t level, int32_t vertex, int32_t pixel)
{
    const otx_pattern_level *from = &t->pattern.levels[level];

    t->meshes[level].pixels[vertex] = pixel;
    t->meshes[level].colors[vertex] =
        from->values
            [(ptrdiff_t)(pixel / from->width + OTX_PATTERN_RIM) * from->stride +
             pixel % from->width + OTX_PATTERN_RIM];
}

/* Every vertex shows a pixel by chance. */
static void
scatter(const otx_turk *t, int32_t level)
{
    const otx_pattern_level *from = &t->pattern.levels[level];

    for (int32_t v = 0; v < t->meshes[level].count; ++v)
        paint(
            t, level, v,
            (int32_t)(otx_random_unit(t->run->seed, STAGE_COLOR, (uint64_t)(uint32_t)v) * (from->width * from->height)));
}

typedef struct pass
{
    const otx_turk *turk;
    otx_hood hood;
    otx_hood_table table;
    bool guesses; /* what vertices show is a guess */
} pass;

static void
visit(const pass *p, int32_t vertex)
{
    const otx_turk_mesh *mesh = &p->turk->meshes[p->hood.level];
    otx_quad colors[OTX_HOOD_MOST];

    if (mesh->face_first[vertex] == mesh->face_first[vertex + 1])
        return;
    otx_hood_gather(p->turk, &p->hood, vertex, colors);
    paint(
        p->turk, p->hood.level, vertex,
        otx_hood_nearest(
            &p->table, colors, p->guesses ? mesh->pixels[vertex] : -1));
}

/* In the order of the sweep, each looking at what those before it have become.
 */
static otx_status
sweep(const pass *p)
{
    const otx_turk *t = p->turk;
    const int32_t count = t->meshes[p->hood.level].count;
    int32_t seen = 0;

    for (int32_t i = 0; i < t->meshes[0].count; ++i)
    {
        if (t->order[i] >= count)
            continue;
        visit(p, t->order[i]);
        if (++seen % ASK == 0)
            OTX_TRY(otx_progress(t->run, "turk", (double)seen / count));
    }
    return OSDTEX_OK;
}

static otx_status
visit_block(void *context, int64_t index, otx_worker *worker)
{
    const pass *p = context;
    const int32_t count = p->turk->meshes[p->hood.level].count;
    const int32_t first = (int32_t)index * ASK;

    (void)worker;
    for (int32_t v = first; v < first + ASK && v < count; ++v)
        visit(p, v);
    return OSDTEX_OK;
}

/* What looks at the coarser mesh alone goes in any order. */
static otx_status
visit_all(const pass *p)
{
    const otx_turk *t = p->turk;
    const int32_t count = t->meshes[p->hood.level].count;
    pass copy = *p;

    copy.table.hood = &copy.hood;
    return otx_loop_result(
        t->run, "turk",
        otx_pool_for(
            t->run->pool, (count + ASK - 1) / ASK, visit_block, &copy));
}

static otx_status
run_pass(otx_turk *t, otx_hood_kind kind, int32_t level)
{
    const otx_arena_mark mark = otx_arena_here(t->run->scratch);
    pass *p = OTX_ZNEW(t->run->scratch, pass, 1);
    otx_status status;

    OTX_TRY(otx_run_ok(t->run));
    p->turk = t;
    p->guesses = kind == OTX_HOOD_REFINE;
    otx_hood_set(&p->hood, kind, level);
    OTX_TRY(otx_hood_table_build(t->run, &t->pattern, &p->hood, &p->table));
    p->table.slack = SLACK;
    status = kind == OTX_HOOD_EXTRAPOLATE ? visit_all(p) : sweep(p);
    otx_arena_release(t->run->scratch, mark);
    return status;
}

/* The coarser mesh's colours at the vertices of a finer one. */
static void
raise(otx_turk *t, int32_t level)
{
    const otx_turk_mesh *coarser = &t->meshes[level + 1];

    memcpy(
        t->above, coarser->colors, (size_t)coarser->count * sizeof *t->above);
    otx_turk_interpolate(coarser, t->meshes[level].count, t->above);
}

otx_status
otx_turk_run(otx_turk *t)
{
    const int32_t last = t->mesh_count - 1;

    scatter(t, last);
    OTX_TRY(run_pass(t, OTX_HOOD_SEED, last));
    for (int32_t k = last - 1; k >= 0; --k)
    {
        raise(t, k);
        OTX_TRY(run_pass(t, OTX_HOOD_EXTRAPOLATE, k));
        OTX_TRY(run_pass(t, OTX_HOOD_REFINE, k));
    }
    return OSDTEX_OK;
}

otx_status
otx_turk_make(otx_vertex *v)
{
    otx_turk *t = OTX_NEW(v->run->scratch, otx_turk, 1);

    if (!t)
        return otx_fail_memory(v->run, "map");
    OTX_TRY(otx_turk_build(v, t));
    OTX_TRY(otx_turk_sweep(t));
    OTX_TRY(otx_turk_run(t));
    otx_figures_count(
        v->job->figures, "made.points", "vertices", t->meshes[0].count);
    return otx_turk_spread(t, v);
}

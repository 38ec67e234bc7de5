/* sweep.c -- how far along the field each vertex is [Turk01, sec. 4.2]. */
#include "method/vertex/turk.h"

#include "base/random.h"

#include <stdlib.h>
#include <string.h>

#define DRAWN 0.5 /* t of eq. 4 */

enum
{
    STAGE_ANCHOR = 0x74756b01, /* of random numbers */
    ROUNDS = 100,              /* at the coarsest mesh, once all is assigned */
    ROUNDS_FINER = 12
};

typedef struct sweeper
{
    const otx_turk *turk;
    const otx_turk_mesh *mesh;
    double *now, *next; /* [vertices] */
    uint8_t *assigned;  /* [vertices], of two bits: now, next */
} sweeper;

/* How much further along the field v is than w. */
static double
advance(const otx_turk *t, int32_t v, int32_t w)
{
    const otx_vec3 d = otx_vec3_sub(
        otx_vec3_load(t->surface->points, v),
        otx_vec3_load(t->surface->points, w));
    const otx_vec3 n = otx_vec3_load(t->surface->normals, v);
    const otx_vec3 sum = otx_vec3_add(t->down[v], t->down[w]);
    const otx_vec3 o = otx_vec3_unit(
        otx_vec3_sub(sum, otx_vec3_scale(otx_vec3_dot(sum, n), n)));

    return otx_vec3_dot(d, o);
}

/* Eq. 5 at one vertex; only what is assigned contributes. */
static bool
consent(const sweeper *s, int32_t v, double *out)
{
    const otx_turk_mesh *mesh = s->mesh;
    double sum = 0.0, weight = 0.0;

    for (int32_t i = mesh->near_first[v]; i < mesh->near_first[v + 1]; ++i)
    {
        const int32_t w = mesh->near[i];

        if (!(s->assigned[w] & 1))
            continue;
        sum += (double)mesh->near_weights[i] *
               (s->now[w] + advance(s->turk, v, w));
        weight += (double)mesh->near_weights[i];
    }
    *out = s->now[v];
    if (!(weight > 0.0))
        return s->assigned[v] & 1;
    *out = s->assigned[v] & 1 ? s->now[v] + DRAWN * (sum / weight - s->now[v])
                              : sum / weight;
    return true;
}

/* One round over a mesh; how many vertices were assigned by it. */
static int32_t
spread(sweeper *s)
{
    double *swap = s->now;
    int32_t fresh = 0;

    for (int32_t v = 0; v < s->mesh->count; ++v)
        if (consent(s, v, &s->next[v]))
            s->assigned[v] |= 2;
    for (int32_t v = 0; v < s->mesh->count; ++v)
    {
        fresh += s->assigned[v] == 2;
        s->assigned[v] |= s->assigned[v] >> 1;
    }
    s->now = s->next;
    s->next = swap;
    return fresh;
}

/* Until nothing more is assigned. */
static otx_status
fill(sweeper *s)
{
    while (spread(s) > 0)
        OTX_TRY(otx_progress(s->turk->run, "sweep", 0.0));
    return OSDTEX_OK;
}

/* Every component has an anchor: the first one by chance. */
static otx_status
begin(sweeper *s)
{
    const otx_turk_mesh *mesh = s->mesh;
    int32_t anchor =
        (int32_t)(otx_random_unit(s->turk->run->seed, STAGE_ANCHOR, 0) * mesh->count);

    OTX_TRY(fill(s));
    for (int32_t v = 0; v <= mesh->count; ++v)
    {
        if (s->assigned[anchor] == 0 &&
            mesh->near_first[anchor] < mesh->near_first[anchor + 1])
        {
            s->assigned[anchor] = 3;
            s->now[anchor] = 0.0;
            OTX_TRY(fill(s));
        }
        anchor = v < mesh->count ? v : 0;
    }
    return OSDTEX_OK;
}

typedef struct ranked
{
    double sweep;
    int32_t vertex;
} ranked;

static int
by_sweep(const void *a, const void *b)
{
    const ranked *p = a, *q = b;

    return p->sweep != q->sweep
               ? (p->sweep > q->sweep ? 1 : -1)
               : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static otx_status
sort(otx_turk *t)
{
    const int32_t count = t->meshes[0].count;
    ranked *list = OTX_NEW(t->run->scratch, ranked, count);

    t->order = OTX_NEW(t->run->scratch, int32_t, count);
    OTX_TRY(otx_run_ok(t->run));
    for (int32_t v = 0; v < count; ++v)
        list[v] = (ranked){t->sweep[v], v};
    qsort(list, (size_t)count, sizeof *list, by_sweep);
    for (int32_t v = 0; v < count; ++v)
        t->order[v] = list[v].vertex;
    return OSDTEX_OK;
}

otx_status
otx_turk_sweep(otx_turk *t)
{
    otx_arena *arena = t->run->scratch;
    const int32_t count = t->meshes[0].count, last = t->mesh_count - 1;
    sweeper s = {
        .turk = t,
        .mesh = &t->meshes[last],
        .now = OTX_ZNEW(arena, double, count),
        .next = OTX_ZNEW(arena, double, count),
        .assigned = OTX_ZNEW(arena, uint8_t, count)};

    OTX_TRY(otx_run_ok(t->run));
    for (int32_t k = last; k >= 0; --k)
    {
        s.mesh = &t->meshes[k];
        OTX_TRY(begin(&s));
        for (int32_t i = 0; i < (k == last ? ROUNDS : ROUNDS_FINER); ++i)
        {
            spread(&s);
            OTX_TRY(
                otx_progress(t->run, "sweep", (double)(last - k) / (last + 1)));
        }
    }
    t->sweep = s.now;
    return sort(t);
}

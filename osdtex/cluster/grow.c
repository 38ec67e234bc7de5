/* grow.c -- regions grown from spread seeds [Soler02, sec. 3.1].
 *
 * The paper draws seeds at random and afterwards exchanges faces to make
 * borders regular. Here seeds are spread by farthest-point sampling and moved
 * to the middle of their region a few times [Lloyd82; Cohen-Steiner04], which
 * gives compact regions with regular borders at once, and depends on nothing
 * but the mesh. */
#include "cluster/cluster.h"

#include "base/pqueue.h"

#include <string.h>

static const char STAGE[] = "cluster";

enum
{
    LLOYD_ROUNDS = 8,
    SPREADS = LLOYD_ROUNDS + 1, /* times that all seeds spread */
    OUTSIDE = -1,               /* not a face of the region; all bits set */
    UNREACHED = -2
};

/* One growth. Arrays are over the faces of the level. */
typedef struct growth
{
    otx_run *run;
    const otx_dual *dual;
    const otx_cluster *region;
    double bend;
    int32_t *owner;   /* seed index, UNREACHED or OUTSIDE, the workspace's */
    double *distance; /* to the owner's seed */
    int32_t *seeds;   /* faces */
    int32_t seed_count;
    /* While seeds are placed: faces by falling distance, with stale entries.
     * Looking through all faces for each seed would be quadratic. */
    otx_pqueue far;
    bool placing;
    uint32_t steps;
} growth;

enum
{
    STEPS_PER_LOOK = 4096, /* faces reached between looks at the clock */
    SEEDS_PER_WORD = 64    /* seeds placed between words on progress */
};

/* Lets the user stop, every few thousand steps. Who does not look at what comes
 * of it is told at the next look. */
static otx_status
step(growth *g)
{
    return ++g->steps % STEPS_PER_LOOK == 0 ? otx_pulse(g->run) : OSDTEX_OK;
}

static void
reach(growth *g, otx_pqueue *queue, int32_t face, int32_t seed, double distance)
{
    g->owner[face] = seed;
    g->distance[face] = distance;
    otx_pqueue_push(queue, distance, face);
    if (g->placing)
        otx_pqueue_push(&g->far, -distance, face);
}

/* Spreads from one seed to where it is nearer than what was there. */
static otx_status
spread(growth *g, otx_pqueue *queue, int32_t seed)
{
    const otx_level *level = g->dual->level;
    otx_pqueue_entry entry;

    queue->count = 0;
    reach(g, queue, g->seeds[seed], seed, 0.0);
    while (otx_pqueue_pop(queue, &entry))
    {
        const int32_t face = entry.item;

        OTX_TRY(step(g));
        if (entry.key > g->distance[face] || g->owner[face] != seed)
            continue;
        for (int32_t k = 0; k < otx_level_face_size(level, face); ++k)
        {
            const int32_t next = otx_level_neighbour(level, face, k);
            double distance;

            if (next < 0 || g->owner[next] == OUTSIDE)
                continue;
            distance = entry.key + otx_dual_step(g->dual, face, next, g->bend);
            if (g->owner[next] != UNREACHED && distance >= g->distance[next])
                continue;
            reach(g, queue, next, seed, distance);
        }
    }
    return otx_run_ok(g->run);
}

/* Whether a way to a face is better than what it has: shorter, or of two as
 * short that of the lower seed. A seed keeps its own face. */
static bool
is_nearer(const growth *g, int32_t face, double distance, int32_t seed)
{
    const int32_t owner = g->owner[face];

    if (owner == UNREACHED || distance < g->distance[face])
        return true;
    return distance == g->distance[face] && seed < owner &&
           g->seeds[owner] != face;
}

/* Spreads from all seeds at once: what one after another would come to, in the
 * time of one. */
static otx_status
spread_all(growth *g, otx_pqueue *queue)
{
    const otx_level *level = g->dual->level;
    otx_pqueue_entry entry;

    queue->count = 0;
    for (int32_t s = 0; s < g->seed_count; ++s)
        reach(g, queue, g->seeds[s], s, 0.0);
    while (otx_pqueue_pop(queue, &entry))
    {
        const int32_t face = entry.item, seed = g->owner[face];

        OTX_TRY(step(g));
        if (entry.key > g->distance[face])
            continue;
        for (int32_t k = 0; k < otx_level_face_size(level, face); ++k)
        {
            const int32_t next = otx_level_neighbour(level, face, k);
            double distance;

            if (next < 0 || g->owner[next] == OUTSIDE)
                continue;
            distance = entry.key + otx_dual_step(g->dual, face, next, g->bend);
            if (is_nearer(g, next, distance, seed))
                reach(g, queue, next, seed, distance);
        }
    }
    return otx_run_ok(g->run);
}

static void
forget(growth *g)
{
    for (int32_t i = 0; i < g->region->face_count; ++i)
    {
        g->owner[g->region->faces[i]] = UNREACHED;
        g->distance[g->region->faces[i]] = INFINITY;
    }
}

/* Forgets all, and has the faces wait for seeds. */
static void
begin_placing(growth *g)
{
    forget(g);
    g->placing = true;
    g->far.count = 0;
    for (int32_t i = 0; i < g->region->face_count; ++i)
    {
        step(g);
        otx_pqueue_push(&g->far, -INFINITY, g->region->faces[i]);
    }
}

/* The face of the region farthest from all seeds, unreached ones first, of
 * equals the first. It leaves the queue; one at a seed is as near as any. */
static int32_t
farthest(growth *g)
{
    otx_pqueue_entry entry;

    while (otx_pqueue_pop(&g->far, &entry))
    {
        step(g);
        if (-entry.key == g->distance[entry.item])
            return entry.item;
    }
    return g->seeds[0];
}

/* Spreads from the first seed alone. */
static otx_status
spread_first(growth *g, otx_pqueue *queue)
{
    begin_placing(g);
    return spread(g, queue, 0);
}

static otx_status
place_seeds(growth *g, otx_pqueue *queue, int32_t wanted)
{
    /* The first is far from an arbitrary face, so that it lies at an end. */
    g->seeds[0] = g->region->faces[0];
    g->seed_count = 1;
    OTX_TRY(spread_first(g, queue));
    g->seeds[0] = farthest(g);
    OTX_TRY(spread_first(g, queue));
    while (g->seed_count < g->region->face_count)
    {
        const int32_t face = farthest(g);

        /* Go on past `wanted` until every component has a seed. */
        if (g->seed_count >= wanted && isfinite(g->distance[face]))
            break;
        if (g->distance[face] == 0.0)
            break;
        if (g->seed_count % SEEDS_PER_WORD == 0)
            OTX_TRY(otx_progress(
                g->run, STAGE,
                fmin(1.0, (double)g->seed_count / wanted) / SPREADS));
        g->seeds[g->seed_count] = face;
        OTX_TRY(spread(g, queue, g->seed_count++));
    }
    g->placing = false;
    return OSDTEX_OK;
}

/* Moves every seed to the face of its region nearest to the centroid. */
static otx_status
center_seeds(growth *g)
{
    const otx_dual *dual = g->dual;
    otx_arena *scratch = g->run->scratch;
    otx_vec3 *sum = OTX_ZNEW(scratch, otx_vec3, g->seed_count);
    double *area = OTX_ZNEW(scratch, double, g->seed_count);
    double *best = OTX_NEW(scratch, double, g->seed_count);

    OTX_TRY(otx_run_ok(g->run));
    for (int32_t i = 0; i < g->region->face_count; ++i)
    {
        const int32_t f = g->region->faces[i], s = g->owner[f];

        sum[s] = otx_vec3_mix(1.0, sum[s], dual->areas[f], dual->centroids[f]);
        area[s] += dual->areas[f];
    }
    for (int32_t s = 0; s < g->seed_count; ++s)
        best[s] = INFINITY;
    for (int32_t i = 0; i < g->region->face_count; ++i)
    {
        const int32_t f = g->region->faces[i], s = g->owner[f];
        const otx_vec3 middle = area[s] > 0.0
                                    ? otx_vec3_scale(1.0 / area[s], sum[s])
                                    : dual->centroids[g->seeds[s]];
        const double d =
            otx_vec3_length(otx_vec3_sub(dual->centroids[f], middle));

        if (d < best[s])
        {
            best[s] = d;
            g->seeds[s] = f;
        }
    }
    return OSDTEX_OK;
}

static otx_status
lloyd(growth *g, otx_pqueue *queue)
{
    for (int32_t round = 0; round < LLOYD_ROUNDS; ++round)
    {
        const otx_arena_mark mark = otx_arena_here(g->run->scratch);

        OTX_TRY(center_seeds(g));
        otx_arena_release(g->run->scratch, mark);
        forget(g);
        OTX_TRY(spread_all(g, queue));
        if (g->seed_count >= SEEDS_PER_WORD)
            OTX_TRY(otx_progress(g->run, STAGE, (2.0 + round) / SPREADS));
    }
    return OSDTEX_OK;
}

/* The regions as clusters, in seed order; a seed may have lost everything. */
static otx_status
collect(growth *g, otx_cluster_list *out)
{
    otx_run *run = g->run;
    const int32_t n = g->seed_count;
    int32_t *faces = OTX_NEW(run->arena, int32_t, g->region->face_count);
    int32_t *first = OTX_ZNEW(run->scratch, int32_t, n + 1);

    out->clusters = OTX_NEW(run->arena, otx_cluster, n);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < g->region->face_count; ++i)
        ++first[g->owner[g->region->faces[i]] + 1];
    for (int32_t s = 0; s < n; ++s)
    {
        first[s + 1] += first[s];
        out->clusters[s] =
            (otx_cluster){g->region->level, 0, faces + first[s], 0.0, -1};
    }
    for (int32_t i = 0; i < g->region->face_count; ++i)
    {
        const int32_t f = g->region->faces[i], s = g->owner[f];

        faces[first[s]++] = f;
        ++out->clusters[s].face_count;
        out->clusters[s].area += g->dual->areas[f];
    }
    out->count = n;
    return OSDTEX_OK;
}

otx_status
otx_cluster_space_create(
    otx_run *run, const otx_level *level, otx_cluster_space *out)
{
    const int32_t n = level->face_count;

    out->owner = OTX_NEW(run->arena, int32_t, n);
    out->distance = OTX_NEW(run->arena, double, n);
    out->member = OTX_ZNEW(run->arena, int32_t, n);
    OTX_TRY(otx_run_ok(run));
    memset(out->owner, OUTSIDE, (size_t)n * sizeof *out->owner);
    return OSDTEX_OK;
}

/* Grows `wanted` regions; says nothing about their topology. */
static otx_status
grow_regions(
    otx_run *run, const otx_growing *how, const otx_cluster *region,
    int32_t wanted, otx_cluster_list *out)
{
    growth g = {
        .run = run,
        .dual = how->dual,
        .region = region,
        .bend = how->bend,
        .owner = how->space->owner,
        .distance = how->space->distance,
        .far = otx_pqueue_make(run->scratch),
    };
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_status status;

    g.seeds = OTX_NEW(run->scratch, int32_t, region->face_count);
    OTX_TRY(otx_run_ok(run));
    status = place_seeds(&g, &queue, wanted);
    if (status == OSDTEX_OK)
        status = lloyd(&g, &queue);
    if (status == OSDTEX_OK)
        status = collect(&g, out);
    for (int32_t i = 0; i < region->face_count; ++i)
        g.owner[region->faces[i]] = OUTSIDE;
    return status;
}

/* A list that grows in the run's arena. */
static bool
append(otx_run *run, otx_cluster_list *list, int32_t *capacity, otx_cluster c)
{
    if (list->count == *capacity)
    {
        const int32_t wanted = *capacity ? 2 * *capacity : 64;
        otx_cluster *grown = OTX_NEW(run->arena, otx_cluster, wanted);

        if (!grown)
            return false;
        if (list->count > 0)
            memcpy(
                grown, list->clusters,
                (size_t)list->count * sizeof *list->clusters);
        list->clusters = grown;
        *capacity = wanted;
    }
    list->clusters[list->count++] = c;
    return true;
}

static int32_t
seeds_for(const otx_cluster *region, double target_area, int32_t minimum)
{
    const double wanted = region->area / target_area + 0.5;
    int32_t n =
        wanted < region->face_count ? (int32_t)wanted : region->face_count;

    if (n < minimum)
        n = minimum;
    if (n < 1)
        n = 1;
    return n < region->face_count ? n : region->face_count;
}

/* Faces of the region that are not holes, as a region of their own. */
static otx_status
without_holes(
    otx_run *run, const otx_dual *dual, const otx_cluster *region,
    otx_cluster *out)
{
    int32_t *faces = OTX_NEW(run->scratch, int32_t, region->face_count);

    OTX_TRY(otx_run_ok(run));
    *out = (otx_cluster){region->level, 0, faces, 0.0, -1};
    for (int32_t i = 0; i < region->face_count; ++i)
    {
        const int32_t f = region->faces[i];

        if (dual->level->face_hole[f])
            continue;
        faces[out->face_count++] = f;
        out->area += dual->areas[f];
    }
    return OSDTEX_OK;
}

/* Every face on its own: for a region that growing does not divide, because
 * all its centroids coincide. */
static otx_status
append_faces(
    otx_run *run, const otx_dual *dual, const otx_cluster *region,
    otx_cluster_list *out, int32_t *capacity)
{
    for (int32_t i = 0; i < region->face_count; ++i)
    {
        const int32_t *face = &region->faces[i];

        if (!append(
                run, out, capacity,
                (otx_cluster){region->level, 1, face, dual->areas[*face], -1}))
            return otx_fail_memory(run, STAGE);
    }
    return OSDTEX_OK;
}

/* Grows, then grows again, in halves, inside whatever is not a disc. Each
 * round makes such a region smaller, so it ends at single faces at worst. */
static otx_status
grow_discs(
    otx_run *run, const otx_growing *how, const otx_cluster *region,
    int32_t wanted, otx_cluster_list *out, int32_t *capacity)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_dual *dual = how->dual;
    int32_t *member = how->space->member;
    otx_cluster_list regions = {0};

    OTX_TRY(grow_regions(run, how, region, wanted, &regions));
    otx_arena_release(run->scratch, mark);
    for (int32_t i = 0; i < regions.count; ++i)
    {
        const otx_cluster *c = &regions.clusters[i];
        bool disc = c->face_count == 1;

        if (c->face_count == 0)
            continue;
        for (int32_t k = 0; k < c->face_count; ++k)
            member[c->faces[k]] = 1;
        disc = disc || otx_cluster_is_disc(
                           run->scratch, dual->level, c->faces, c->face_count,
                           member, 1);
        for (int32_t k = 0; k < c->face_count; ++k)
            member[c->faces[k]] = 0;
        if (wanted > 1 && c->face_count > 1 &&
            c->face_count == region->face_count)
            OTX_TRY(append_faces(run, dual, c, out, capacity));
        else if (!disc)
            OTX_TRY(grow_discs(run, how, c, 2, out, capacity));
        else if (!append(run, out, capacity, *c))
            return otx_fail_memory(run, STAGE);
    }
    return OSDTEX_OK;
}

otx_status
otx_cluster_grow(
    otx_run *run, const otx_growing *how, const otx_cluster *region,
    double target_area, int32_t minimum, otx_cluster_list *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t capacity = 0;
    otx_cluster solid;

    *out = (otx_cluster_list){0};
    OTX_TRY(without_holes(run, how->dual, region, &solid));
    if (solid.face_count > 0)
        OTX_TRY(grow_discs(
            run, how, &solid, seeds_for(&solid, target_area, minimum), out,
            &capacity));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

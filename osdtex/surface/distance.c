/* distance.c -- distances along faces, from where labels change. */
#include "surface/distance.h"

#include "base/pqueue.h"
#include "math/vec.h"

typedef struct walk
{
    const otx_surface *surface;
    const otx_level *leaf;
    const int32_t *face_patch; /* -1 is passed over */
    double *nearest;           /* [face_count] from a seam */
    double unit;               /* of steps */
    bool dense;                /* steps are times the surface's density */
    otx_pqueue queue;
} walk;

static otx_vec3
centre(const walk *w, int32_t face)
{
    const int32_t first = w->leaf->face_first[face];
    const int32_t size = otx_level_face_size(w->leaf, face);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t i = first; i < first + size; ++i)
        sum = otx_vec3_add(
            sum, otx_vec3_load(w->surface->points, w->leaf->face_verts[i]));
    return otx_vec3_scale(1.0 / size, sum);
}

static bool
is_at_seam(const walk *w, int32_t face)
{
    for (int32_t k = 0; k < otx_level_face_size(w->leaf, face); ++k)
    {
        const int32_t other = otx_level_neighbour(w->leaf, face, k);

        if (other >= 0 && w->face_patch[other] >= 0 &&
            w->face_patch[other] != w->face_patch[face])
            return true;
    }
    return false;
}

static void
start(walk *w)
{
    for (int32_t f = 0; f < w->leaf->face_count; ++f)
    {
        const bool seed = w->face_patch[f] >= 0 && is_at_seam(w, f);

        w->nearest[f] = seed ? 0.0 : INFINITY;
        if (seed)
            otx_pqueue_push(&w->queue, 0.0, f);
    }
}

/* Between the centres of two neighbours. */
static double
step(const walk *w, int32_t face, int32_t other)
{
    const int32_t *verts = w->leaf->face_verts + w->leaf->face_first[face];
    const double length =
        otx_vec3_length(otx_vec3_sub(centre(w, other), centre(w, face)));

    return w->dense
               ? w->unit * length *
                     otx_surface_density(
                         w->surface, verts, otx_level_face_size(w->leaf, face))
               : length;
}

/* Goes on to the neighbours of `face`, no farther than `distance`. */
static void
spread(walk *w, int32_t face, double distance)
{
    for (int32_t k = 0; k < otx_level_face_size(w->leaf, face); ++k)
    {
        const int32_t other = otx_level_neighbour(w->leaf, face, k);
        double d;

        if (other < 0 || w->face_patch[other] < 0)
            continue;
        d = w->nearest[face] + step(w, face, other);
        if (!(d < w->nearest[other]) || d > distance)
            continue;
        w->nearest[other] = d;
        otx_pqueue_push(&w->queue, d, other);
    }
}

static otx_status
go(otx_run *run, walk *w, double distance)
{
    otx_pqueue_entry entry;

    start(w);
    while (otx_pqueue_pop(&w->queue, &entry))
        if (entry.key <= w->nearest[entry.item])
            spread(w, entry.item, distance);
    return otx_run_ok(run);
}

otx_status
otx_distance_mark(
    otx_run *run, const otx_surface *surface, const int32_t *face_patch,
    double distance, uint8_t **out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    walk w = {
        .surface = surface,
        .leaf = leaf,
        .face_patch = face_patch,
        .nearest = OTX_NEW(run->scratch, double, leaf->face_count),
        .queue = otx_pqueue_make(run->scratch)};

    *out = OTX_NEW(run->scratch, uint8_t, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(go(run, &w, distance));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        (*out)[f] = isfinite(w.nearest[f]);
    return OSDTEX_OK;
}

otx_status
otx_distance_measure(
    otx_run *run, const otx_surface *surface, const uint8_t *label, double unit,
    double limit, double *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t *labels = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    walk w = {
        .surface = surface,
        .leaf = leaf,
        .face_patch = labels,
        .nearest = out,
        .unit = unit,
        .dense = true,
        .queue = otx_pqueue_make(run->scratch)};

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        labels[f] = leaf->face_hole[f] ? -1 : label[f];
    OTX_TRY(go(run, &w, limit));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

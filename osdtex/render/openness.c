/* openness.c -- rays from every vertex, a batch to an index of the pool. */
#include "render/openness.h"

#include "render/light.h"
#include "render/tracer.h"

enum
{
    RAYS = 64,
    BATCH = 256
};

typedef struct openness
{
    const otx_surface *surface;
    const otx_tracer *tracer;
    double *out;
} openness;

static otx_status
look_around(void *context, int64_t index, otx_worker *worker)
{
    const openness *o = context;
    const int32_t count = otx_surface_leaf(o->surface)->vert_count;
    const int32_t first = (int32_t)index * BATCH;
    const int32_t end = count - first < BATCH ? count : first + BATCH;

    (void)worker;
    for (int32_t v = first; v < end; ++v)
        o->out[v] = otx_light_open(
            o->tracer,
            otx_tracer_inside(o->tracer, otx_vec3_load(o->surface->points, v)),
            otx_vec3_load(o->surface->normals, v), RAYS);
    return OSDTEX_OK;
}

otx_status
otx_openness(otx_run *run, const otx_surface *surface, double *out)
{
    static const char stage[] = "occlusion";
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_scene scene = {
        .vert_count = leaf->vert_count,
        .face_count = leaf->face_count,
        .corner_count = leaf->corner_count,
        .points = surface->points,
        .face_first = leaf->face_first,
        .face_verts = leaf->face_verts,
        .face_hole = leaf->face_hole,
    };
    openness o = {surface, NULL, out};
    otx_tracer *tracer;

    OTX_TRY(otx_scene_validate(run, &scene));
    OTX_TRY(otx_tracer_create(run, &scene, &tracer));
    o.tracer = tracer;
    OTX_TRY(otx_loop_result(
        run, stage,
        otx_pool_for(
            run->pool, (leaf->vert_count + BATCH - 1) / BATCH, look_around,
            &o)));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

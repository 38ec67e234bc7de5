/* dual.c -- face geometry of a level, summed over the leaves below. */
#include "cluster/dual.h"

otx_vec3
otx_dual_leaf_area(const otx_surface *surface, int32_t face, otx_vec3 *centroid)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const otx_vec3 origin =
        otx_vec3_load(surface->points, leaf->face_verts[first]);
    otx_vec3 area = {0, 0, 0}, sum = origin;
    otx_vec3 previous = {0, 0, 0};

    for (int32_t k = 1; k < size; ++k)
    {
        const otx_vec3 p =
            otx_vec3_load(surface->points, leaf->face_verts[first + k]);
        const otx_vec3 side = otx_vec3_sub(p, origin);

        area = otx_vec3_add(area, otx_vec3_cross(previous, side));
        sum = otx_vec3_add(sum, p);
        previous = side;
    }
    *centroid = otx_vec3_scale(1.0 / size, sum);
    return area;
}

double
otx_dual_leaf_density(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    return otx_surface_density(
        surface, leaf->face_verts + leaf->face_first[face],
        otx_level_face_size(leaf, face));
}

/* Sums the leaves of one face. */
static void
measure_face(const otx_surface *surface, otx_dual *dual, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_vec3 centroid = {0, 0, 0}, normal = {0, 0, 0};
    double area = 0.0, scaled = 0.0;
    int32_t first, end;

    otx_surface_leaves(surface, dual->level_index, face, &first, &end);
    for (int32_t f = first; f < end; ++f)
    {
        otx_vec3 c;
        const otx_vec3 a = otx_dual_leaf_area(surface, f, &c);
        const double weight = 0.5 * otx_vec3_length(a);
        const double density = otx_dual_leaf_density(surface, f);

        normal = otx_vec3_add(normal, a);
        centroid = otx_vec3_mix(1.0, centroid, weight, c);
        area += weight;
        scaled += density * density * weight;
    }
    if (area > 0.0)
        centroid = otx_vec3_scale(1.0 / area, centroid);
    else
        otx_dual_leaf_area(surface, first, &centroid);
    dual->centroids[face] = centroid;
    dual->normals[face] = otx_vec3_unit(normal);
    dual->areas[face] = leaf->face_hole[first] ? 0.0 : scaled;
    if (dual->densities)
        dual->densities[face] = area > 0.0 ? sqrt(scaled / area) : 1.0;
}

typedef struct measure_job
{
    const otx_surface *surface;
    otx_dual *dual;
} measure_job;

enum
{
    FACES_PER_TASK = 1024
};

static otx_status
measure_faces(void *context, int64_t index, otx_worker *worker)
{
    const measure_job *job = context;
    const int64_t first = index * FACES_PER_TASK;
    const int64_t end = first + FACES_PER_TASK;
    const int64_t count = job->dual->level->face_count;

    (void)worker;
    for (int64_t f = first; f < end && f < count; ++f)
        measure_face(job->surface, job->dual, (int32_t)f);
    return OSDTEX_OK;
}

otx_status
otx_dual_build(
    otx_run *run, const otx_surface *surface, int32_t level, otx_dual *out)
{
    const otx_level *l = &surface->levels[level];
    measure_job job = {surface, out};

    *out = (otx_dual){.level = l, .level_index = level};
    out->centroids = OTX_NEW(run->arena, otx_vec3, l->face_count);
    out->normals = OTX_NEW(run->arena, otx_vec3, l->face_count);
    out->areas = OTX_NEW(run->arena, double, l->face_count);
    if (surface->density)
        out->densities = OTX_NEW(run->arena, double, l->face_count);
    OTX_TRY(otx_run_ok(run));
    return otx_pool_for(
        run->pool, (l->face_count + FACES_PER_TASK - 1) / FACES_PER_TASK,
        measure_faces, &job);
}

double
otx_dual_step(const otx_dual *dual, int32_t a, int32_t b, double bend)
{
    const double distance =
        otx_vec3_length(otx_vec3_sub(dual->centroids[a], dual->centroids[b]));
    const double turn = 1.0 - otx_vec3_dot(dual->normals[a], dual->normals[b]);

    const double density =
        dual->densities ? 0.5 * (dual->densities[a] + dual->densities[b]) : 1.0;

    return density * distance * (1.0 + bend * turn);
}

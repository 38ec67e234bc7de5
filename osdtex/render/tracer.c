/* tracer.c -- one Embree geometry of quads for faces of any size.
 *
 * Embree takes a quad whose last two corners are equal for a triangle, so a
 * single geometry, and a single table from primitive to face, serve all. */
#include "render/tracer.h"

#include <embree3/rtcore.h>
#include <stdatomic.h>
#include <string.h>

static const char STAGE[] = "render";

enum
{
    MESSAGE_BYTES = 160
};

typedef struct primitive
{
    int32_t face;
    int32_t fan; /* which triangle of a fan, -1 for a whole quad */
} primitive;

struct otx_tracer
{
    const otx_scene *scene;
    otx_vec3 centre;
    double to_inside; /* 1 / radius */
    primitive *primitives;
    int64_t primitive_count;
    RTCDevice device;
    RTCScene tree;
    /* The first failure; Embree may report from any thread. */
    atomic_int error;
    char message[MESSAGE_BYTES];
};

static void
remember_error(void *user, enum RTCError code, const char *text)
{
    otx_tracer *tracer = user;
    int none = RTC_ERROR_NONE;

    if (!atomic_compare_exchange_strong(&tracer->error, &none, (int)code))
        return;
    strncpy(tracer->message, text ? text : "", MESSAGE_BYTES - 1);
}

static void
release_tracer(void *object)
{
    otx_tracer *tracer = object;

    if (tracer->tree)
        rtcReleaseScene(tracer->tree);
    if (tracer->device)
        rtcReleaseDevice(tracer->device);
}

static otx_status
fail_embree(otx_run *run, otx_tracer *tracer)
{
    if (atomic_load(&tracer->error) == RTC_ERROR_OUT_OF_MEMORY)
        return otx_fail_memory(run, STAGE);
    return otx_fail(
        run, OSDTEX_ERROR_INTERNAL, STAGE, OTX_NOWHERE,
        "Embree could not prepare the model (error %d%s%s); is there memory "
        "for "
        "it and its threads?",
        (int)atomic_load(&tracer->error), tracer->message[0] ? ": " : "",
        tracer->message);
}

static int32_t
primitives_of(const otx_scene *scene, int32_t face)
{
    const int32_t size = scene->face_first[face + 1] - scene->face_first[face];

    if (otx_scene_is_hole(scene, face))
        return 0;
    return size == 4 ? 1 : size - 2;
}

static otx_status
list_primitives(otx_run *run, otx_tracer *tracer)
{
    const otx_scene *scene = tracer->scene;
    int64_t count = 0;

    for (int32_t f = 0; f < scene->face_count; ++f)
        count += primitives_of(scene, f);
    tracer->primitives = OTX_NEW(run->scratch, primitive, count);
    OTX_TRY(otx_run_ok(run));
    tracer->primitive_count = count;
    count = 0;
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const int32_t own = primitives_of(scene, f);
        const bool quad = scene->face_first[f + 1] - scene->face_first[f] == 4;

        for (int32_t k = 0; k < own; ++k)
            tracer->primitives[count++] = (primitive){f, quad ? -1 : k};
    }
    return OSDTEX_OK;
}

/* Corners of a primitive. Embree splits quads between their second and last
 * corner, which are the first and the third of the face; a fan's triangle
 * repeats its last. */
static void
primitive_corners(const otx_scene *scene, primitive p, int32_t corners[4])
{
    const int32_t first = scene->face_first[p.face];

    for (int32_t i = 0; i < 4; ++i)
        corners[i] = p.fan < 0 ? first + (i + 1) % 4
                     : i == 0  ? first
                               : first + p.fan + (i < 2 ? 1 : 2);
}

static void
fill_points(const otx_tracer *tracer, float *points)
{
    for (int32_t v = 0; v < tracer->scene->vert_count; ++v)
    {
        const otx_vec3 p =
            otx_tracer_inside(tracer, otx_vec3_load(tracer->scene->points, v));
        float *to = points + 3 * (size_t)v;

        to[0] = (float)p.x;
        to[1] = (float)p.y;
        to[2] = (float)p.z;
    }
}

static void
fill_indices(const otx_tracer *tracer, uint32_t *indices)
{
    const otx_scene *scene = tracer->scene;

    for (int64_t i = 0; i < tracer->primitive_count; ++i)
    {
        int32_t corners[4];

        primitive_corners(scene, tracer->primitives[i], corners);
        for (int32_t k = 0; k < 4; ++k)
            indices[4 * i + k] = (uint32_t)scene->face_verts[corners[k]];
    }
}

/* Fills one geometry and hands it to the tree. False leaves the reason with
 * the tracer. */
static bool
build_tree(otx_tracer *tracer)
{
    RTCGeometry quads = rtcNewGeometry(tracer->device, RTC_GEOMETRY_TYPE_QUAD);
    float *points;
    uint32_t *indices;

    if (!quads)
        return false;
    points = rtcSetNewGeometryBuffer(
        quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
        (size_t)tracer->scene->vert_count);
    indices = rtcSetNewGeometryBuffer(
        quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(uint32_t),
        (size_t)tracer->primitive_count);
    if (points && indices)
    {
        fill_points(tracer, points);
        fill_indices(tracer, indices);
        rtcCommitGeometry(quads);
        rtcAttachGeometry(tracer->tree, quads);
        rtcCommitScene(tracer->tree);
    }
    rtcReleaseGeometry(quads);
    return points && indices && atomic_load(&tracer->error) == RTC_ERROR_NONE;
}

otx_status
otx_tracer_create(otx_run *run, const otx_scene *scene, otx_tracer **out)
{
    otx_tracer *tracer = OTX_ZNEW(run->scratch, otx_tracer, 1);
    double radius;

    *out = NULL;
    if (!tracer || !otx_arena_defer(run->scratch, release_tracer, tracer))
        return otx_fail_memory(run, STAGE);
    tracer->scene = scene;
    otx_scene_bounds(scene, &tracer->centre, &radius);
    tracer->to_inside = radius > 0.0 ? 1.0 / radius : 1.0;
    OTX_TRY(list_primitives(run, tracer));

    /* One building thread: the caller's pool decides how many there are. */
    tracer->device = rtcNewDevice("threads=1");
    if (!tracer->device)
    {
        /* The error of a device that was not made is the thread's. */
        atomic_store(&tracer->error, (int)rtcGetDeviceError(NULL));
        return fail_embree(run, tracer);
    }
    rtcSetDeviceErrorFunction(tracer->device, remember_error, tracer);
    tracer->tree = rtcNewScene(tracer->device);
    if (!tracer->tree)
        return fail_embree(run, tracer);
    rtcSetSceneFlags(tracer->tree, RTC_SCENE_FLAG_ROBUST);
    if (!build_tree(tracer))
        return fail_embree(run, tracer);
    *out = tracer;
    return OSDTEX_OK;
}

otx_vec3
otx_tracer_inside(const otx_tracer *tracer, otx_vec3 point)
{
    return otx_vec3_scale(
        tracer->to_inside, otx_vec3_sub(point, tracer->centre));
}

static void
set_ray(
    struct RTCRay *ray, otx_vec3 origin, otx_vec3 direction, double distance)
{
    *ray = (struct RTCRay){
        .org_x = (float)origin.x,
        .org_y = (float)origin.y,
        .org_z = (float)origin.z,
        .dir_x = (float)direction.x,
        .dir_y = (float)direction.y,
        .dir_z = (float)direction.z,
        .tfar = (float)distance,
        .mask = UINT32_MAX,
    };
}

/* From Embree's (u, v) of a quad, or of a triangle given as one, to a triangle
 * of corners: the second half has (u, v) counted back from corner 2. */
static void
set_triangle(
    otx_hit *out, const int32_t corners[4], bool quad, double u, double v)
{
    static const int32_t HALVES[2][3] = {{0, 1, 3}, {2, 3, 1}};
    const int32_t half = quad && u + v > 1.0;

    if (half)
    {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    for (int32_t i = 0; i < 3; ++i)
        out->corners[i] = corners[HALVES[half][i]];
    out->weights[0] = fmax(0.0, 1.0 - u - v);
    out->weights[1] = u;
    out->weights[2] = v;
}

static void
place_hit(const otx_tracer *tracer, otx_hit *hit)
{
    const otx_scene *scene = tracer->scene;

    hit->at = (otx_vec3){0.0, 0.0, 0.0};
    for (int32_t i = 0; i < 3; ++i)
    {
        hit->points[i] = otx_tracer_inside(
            tracer,
            otx_vec3_load(scene->points, scene->face_verts[hit->corners[i]]));
        hit->at = otx_vec3_add(
            hit->at, otx_vec3_scale(hit->weights[i], hit->points[i]));
    }
    hit->normal = otx_vec3_unit(otx_vec3_cross(
        otx_vec3_sub(hit->points[1], hit->points[0]),
        otx_vec3_sub(hit->points[2], hit->points[0])));
}

bool
otx_tracer_hit(
    const otx_tracer *tracer, otx_vec3 origin, otx_vec3 direction, otx_hit *out)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query;
    int32_t corners[4];

    set_ray(&query.ray, origin, direction, INFINITY);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcInitIntersectContext(&context);
    rtcIntersect1(tracer->tree, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;

    const primitive p = tracer->primitives[query.hit.primID];

    primitive_corners(tracer->scene, p, corners);
    out->face = p.face;
    set_triangle(out, corners, p.fan < 0, query.hit.u, query.hit.v);
    place_hit(tracer, out);
    return true;
}

bool
otx_tracer_occluded(
    const otx_tracer *tracer, otx_vec3 origin, otx_vec3 direction,
    double distance)
{
    struct RTCIntersectContext context;
    struct RTCRay ray;

    set_ray(&ray, origin, direction, distance);
    rtcInitIntersectContext(&context);
    rtcOccluded1(tracer->tree, &context, &ray);
    return ray.tfar < 0.0f;
}

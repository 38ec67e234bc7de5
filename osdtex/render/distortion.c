/* distortion.c -- stretch of the faces of a scene.
 *
 * Faces are split into the fan of triangles about their first corner, like
 * everywhere in this room except for the tracer's quads. */
#include "render/distortion.h"

typedef struct fan
{
    otx_vec3 p[3];
    otx_vec2 uv[3];
} fan;

/* Triangle k of a face: corners 0, k + 1, k + 2. */
static fan
load_fan(const otx_scene *scene, int32_t face, int32_t k)
{
    const int32_t first = scene->face_first[face];
    const int32_t corners[3] = {first, first + k + 1, first + k + 2};
    fan out;

    for (int32_t i = 0; i < 3; ++i)
    {
        const float *uv = scene->uvs + 2 * (size_t)corners[i];

        out.p[i] = otx_vec3_load(scene->points, scene->face_verts[corners[i]]);
        out.uv[i] = (otx_vec2){uv[0], uv[1]};
    }
    return out;
}

static int32_t
fan_count(const otx_scene *scene, int32_t face)
{
    return scene->face_first[face + 1] - scene->face_first[face] - 2;
}

static double
area_on_surface(const fan *t)
{
    const otx_vec3 a = otx_vec3_sub(t->p[1], t->p[0]);
    const otx_vec3 b = otx_vec3_sub(t->p[2], t->p[0]);

    return 0.5 * otx_vec3_length(otx_vec3_cross(a, b));
}

/* Signed. */
static double
area_in_uv(const fan *t)
{
    return 0.5 * otx_vec2_cross(
                     otx_vec2_sub(t->uv[1], t->uv[0]),
                     otx_vec2_sub(t->uv[2], t->uv[0]));
}

/* Squared L2 stretch: half of |dp/ds|^2 + |dp/dt|^2. */
static double
stretch_sq(const fan *t, otx_vec2 unit)
{
    const otx_vec3 p1 = otx_vec3_sub(t->p[1], t->p[0]);
    const otx_vec3 p2 = otx_vec3_sub(t->p[2], t->p[0]);
    const otx_vec2 q1 = otx_vec2_sub(t->uv[1], t->uv[0]);
    const otx_vec2 q2 = otx_vec2_sub(t->uv[2], t->uv[0]);
    const double area2 = otx_vec2_cross(q1, q2);

    /* Written so that NaN lands here too. */
    if (!(area2 > 0.0))
        return INFINITY;

    const otx_vec3 dp_du = otx_vec3_mix(q2.y / area2, p1, -q1.y / area2, p2);
    const otx_vec3 dp_dv = otx_vec3_mix(-q2.x / area2, p1, q1.x / area2, p2);

    return 0.5 * (otx_vec3_dot(dp_du, dp_du) / (unit.x * unit.x) +
                  otx_vec3_dot(dp_dv, dp_dv) / (unit.y * unit.y));
}

static float
face_stretch(const otx_scene *scene, int32_t face, otx_vec2 unit)
{
    double sum = 0.0, area = 0.0;

    for (int32_t k = 0; k < fan_count(scene, face); ++k)
    {
        const fan t = load_fan(scene, face, k);
        const double a = area_on_surface(&t);

        sum += a > 0.0 ? a * stretch_sq(&t, unit) : 0.0;
        area += a;
    }
    return area > 0.0 ? (float)sqrt(sum / area) : 1.0f;
}

/* Scene units per unit of u and v that give the whole model the same area on
 * the surface and in UV. */
static otx_vec2
fitting_unit(const otx_scene *scene)
{
    const otx_image *image =
        scene->texture_count > 0 ? &scene->textures[0].image : NULL;
    const double aspect = image ? (double)image->height / image->width : 1.0;
    double surface = 0.0, flat = 0.0;

    for (int32_t f = 0; f < scene->face_count; ++f)
        for (int32_t k = 0;
             !otx_scene_is_hole(scene, f) && k < fan_count(scene, f); ++k)
        {
            const fan t = load_fan(scene, f, k);

            surface += area_on_surface(&t);
            flat += fabs(area_in_uv(&t)) * aspect;
        }

    const double unit = flat > 0.0 ? sqrt(surface / flat) : 1.0;

    return (otx_vec2){unit, unit * aspect};
}

otx_status
otx_distortion_faces(
    otx_run *run, otx_arena *arena, const otx_scene *scene,
    const otx_vec2 *units, const float **out)
{
    otx_vec2 chosen = {0.0, 0.0};
    float *stretch;

    *out = NULL;
    if (!scene->uvs)
        return OSDTEX_OK;
    stretch = OTX_NEW(arena, float, scene->face_count);
    if (!stretch)
        return otx_fail_memory(run, "render");
    if (!units)
        chosen = fitting_unit(scene);
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const int32_t t = scene->face_texture ? scene->face_texture[f] : 0;

        stretch[f] = otx_scene_is_hole(scene, f)
                         ? NAN
                         : face_stretch(scene, f, units ? units[t] : chosen);
    }
    *out = stretch;
    return OSDTEX_OK;
}

double
otx_distortion_mean(
    const otx_scene *scene, const float *stretch, int64_t *flipped)
{
    double sum = 0.0, total = 0.0;

    *flipped = 0;
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        double area = 0.0;

        if (otx_scene_is_hole(scene, f))
            continue;
        if (!isfinite(stretch[f]))
        {
            ++*flipped;
            continue;
        }
        for (int32_t k = 0; k < fan_count(scene, f); ++k)
        {
            const fan t = load_fan(scene, f, k);

            area += area_on_surface(&t);
        }
        sum += area * stretch[f];
        total += area;
    }
    return total > 0.0 ? sum / total : 1.0;
}

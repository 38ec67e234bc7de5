/* scene.c -- making, checking and measuring scenes. */
#include "render/scene.h"

#include <float.h>

static const char STAGE[] = "render";

/* Twice the area of a polygon times its unit normal. */
static otx_vec3
face_normal(const otx_scene *scene, int32_t face)
{
    const int32_t first = scene->face_first[face];
    const int32_t end = scene->face_first[face + 1];
    const otx_vec3 origin =
        otx_vec3_load(scene->points, scene->face_verts[first]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t c = first + 2; c < end; ++c)
    {
        const otx_vec3 a = otx_vec3_sub(
            otx_vec3_load(scene->points, scene->face_verts[c - 1]), origin);
        const otx_vec3 b = otx_vec3_sub(
            otx_vec3_load(scene->points, scene->face_verts[c]), origin);

        sum = otx_vec3_add(sum, otx_vec3_cross(a, b));
    }
    return sum;
}

otx_status
otx_scene_smooth(otx_run *run, otx_scene *scene)
{
    const size_t count = (size_t)scene->vert_count;
    float *normals = OTX_NEW(run->arena, float, count * 3);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_vec3 *sums = OTX_ZNEW(run->scratch, otx_vec3, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const otx_vec3 n = face_normal(scene, f);

        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
        {
            otx_vec3 *sum = &sums[scene->face_verts[c]];

            *sum = otx_vec3_add(*sum, n);
        }
    }
    for (size_t v = 0; v < count; ++v)
    {
        const otx_vec3 n = otx_vec3_unit(sums[v]);

        normals[3 * v] = (float)n.x;
        normals[3 * v + 1] = (float)n.y;
        normals[3 * v + 2] = (float)n.z;
    }
    otx_arena_release(run->scratch, mark);
    scene->vert_normals = normals;
    return OSDTEX_OK;
}

static bool
is_finite(const float *values, int32_t index, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        if (!isfinite(values[(size_t)index * (size_t)count + (size_t)i]))
            return false;
    return true;
}

static otx_status
check_corner(
    otx_run *run, const otx_scene *scene, otx_where where, int32_t corner)
{
    const int32_t v = scene->face_verts[corner];

    if (v < 0 || v >= scene->vert_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "a face names a vertex that does not exist; renumber its corners");
    where.vertex = v;
    if (!is_finite(scene->points, v, 3))
        return otx_fail(
            run, OSDTEX_ERROR_NUMERIC, STAGE, where,
            "a vertex has a position that is not a number; repair the model");
    if (scene->uvs && !is_finite(scene->uvs, corner, 2))
        return otx_fail(
            run, OSDTEX_ERROR_NUMERIC, STAGE, where,
            "a corner has a UV that is not a number; repair the model");
    return OSDTEX_OK;
}

static otx_status
check_face(otx_run *run, const otx_scene *scene, int32_t face)
{
    const int32_t first = scene->face_first[face];
    const int32_t end = scene->face_first[face + 1];
    otx_where where = OTX_NOWHERE;

    where.face = face;
    if (first < 0 || end > scene->corner_count || end - first < 3)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "a face has fewer than three corners; remove it from the model");
    if (scene->face_texture &&
        scene->face_texture[face] >= scene->texture_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "a face names a texture that does not exist");
    for (int32_t c = first; c < end; ++c)
        OTX_TRY(check_corner(run, scene, where, c));
    return OSDTEX_OK;
}

static otx_status
check_textures(otx_run *run, const otx_scene *scene)
{
    for (int32_t i = 0; i < scene->texture_count; ++i)
    {
        const otx_image *image = &scene->textures[i].image;

        if (image->width < 1 || image->height < 1 || image->channels < 1 ||
            image->channels > OTX_IMAGE_MAX_CHANNELS || !image->pixels)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "texture %d has no pixels; leave it out or read it again", i);
    }
    return OSDTEX_OK;
}

otx_status
otx_scene_validate(otx_run *run, const otx_scene *scene)
{
    bool drawn = false;

    OTX_TRY(check_textures(run, scene));
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        OTX_TRY(check_face(run, scene, f));
        drawn = drawn || !otx_scene_is_hole(scene, f);
    }
    if (!drawn)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no face to draw; give one with faces that are not "
            "holes");
    return OSDTEX_OK;
}

static void
grow_box(const otx_scene *scene, int32_t face, otx_vec3 *low, otx_vec3 *high)
{
    for (int32_t c = scene->face_first[face]; c < scene->face_first[face + 1];
         ++c)
    {
        const otx_vec3 p = otx_vec3_load(scene->points, scene->face_verts[c]);

        *low =
            (otx_vec3){fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z)};
        *high = (otx_vec3){
            fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z)};
    }
}

static double
reach_of_face(const otx_scene *scene, int32_t face, otx_vec3 centre)
{
    double reach = 0.0;

    for (int32_t c = scene->face_first[face]; c < scene->face_first[face + 1];
         ++c)
    {
        const otx_vec3 p = otx_vec3_load(scene->points, scene->face_verts[c]);

        reach = fmax(reach, otx_vec3_length(otx_vec3_sub(p, centre)));
    }
    return reach;
}

void
otx_scene_bounds(const otx_scene *scene, otx_vec3 *centre, double *radius)
{
    otx_vec3 low = {DBL_MAX, DBL_MAX, DBL_MAX};
    otx_vec3 high = {-DBL_MAX, -DBL_MAX, -DBL_MAX};

    for (int32_t f = 0; f < scene->face_count; ++f)
        if (!otx_scene_is_hole(scene, f))
            grow_box(scene, f, &low, &high);
    *centre = otx_vec3_mix(0.5, low, 0.5, high);
    *radius = 0.0;
    for (int32_t f = 0; f < scene->face_count; ++f)
        if (!otx_scene_is_hole(scene, f))
            *radius = fmax(*radius, reach_of_face(scene, f, *centre));
}

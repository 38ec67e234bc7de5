/* displace.c -- a scene with the heights of its maps. */
#include "render/displace.h"

#include <string.h>

/* The height that a face shows at one of its corners, filtered over its edges
 * there, which is as fine as vertices can follow.
 *
 *   k  of the face's corners */
static double
height_at(const otx_scene *scene, int32_t face, int32_t k)
{
    static const double at[3] = {1.0, 0.0, 0.0};
    static const double dx[3] = {-0.5, 0.5, 0.0}, dy[3] = {-0.5, 0.0, 0.5};
    const otx_map_textures *maps = scene->maps;
    const otx_show_view show = {
        scene->uvs,        scene->face_first,
        scene->lookups,    maps->carry.surface ? &maps->carry : NULL,
        scene->field,      scene->along,
        scene->face_verts, NULL};
    const int32_t first = scene->face_first[face];
    const int32_t size = scene->face_first[face + 1] - first;
    const int32_t corners[3] = {
        first + k, first + (k + 1) % size, first + (k + size - 1) % size};
    const otx_show_place place = {face, corners, at, dx, dy};
    float values[OTX_IMAGE_MAX_CHANNELS];

    otx_show_color(
        &show, maps->textures, &place,
        scene->face_texture ? scene->face_texture[face] : 0, 1.0,
        maps->channels, values);
    return values[maps->first[OTX_COMPANION_HEIGHT]];
}

/* Sums over the faces around each vertex, and how many there are. */
static void
add_heights(const otx_scene *scene, double *sums, int32_t *counts)
{
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const int32_t first = scene->face_first[f];

        if (otx_scene_is_hole(scene, f) ||
            (scene->face_texture && scene->face_texture[f] < 0))
            continue;
        for (int32_t k = 0; k < scene->face_first[f + 1] - first; ++k)
        {
            const int32_t v = scene->face_verts[first + k];

            sums[v] += height_at(scene, f, k);
            ++counts[v];
        }
    }
}

static otx_status
move_points(otx_run *run, const otx_scene *from, otx_scene *out)
{
    const size_t count = (size_t)from->vert_count;
    float *points = OTX_NEW(run->arena, float, 3 * count);
    double *sums = OTX_ZNEW(run->scratch, double, count);
    int32_t *counts = OTX_ZNEW(run->scratch, int32_t, count);

    OTX_TRY(otx_run_ok(run));
    add_heights(from, sums, counts);
    for (size_t v = 0; v < count; ++v)
    {
        const otx_vec3 n = otx_vec3_unit(otx_vec3_load(from->vert_normals, v));
        const double height = counts[v] > 0 ? sums[v] / counts[v] : 0.0;
        const otx_vec3 p =
            otx_vec3_mix(1.0, otx_vec3_load(from->points, v), height, n);

        points[3 * v] = (float)p.x;
        points[3 * v + 1] = (float)p.y;
        points[3 * v + 2] = (float)p.z;
    }
    out->points = points;
    return OSDTEX_OK;
}

otx_status
otx_scene_displace(otx_run *run, const otx_scene *from, otx_scene *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_status status;

    *out = *from;
    if (!from->maps || from->maps->first[OTX_COMPANION_HEIGHT] < 0 ||
        !from->vert_normals)
    {
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "render", OTX_NOWHERE,
            "there is no map of heights, so nothing is displaced");
        return OSDTEX_OK;
    }
    status = move_points(run, from, out);
    otx_arena_release(run->scratch, mark);
    /* What tells finer things than the vertices goes on their old normals. */
    if (status == OSDTEX_OK && from->maps->first[OTX_COMPANION_NORMAL] < 0)
        status = otx_scene_smooth(run, out);
    return status;
}

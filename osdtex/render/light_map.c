/* light_map.c -- blocks that faces reach into, rays, and their means. */
#include "render/light_map.h"

#include "base/random.h"

#include <string.h>

enum
{
    RAYS = 8,  /* of each kind to a pixel */
    REACH = 1, /* pixels around one that are averaged */
    AGREE = 5, /* of those, that must show the same */
    ROWS = 16  /* of pixels between two looks at progress */
};

/* Of normals, and of depths as pixels across the view. */
static const double SAME_NORMAL = 0.9, SAME_DEPTH = 6.0;

typedef struct job
{
    const otx_shade *shade;
    const otx_light_map *map;
    int32_t row;
} job;

/* Marks the blocks that the box of a face is in; all where it reaches behind
 * the eye. */
static void
cover_face(const otx_shade *shade, int32_t face, otx_light_map *map)
{
    const otx_scene *scene = shade->scene;
    const int32_t rows = (map->height - 1) / OTX_LIGHT_MAP_BLOCK + 1;
    otx_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    int32_t x0, y0, x1, y1;

    for (int32_t c = scene->face_first[face]; c < scene->face_first[face + 1];
         ++c)
    {
        const otx_vec3 p = otx_tracer_inside(
            shade->tracer, otx_vec3_load(scene->points, scene->face_verts[c]));
        otx_vec2 at;

        if (!otx_camera_project(&shade->frame, p, &at))
        {
            memset(map->covered, 1, (size_t)map->columns * (size_t)rows);
            return;
        }
        low = (otx_vec2){fmin(low.x, at.x), fmin(low.y, at.y)};
        high = (otx_vec2){fmax(high.x, at.x), fmax(high.y, at.y)};
    }
    /* A pixel more, for what rounding does. */
    x0 = (int32_t)fmax(0.0, (low.x - 1.0) / OTX_LIGHT_MAP_BLOCK);
    y0 = (int32_t)fmax(0.0, (low.y - 1.0) / OTX_LIGHT_MAP_BLOCK);
    x1 = (int32_t)fmin(
        map->columns - 1, floor((high.x + 1.0) / OTX_LIGHT_MAP_BLOCK));
    y1 = (int32_t)fmin(rows - 1, floor((high.y + 1.0) / OTX_LIGHT_MAP_BLOCK));
    for (int32_t y = y0; y <= y1; ++y)
        for (int32_t x = x0; x <= x1; ++x)
            map->covered[(size_t)y * (size_t)map->columns + (size_t)x] = 1;
}

static void
probe_pixel(const otx_shade *shade, int32_t x, int32_t y, otx_light_texel *out)
{
    otx_shade_sample sample = {.at = {x + 0.5, y + 0.5}};
    otx_light_known known;
    otx_vec3 normal;
    double side;
    otx_hit hit;

    *out = (otx_light_texel){.depth = 0.0f};
    if (!otx_shade_trace(shade, &sample, &hit))
        return;
    normal = otx_shade_normal(shade->scene, &hit);
    side = otx_vec3_dot(hit.normal, sample.direction) > 0.0 ? -1.0 : 1.0;
    known = otx_light_probe(
        &shade->light, hit.at, otx_vec3_scale(side, hit.normal),
        otx_vec3_scale(side, normal), RAYS,
        otx_random_mix((uint64_t)y << 32 | (uint64_t)(uint32_t)x));
    *out = (otx_light_texel){
        {(float)normal.x, (float)normal.y, (float)normal.z},
        (float)otx_vec3_dot(
            otx_vec3_sub(hit.at, shade->frame.eye), shade->frame.forward),
        (float)known.key,
        (float)known.sky};
}

static otx_status
probe_row(void *context, int64_t index, otx_worker *worker)
{
    const job *work = context;
    const otx_light_map *map = work->map;
    const int32_t y = work->row + (int32_t)index;

    (void)worker;
    for (int32_t x = 0; x < map->width; ++x)
    {
        otx_light_texel *texel =
            &map->texels[(size_t)y * (size_t)map->width + (size_t)x];

        if (otx_light_map_covers(map, x, y))
            probe_pixel(work->shade, x, y, texel);
        else
            *texel = (otx_light_texel){.depth = 0.0f};
    }
    return OSDTEX_OK;
}

otx_status
otx_light_map_make(
    otx_run *run, const otx_shade *shade, int32_t width, int32_t height,
    bool rays, otx_light_map *out)
{
    const otx_scene *scene = shade->scene;
    const int32_t rows = (height - 1) / OTX_LIGHT_MAP_BLOCK + 1;

    *out = (otx_light_map){
        .width = width,
        .height = height,
        .columns = (width - 1) / OTX_LIGHT_MAP_BLOCK + 1};
    out->covered =
        OTX_ZNEW(run->scratch, uint8_t, (size_t)out->columns * (size_t)rows);
    if (rays)
        out->texels = OTX_NEW(
            run->scratch, otx_light_texel, (size_t)width * (size_t)height);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < scene->face_count; ++f)
        if (!otx_scene_is_hole(scene, f))
            cover_face(shade, f, out);
    for (int32_t y = 0; rays && y < height; y += ROWS)
    {
        job work = {shade, out, y};

        OTX_TRY(otx_pool_for(
            run->pool, height - y < ROWS ? height - y : ROWS, probe_row,
            &work));
    }
    return OSDTEX_OK;
}

bool
otx_light_map_at(
    const otx_light_map *map, int32_t x, int32_t y, otx_vec3 normal,
    double depth, double pixel, otx_light_known *out)
{
    const int32_t x0 = x > REACH ? x - REACH : 0;
    const int32_t y0 = y > REACH ? y - REACH : 0;
    const int32_t x1 = x + REACH < map->width ? x + REACH : map->width - 1;
    const int32_t y1 = y + REACH < map->height ? y + REACH : map->height - 1;
    const double far = SAME_DEPTH * pixel;
    int32_t count = 0;

    *out = (otx_light_known){0.0, 0.0};
    for (int32_t j = y0; j <= y1; ++j)
        for (int32_t i = x0; i <= x1; ++i)
        {
            const otx_light_texel *t =
                &map->texels[(size_t)j * (size_t)map->width + (size_t)i];

            if (!(otx_vec3_dot(normal, otx_vec3_load(t->normal, 0)) >
                  SAME_NORMAL) ||
                fabs(t->depth - depth) > far)
                continue;
            ++count;
            out->key += t->key;
            out->sky += t->sky;
        }
    if (count < AGREE)
        return false;
    out->key /= count;
    out->sky /= count;
    return true;
}

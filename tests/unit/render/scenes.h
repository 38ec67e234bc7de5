/* scenes.h -- small models to look at in tests. */
#ifndef OTX_TESTS_SCENES_H
#define OTX_TESTS_SCENES_H

#include "render/render.h"
#include "support.h"

/* A square of side 2 about the origin, facing +Z, UV (0,0) to (1,1) with v up.
 */
static const float QUAD_POINTS[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
static const int32_t QUAD_FIRST[] = {0, 4};
static const int32_t QUAD_VERTS[] = {0, 1, 2, 3};
static const float QUAD_UVS[] = {0, 0, 1, 0, 1, 1, 0, 1};

static inline otx_scene
scene_quad(const otx_scene_texture *texture)
{
    return (otx_scene){
        .vert_count = 4,
        .face_count = 1,
        .corner_count = 4,
        .points = QUAD_POINTS,
        .face_first = QUAD_FIRST,
        .face_verts = QUAD_VERTS,
        .uvs = QUAD_UVS,
        .texture_count = texture ? 1 : 0,
        .textures = texture,
    };
}

/* A sphere of radius 1: rows x 2 rows quads, those at the poles with two
 * corners in one place. */
static inline otx_scene
scene_sphere(otx_run *run, int32_t rows)
{
    const int32_t columns = 2 * rows;
    const int32_t verts = (rows + 1) * columns;
    const int32_t faces = rows * columns;
    float *points = OTX_NEW(run->arena, float, 3 * (size_t)verts);
    float *uvs = OTX_NEW(run->arena, float, 8 * (size_t)faces);
    int32_t *first = OTX_NEW(run->arena, int32_t, (size_t)faces + 1);
    int32_t *corners = OTX_NEW(run->arena, int32_t, 4 * (size_t)faces);

    for (int32_t v = 0; v < verts; ++v)
    {
        const double up = OTX_PI * (v / columns) / rows;
        const double around = 2.0 * OTX_PI * (v % columns) / columns;

        points[3 * v] = (float)(sin(up) * sin(around));
        points[3 * v + 1] = (float)-cos(up);
        points[3 * v + 2] = (float)(sin(up) * cos(around));
    }
    for (int32_t f = 0; f < faces; ++f)
    {
        const int32_t i = f / columns, j = f % columns;

        first[f] = 4 * f;
        for (int32_t k = 0; k < 4; ++k)
        {
            const int32_t a = i + (k >= 2), b = j + (k == 1 || k == 2);

            corners[4 * f + k] = a * columns + b % columns;
            uvs[2 * (4 * f + k)] = (float)b / (float)columns;
            uvs[2 * (4 * f + k) + 1] = (float)a / (float)rows;
        }
    }
    first[faces] = 4 * faces;
    return (otx_scene){
        .vert_count = verts,
        .face_count = faces,
        .corner_count = 4 * faces,
        .points = points,
        .face_first = first,
        .face_verts = corners,
        .uvs = uvs,
    };
}

/* A picture of the quad that fills it exactly: seen from +Z, `pixels` square.
 */
static inline otx_render_options
facing_options(const otx_camera *camera, int32_t pixels)
{
    otx_render_options options = otx_render_defaults();

    options.width = options.height = pixels;
    options.camera = camera;
    options.unlit = true;
    options.transparent = true;
    return options;
}

static inline otx_camera
facing_camera(double distance)
{
    return (otx_camera){
        {0.0, 0.0, distance},
        {0.0, 0.0, 0.0},
        2.0 * atan(1.0 / distance),
        0.0,
        OTX_UP_Y};
}

/* A texture of `size` squared with three channels, all zero. */
static inline otx_scene_texture
texture_of(otx_run *run, int32_t size, bool wrap)
{
    otx_scene_texture texture = {.wrap_x = wrap, .wrap_y = wrap};

    assert_int_equal(
        otx_image_create(run, run->arena, size, size, 3, &texture.image),
        OSDTEX_OK);
    memset(texture.image.pixels, 0, (size_t)size * (size_t)size * 3 * 4);
    return texture;
}

static inline void
paint(const otx_image *image, int32_t x, int32_t y, float r, float g, float b)
{
    float *p = otx_image_at(image, x, y);

    p[0] = r;
    p[1] = g;
    p[2] = b;
}

#endif

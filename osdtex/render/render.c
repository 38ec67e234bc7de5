/* render.c -- tiles, pixels, samples. */
#include "render/render.h"

#include "base/random.h"
#include "render/framing.h"
#include "render/quick.h"
#include "render/shade.h"

#include <string.h>

static const char STAGE[] = "render";

enum
{
    TILE = 32,
    MAX_SAMPLES = 16
};

static const char *const SHOW_NAMES[OTX_SHOW_COUNT] = {
    [OTX_SHOW_TEXTURE] = "texture",
    [OTX_SHOW_PATCHES] = "patches",
    [OTX_SHOW_STRETCH] = "stretch",
    [OTX_SHOW_SEAMS] = "seams",
    [OTX_SHOW_UV] = "uv",
    [OTX_SHOW_NORMALS] = "normals",
    [OTX_SHOW_FLAT] = "flat",
    [OTX_SHOW_FIELD] = "field",
    [OTX_SHOW_SINGULARITIES] = "singularities",
    [OTX_SHOW_CELLS] = "cells",
    [OTX_SHOW_WINDOWS] = "windows",
    [OTX_SHOW_CLAY] = "clay",
};

/* What the tiles of a picture share. */
typedef struct job
{
    const otx_shade *shade;
    const otx_light_map *map;
    const otx_quick *quick; /* NULL: all pixels take all samples */
    otx_image *image;
    int32_t row; /* of tiles */
} job;

otx_render_options
otx_render_defaults(void)
{
    return (otx_render_options){
        .width = 1280,
        .height = 720,
        .samples = 4,
        .show = OTX_SHOW_TEXTURE,
        .view = OTX_VIEW_THREE_QUARTER,
        .seam_width = 1.5,
    };
}

const char *
otx_render_show_name(otx_show show)
{
    return SHOW_NAMES[show];
}

bool
otx_render_show_find(const char *name, otx_show *out)
{
    for (int32_t i = 0; i < OTX_SHOW_COUNT; ++i)
        if (strcmp(SHOW_NAMES[i], name) == 0)
        {
            *out = (otx_show)i;
            return true;
        }
    return false;
}

static otx_status
check_options(otx_run *run, const otx_render_options *options)
{
    if (options->width < 1 || options->width > OTX_IMAGE_MAX_SIDE ||
        options->height < 1 || options->height > OTX_IMAGE_MAX_SIDE)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a picture of %d x %d pixels cannot be made; choose sides from 1 "
            "to %d",
            options->width, options->height, OTX_IMAGE_MAX_SIDE);
    if (options->samples < 1 || options->samples > MAX_SAMPLES)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "%d samples to a pixel's side cannot be taken; choose 1 to %d",
            options->samples, MAX_SAMPLES);
    if (options->show < 0 || options->show >= OTX_SHOW_COUNT ||
        options->view < 0 || options->view >= OTX_VIEW_COUNT ||
        options->up < 0 || options->up >= OTX_UP_COUNT ||
        !isfinite(options->turn) || !isfinite(options->seam_width))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "what to show, the view, the turn or the width of seams is not one "
            "of those there are");
    if (!options->overlay && (options->show == OTX_SHOW_FIELD ||
                              options->show == OTX_SHOW_SINGULARITIES))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no direction field to show; one is made of its "
            "cage, and mappings of directional exemplars follow one");
    if (!options->overlay && options->show == OTX_SHOW_CELLS)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no lattice to show; mappings by "
            "the method material have one");
    if (options->camera && !otx_camera_is_valid(options->camera))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the camera cannot see: its eye must be apart from its target and "
            "its field of view between 0 and 180 degrees");
    return OSDTEX_OK;
}

/* Neutral and a little brighter at the top, like a studio's backdrop. */
static float
wall(double height)
{
    return (float)(0.115 + 0.085 * height);
}

static bool
trace_sample(const otx_shade *shade, otx_shade_sample *sample, float rgb[3])
{
    otx_hit hit;

    if (!otx_shade_trace(shade, sample, &hit))
        return false;
    otx_shade_hit(shade, &hit, sample, rgb);
    return true;
}

/* By all its samples; `known` may be NULL. */
static void
render_mixed(
    const otx_shade *shade, int32_t x, int32_t y, uint64_t pixel,
    const otx_light_known *known, float rgba[4])
{
    const otx_render_options *options = shade->options;
    const int32_t n = options->samples;
    double sum[4] = {0.0, 0.0, 0.0, 0.0};

    for (int32_t i = 0; i < n * n; ++i)
    {
        const otx_vec2 place = otx_quick_place(n, i, pixel);
        otx_shade_sample sample = {
            .at = {x + place.x, y + place.y},
            .number = i,
            .pixel = pixel,
            .known = known};
        const float back = wall(sample.at.y / options->height);
        float rgb[3] = {back, back, back};
        const bool met = trace_sample(shade, &sample, rgb);

        if (!met && options->transparent)
            continue;
        for (int32_t c = 0; c < 3; ++c)
            sum[c] += rgb[c];
        sum[3] += 1.0;
    }
    for (int32_t c = 0; c < 4; ++c)
        rgba[c] = (float)(sum[c] / (n * n));
}

/* A pixel without the model. */
static void
render_wall(const otx_render_options *options, int32_t y, float rgba[4])
{
    const float back = wall((y + 0.5) / options->height);

    for (int32_t c = 0; c < 3; ++c)
        rgba[c] = options->transparent ? 0.0f : back;
    rgba[3] = options->transparent ? 0.0f : 1.0f;
}

static void
render_pixel(const job *work, int32_t x, int32_t y, float rgba[4])
{
    const uint64_t pixel =
        otx_random_mix((uint64_t)y << 32 | (uint64_t)(uint32_t)x);
    otx_quick_result result = OTX_QUICK_MIXED;
    otx_light_known known;

    if (!otx_light_map_covers(work->map, x, y))
        result = OTX_QUICK_EMPTY;
    else if (work->quick)
        result = otx_quick_pixel(work->quick, x, y, pixel, rgba, &known);
    rgba[3] = 1.0f;
    if (result == OTX_QUICK_EMPTY)
        render_wall(work->shade->options, y, rgba);
    if (result == OTX_QUICK_MIXED || result == OTX_QUICK_FINE)
        render_mixed(
            work->shade, x, y, pixel, result == OTX_QUICK_FINE ? &known : NULL,
            rgba);
}

static otx_status
render_tile(void *context, int64_t index, otx_worker *worker)
{
    const job *work = context;
    const int32_t x0 = (int32_t)index * TILE;
    const int32_t y0 = work->row * TILE;
    const int32_t x1 =
        x0 + TILE < work->image->width ? x0 + TILE : work->image->width;
    const int32_t y1 =
        y0 + TILE < work->image->height ? y0 + TILE : work->image->height;

    (void)worker;
    for (int32_t y = y0; y < y1; ++y)
        for (int32_t x = x0; x < x1; ++x)
            render_pixel(work, x, y, otx_image_at(work->image, x, y));
    return OSDTEX_OK;
}

/* Row after row of tiles, so that the user hears of it and can stop it. */
static otx_status
render_tiles(otx_run *run, const otx_shade *shade, otx_image *image)
{
    const int32_t columns = (image->width + TILE - 1) / TILE;
    const int32_t rows = (image->height + TILE - 1) / TILE;
    const bool is_quick = otx_quick_suits(shade->options);
    otx_light_map map;
    otx_quick quick;

    OTX_TRY(otx_light_map_make(
        run, shade, image->width, image->height,
        is_quick && otx_shade_is_lit(shade->options) && shade->light.shadows,
        &map));
    otx_quick_prepare(shade, &map, &quick);
    for (int32_t row = 0; row < rows; ++row)
    {
        job work = {shade, &map, is_quick ? &quick : NULL, image, row};

        OTX_TRY(otx_progress(run, STAGE, (double)row / rows));
        OTX_TRY(otx_pool_for(run->pool, columns, render_tile, &work));
    }
    return otx_progress(run, STAGE, 1.0);
}

/* The camera of the options, in the tracer's units. */
static otx_camera_frame
aim_camera(
    const otx_scene *scene, const otx_tracer *tracer,
    const otx_render_options *options)
{
    const otx_framing framing = {
        options->view, options->up, options->turn,
        (double)options->width / options->height, options->orbit};
    otx_camera camera = options->camera ? *options->camera
                                        : otx_framing_camera(scene, &framing);

    camera.eye = otx_tracer_inside(tracer, camera.eye);
    camera.target = otx_tracer_inside(tracer, camera.target);
    return otx_camera_aim(&camera, options->width, options->height);
}

static otx_status
render_scene(
    otx_run *run, const otx_scene *scene, const otx_render_options *options,
    otx_image *out)
{
    otx_tracer *tracer;
    otx_camera_frame frame;
    otx_shade shade;

    OTX_TRY(otx_tracer_create(run, scene, &tracer));
    frame = aim_camera(scene, tracer, options);
    OTX_TRY(otx_shade_prepare(run, scene, options, tracer, &frame, &shade));
    OTX_TRY(otx_image_create(
        run, run->arena, options->width, options->height, 4, out));
    return render_tiles(run, &shade, out);
}

otx_status
otx_render(
    otx_run *run, const otx_scene *scene, const otx_render_options *options,
    otx_image *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_status status;

    *out = (otx_image){0};
    OTX_TRY(check_options(run, options));
    OTX_TRY(otx_scene_validate(run, scene));
    status = render_scene(run, scene, options, out);
    otx_arena_release(run->scratch, mark);
    if (status != OSDTEX_OK)
        *out = (otx_image){0};
    return status;
}

/* image_handle.c -- pixels in, pixels out. */
#include "api/image_handle.h"
#include "api/call.h"
#include "api/handle.h"
#include "colour/embedding.h"
#include "file/atomic_file.h"
#include "file/exr.h"
#include "file/picture_read.h"
#include "file/png_file.h"
#include "image/dither.h"

#include <string.h>
#include <strings.h>

otx_status
otx_image_handle_wrap(otx_run *run, otx_image image, osdtex_image **out)
{
    osdtex_image *handle = OTX_ZNEW(run->arena, osdtex_image, 1);

    OTX_TRY(otx_run_ok(run));
    handle->arena = run->arena;
    handle->image = image;
    handle->info = (osdtex_image_info){
        .width = image.width,
        .height = image.height,
        .channels = image.channels,
        .pixels = image.pixels,
    };
    *out = handle;
    return OSDTEX_OK;
}

static otx_status
create(otx_run *run, const osdtex_image_info *pixels, osdtex_image **out)
{
    otx_image image;

    if (!pixels->pixels || pixels->width < 1 || pixels->height < 1 ||
        pixels->channels < 1 || pixels->channels > 4)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "image", OTX_NOWHERE,
            "an image has pixels, a size, and 1 to 4 channels");
    OTX_TRY(otx_image_create(
        run, run->arena, pixels->width, pixels->height, pixels->channels,
        &image));
    memcpy(
        image.pixels, pixels->pixels,
        (size_t)image.width * (size_t)image.height * (size_t)image.channels *
            sizeof(float));
    return otx_image_handle_wrap(run, image, out);
}

osdtex_status
osdtex_image_create(
    osdtex_context *context, int32_t width, int32_t height, int32_t channels,
    const float *pixels, osdtex_image **out)
{
    const osdtex_image_info info = {width, height, channels, 0, pixels};
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "image", &call));
    return otx_call_end(&call, create(&call.run, &info, out), out);
}

/* Files differ in whether colour is multiplied by alpha; images are not. */
static void
associate(const otx_picture *picture)
{
    const otx_image *image = &picture->image;
    const size_t count = (size_t)image->width * (size_t)image->height;

    if (!picture->has_alpha || picture->alpha_is_premultiplied)
        return;
    for (float *p = image->pixels; p < image->pixels + 4 * count; p += 4)
        for (int32_t k = 0; k < 3; ++k)
            p[k] *= p[3];
}

static otx_status
read_image(otx_run *run, const char *path, osdtex_image **out)
{
    otx_picture picture;

    if (!path)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "image", OTX_NOWHERE,
            "no path is given");
    OTX_TRY(otx_picture_read(run, path, &picture));
    associate(&picture);
    return otx_image_handle_wrap(run, picture.image, out);
}

osdtex_status
osdtex_image_read(osdtex_context *context, const char *path, osdtex_image **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "image", &call));
    return otx_call_end(&call, read_image(&call.run, path, out), out);
}

const osdtex_image_info *
osdtex_image_describe(const osdtex_image *image)
{
    return image ? &image->info : NULL;
}

void
osdtex_image_destroy(osdtex_image *image)
{
    if (image)
        otx_arena_destroy(image->arena);
}

/* Whether `path` ends in `extension`, in upper or lower case. */
static bool
has_extension(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);

    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

/* 3 or 4 channels: grey is given three times. */
static otx_status
spread(otx_run *run, const otx_image *image, otx_image *out)
{
    const bool has_alpha = image->channels % 2 == 0;
    const int32_t channels = has_alpha ? 4 : 3;
    const size_t count = (size_t)image->width * (size_t)image->height;

    OTX_TRY(otx_image_create(
        run, run->arena, image->width, image->height, channels, out));
    for (size_t i = 0; i < count; ++i)
    {
        const float *from = image->pixels + i * (size_t)image->channels;
        float *to = out->pixels + i * (size_t)channels;

        for (int32_t k = 0; k < 3; ++k)
            to[k] = from[image->channels < 3 ? 0 : k];
        if (has_alpha)
            to[3] = from[image->channels - 1];
    }
    return OSDTEX_OK;
}

/* Divides colour by alpha, where there is any. */
static void
unassociate(otx_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;

    if (image->channels != 4)
        return;
    for (size_t i = 0; i < count; ++i)
    {
        float *p = image->pixels + 4 * i;

        for (int32_t k = 0; k < 3; ++k)
            p[k] = p[3] > 0.0f ? p[k] / p[3] : 0.0f;
    }
}

/* Scene-linear colours as a display shows them. */
static otx_status
to_display(
    otx_run *run, const otx_colour *colour, const char *linear,
    otx_image *image)
{
    const char *display = otx_colour_srgb(colour);
    const size_t count = (size_t)image->width * (size_t)image->height;

    unassociate(image);
    if (display)
        return otx_colour_convert(run, colour, linear, display, image);
    for (size_t i = 0; i < count; ++i)
    {
        float *p = image->pixels + i * (size_t)image->channels;

        for (int32_t k = 0; k < 3; ++k)
            p[k] = otx_embedding_encode(p[k]);
    }
    return OSDTEX_OK;
}

static otx_status
write_exr(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_colour *colour, const char *linear, const otx_image *image)
{
    otx_exr_options options = otx_exr_options_default();

    options.tiled = false;
    options.color_space = linear;
    options.interop_id = otx_colour_interop_id(colour, linear);
    options.has_chromaticities =
        otx_colour_chromaticities(colour, linear, options.chromaticities);
    return otx_exr_write(run, set, path, image, &options);
}

static otx_status
write_image(otx_call *call, const osdtex_image *image, const char *path)
{
    const bool is_png = path && has_extension(path, ".png");
    otx_run *run = &call->run;
    otx_atomic_file_set *set;
    const otx_colour *colour;
    const char *linear;
    otx_image pixels;

    if (!image || !path || (!is_png && !has_extension(path, ".exr")))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "image", OTX_NOWHERE,
            "pictures are written as NAME.exr or NAME.png, not '%.200s'",
            path ? path : "");
    OTX_TRY(otx_call_colour(call, &colour));
    OTX_TRY(otx_colour_resolve_linear(run, colour, NULL, &linear));
    OTX_TRY(spread(run, &image->image, &pixels));
    OTX_TRY(otx_atomic_file_begin(run, run->arena, &set));
    if (is_png)
    {
        OTX_TRY(to_display(run, colour, linear, &pixels));
        otx_dither_8bit(&pixels);
        OTX_TRY(otx_png_file_write(run, set, path, &pixels, 8));
    }
    else
        OTX_TRY(write_exr(run, set, path, colour, linear, &pixels));
    otx_atomic_file_describe(set, path, "picture");
    return otx_atomic_file_commit(run, set, false);
}

osdtex_status
osdtex_image_write(
    osdtex_context *context, const osdtex_image *image, const char *path)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, "picture", &call));
    return otx_call_drop(&call, write_image(&call, image, path));
}

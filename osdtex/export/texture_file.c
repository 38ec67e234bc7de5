/* texture_file.c -- colour attributes, tile attributes, levels. */
#include "export/texture_file.h"

#include "file/exr.h"
#include "file/jpeg_write.h"
#include "file/png_file.h"
#include "file/tiff_write.h"
#include "image/dither.h"
#include "image/pyramid.h"

#include <math.h>
#include <string.h>

/* What the header says about tiles. `exact` levels show the picture; the
 * coarser ones are flat along the rims of the tiles. */
static otx_status
describe_tiles(
    otx_run *run, const otx_tile_layout *layout, otx_exr_options *options)
{
    otx_exr_attribute *list = OTX_ZNEW(run->scratch, otx_exr_attribute, 3);
    const char *text = otx_tile_layout_print(run->scratch, layout);

    OTX_TRY(otx_run_ok(run));
    list[0] = (otx_exr_attribute){
        .name = "osdtex:tiles", .kind = OTX_EXR_TEXT, .text = text};
    list[1] = (otx_exr_attribute){
        .name = "osdtex:exactLevels",
        .kind = OTX_EXR_INTEGER,
        .integer = otx_tile_layout_exact_levels(layout)};
    list[2] = (otx_exr_attribute){
        .name = "osdtex:innerCut",
        .kind = OTX_EXR_REAL,
        .real = (float)layout->figures.inner_cut};
    options->attributes = list;
    options->attribute_count = layout->figures.inner_cut < 0.0 ? 2 : 3;
    return OSDTEX_OK;
}

static otx_status
separate_levels(
    otx_run *run, const otx_tile_layout *layout, const otx_image *image,
    otx_exr_options *options)
{
    const int32_t count = otx_pyramid_count(image->width, image->height) - 1;
    otx_image *levels = OTX_NEW(run->scratch, otx_image, count);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_tile_layout_levels(run, run->scratch, layout, image, levels));
    options->levels = levels;
    options->level_count = count;
    return OSDTEX_OK;
}

const char *
otx_texture_file_type_extension(otx_texture_type type)
{
    static const char *const extensions[OTX_TEXTURE_COUNT] = {
        ".exr", ".exr", ".png", ".tif", ".jpg"};

    return extensions[type];
}

const char *
otx_texture_file_extension(const otx_exemplar *exemplar)
{
    return otx_texture_file_type_extension(exemplar->type);
}

const char *
otx_texture_file_interop_id(const otx_exemplar *exemplar)
{
    return exemplar->type > OTX_TEXTURE_EXR && !exemplar->is_data
               ? "srgb_rec709_scene"
               : exemplar->interop_id;
}

/* Whether any texel is not opaque. */
static bool
is_transparent(const otx_image *image)
{
    const size_t texels = (size_t)image->width * (size_t)image->height;

    for (size_t i = 0; image->channels == 4 && i < texels; ++i)
        if (image->pixels[4 * i + 3] < 1.0f)
            return true;
    return false;
}

static otx_status
write_jpeg(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image)
{
    if (is_transparent(image))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "export", otx_where_file(path),
            "JPEG has no alpha, so what is transparent is opaque in it; write "
            "PNG, TIFF or EXR to keep it");
    return otx_jpeg_write(run, set, path, image);
}

static void
encode_texel(float *texel, int32_t channels)
{
    const float alpha = channels == 4 ? texel[3] : 1.0f;

    for (int32_t k = 0; k < 3; ++k)
    {
        const float value = alpha > 0.0f ? texel[k] / alpha : 0.0f;

        texel[k] = otx_embedding_encode(fminf(fmaxf(value, 0.0f), 1.0f));
    }
}

otx_status
otx_texture_file_write_integers(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image)
{
    const size_t texels = (size_t)image->width * (size_t)image->height;
    const size_t channels = (size_t)image->channels;
    otx_image encoded;

    OTX_TRY(otx_image_create(
        run, run->scratch, image->width, image->height, image->channels,
        &encoded));
    memcpy(
        encoded.pixels, image->pixels,
        texels * channels * sizeof *image->pixels);
    for (size_t i = 0; !exemplar->is_data && i < texels; ++i)
        encode_texel(encoded.pixels + i * channels, image->channels);
    if (exemplar->type == OTX_TEXTURE_TIFF)
        return otx_tiff_write(run, set, path, &encoded, 16);
    if (exemplar->type == OTX_TEXTURE_JPEG)
        return write_jpeg(run, set, path, &encoded);
    if (exemplar->is_data)
        return otx_png_file_write_data(run, set, path, &encoded);
    otx_dither_8bit(&encoded);
    return otx_png_file_write(run, set, path, &encoded, 8);
}

otx_status
otx_texture_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image,
    const otx_tile_layout *layout)
{
    otx_exr_options options = otx_exr_options_default();

    if (exemplar->type > OTX_TEXTURE_EXR)
        return otx_texture_file_write_integers(run, set, path, exemplar, image);
    options.tiled = true;
    options.has_chromaticities = exemplar->has_chromaticities;
    memcpy(
        options.chromaticities, exemplar->chromaticities,
        sizeof options.chromaticities);
    options.color_space = exemplar->linear_space;
    options.interop_id = exemplar->interop_id;
    if (layout->cell > 0)
    {
        OTX_TRY(describe_tiles(run, layout, &options));
        OTX_TRY(separate_levels(run, layout, image, &options));
    }
    else
    {
        options.wrap_x = exemplar->wrap_x;
        options.wrap_y = exemplar->wrap_y;
    }
    return otx_exr_write(run, set, path, image, &options);
}

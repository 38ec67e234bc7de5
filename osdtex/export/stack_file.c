/* stack_file.c -- parts, their names and places. */
#include "export/stack_file.h"

#include "file/exr.h"
#include "file/png_file.h"

#include <stdio.h>
#include <string.h>

enum
{
    NAME_BYTES = 16
};

static otx_status
mask_image(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    int32_t channels, otx_image *out)
{
    const int64_t texels = (int64_t)width * height;

    OTX_TRY(otx_image_create(run, run->scratch, width, height, channels, out));
    for (int64_t i = 0; i < texels * channels; ++i)
        out->pixels[i] = mask[i / channels] ? 1.0f : 0.0f;
    return OSDTEX_OK;
}

/* A part's name and place. */
static otx_status
fill_page(
    otx_run *run, const char *lead, int32_t index, double position,
    otx_exr_page *page)
{
    char *name = OTX_NEW(run->scratch, char, NAME_BYTES);
    otx_exr_attribute *place = OTX_ZNEW(run->scratch, otx_exr_attribute, 1);

    OTX_TRY(otx_run_ok(run));
    snprintf(name, NAME_BYTES, "%s%03d", lead, index);
    *place = (otx_exr_attribute){
        .name = "osdtex:position",
        .kind = OTX_EXR_REAL,
        .real = (float)position};
    page->name = name;
    page->options = otx_exr_options_default();
    page->options.wrap_x = page->options.wrap_y = true;
    page->options.attributes = place;
    page->options.attribute_count = 1;
    return OSDTEX_OK;
}

static void
give_colour(const otx_exemplar *like, otx_exr_options *options)
{
    options->has_chromaticities = like->has_chromaticities;
    memcpy(
        options->chromaticities, like->chromaticities,
        sizeof options->chromaticities);
    options->color_space = like->linear_space;
    options->interop_id = like->interop_id;
}

otx_status
otx_stack_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *like, const otx_stack_page *pages, int32_t count)
{
    otx_exr_page *parts = OTX_ZNEW(run->scratch, otx_exr_page, 2 * count);
    otx_image *masks = OTX_NEW(run->scratch, otx_image, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_stack_page *page = &pages[k];
        const otx_image *linear = page->linear;

        OTX_TRY(fill_page(run, "m", k, page->position, &parts[k]));
        give_colour(like, &parts[k].options);
        parts[k].image = linear;
        OTX_TRY(fill_page(run, "mask", k, page->position, &parts[count + k]));
        OTX_TRY(mask_image(
            run, page->mask, linear->width, linear->height, 1, &masks[k]));
        parts[count + k].image = &masks[k];
    }
    return otx_exr_write_pages(run, set, path, parts, 2 * count);
}

otx_status
otx_stack_file_write_mask(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const uint8_t *mask, int32_t width, int32_t height)
{
    otx_image image;

    OTX_TRY(mask_image(run, mask, width, height, 3, &image));
    return otx_png_file_write(run, set, path, &image, 8);
}

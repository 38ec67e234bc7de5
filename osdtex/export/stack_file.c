/* stack_file.c -- parts, their names and places. */
#include "export/stack_file.h"

#include "export/companion_files.h"
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

/* One map of a slice, as files have it. */
static otx_status
map_image(
    otx_run *run, const otx_image *all, const otx_companion *map,
    otx_companion_kind kind, otx_image *out)
{
    const int32_t channels = otx_companion_channels(kind);

    OTX_TRY(otx_image_create(
        run, run->scratch, all->width, all->height, channels, out));
    for (int64_t i = 0; i < (int64_t)all->width * all->height; ++i)
    {
        float *values = out->pixels + i * channels;

        memcpy(
            values, all->pixels + i * all->channels + map->first,
            (size_t)channels * sizeof *values);
        if (kind == OTX_COMPANION_NORMAL)
            otx_companion_encode_normal(values);
    }
    return OSDTEX_OK;
}

/* A kind of map of all slices. */
static otx_status
fill_maps(
    otx_run *run, const otx_companion *map, otx_companion_kind kind,
    const otx_stack_page *pages, int32_t count, otx_exr_page *parts)
{
    otx_image *images = OTX_NEW(run->scratch, otx_image, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
    {
        parts[k].options = otx_companion_files_options(kind);
        OTX_TRY(fill_page(
            run, otx_companion_name(kind), k, pages[k].position, &parts[k]));
        OTX_TRY(map_image(run, pages[k].maps, map, kind, &images[k]));
        parts[k].image = &images[k];
    }
    return OSDTEX_OK;
}

static int32_t
map_count(const otx_exemplar *like)
{
    int32_t count = 0;

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        count += like->companions.maps[k].is_there;
    return count;
}

otx_status
otx_stack_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *like, const otx_stack_page *pages, int32_t count)
{
    const int32_t part_count = (2 + map_count(like)) * count;
    otx_exr_page *parts = OTX_ZNEW(run->scratch, otx_exr_page, part_count);
    otx_image *masks = OTX_NEW(run->scratch, otx_image, count);
    otx_exr_page *next = parts + 2 * count;

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < 2 * count; ++k)
        parts[k].options = otx_exr_options_default();
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
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        if (like->companions.maps[k].is_there)
        {
            OTX_TRY(fill_maps(
                run, &like->companions.maps[k], (otx_companion_kind)k, pages,
                count, next));
            next += count;
        }
    return otx_exr_write_pages(run, set, path, parts, part_count);
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
